// Ranges forwards and backwards, in steps, of every sort of ends: in which order their counters come.

pub fn k(a: &Frame<Vec4>, p: i32, q: u32, pixel: IVec2) -> Vec4 {
    let mut order = [0u32; 8];
    for i in (0..10).rev().step_by(3) {
        order[0] = order[0].wrapping_mul(31).wrapping_add(i);
    }
    for i in (0..10u32).step_by(3).rev() {
        order[1] = order[1].wrapping_mul(31).wrapping_add(i);
    }
    for i in (2..=11u32).rev().step_by(4) {
        order[2] = order[2].wrapping_mul(31).wrapping_add(i);
    }
    for i in (-7..=7).step_by(5) {
        order[3] = order[3].wrapping_mul(31).wrapping_add((i + 9) as u32);
    }
    let (low, high) = (p & 3, (q & 15) as i32);
    for i in (low..=high).rev() {
        order[4] = order[4].wrapping_mul(31).wrapping_add(i as u32);
    }
    for i in (low..high).rev().step_by(2) {
        order[5] = order[5].wrapping_mul(31).wrapping_add(i as u32);
    }
    for i in (low..=high).step_by(3) {
        order[6] = order[6].wrapping_mul(31).wrapping_add(i as u32);
    }
    for i in (0..2).rev() {
        order[7] = order[7].wrapping_mul(31).wrapping_add(i + 1);
    }
    let mut of = [0.0; 4];
    for k in 0..4 {
        of[k] = (order[2 * k] & 0xfff) as f32 + 4096.0 * (order[2 * k + 1] & 0xfff) as f32;
    }
    a.load(pixel) * 0.0 + vec4(of[0], of[1], of[2], of[3])
}

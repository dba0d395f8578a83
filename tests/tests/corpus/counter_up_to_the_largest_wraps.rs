// A range from a literal to `i32::MAX` counts in i32, which wraps: its counter was taken for a usize once.
// expect 0 0: 2 1 4 1

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [1.0, 1.0, 3.0];
    let mut sum = 0.0;
    for i in 2147483645..i32::MAX {
        v[i.wrapping_add(i).rem_euclid(3) as usize] += 1.0;
        sum += i.wrapping_mul(2) as f32;
    }
    for i in i32::MIN..-2147483646 {
        sum += i.wrapping_sub(3) as f32;
    }
    vec4(v[0], v[1], v[2], sum / 4294967296.0)
}

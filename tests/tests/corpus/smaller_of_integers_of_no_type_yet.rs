// `min`, `max` and `clamp` are methods of `Ord`: rustc takes them of an integer whose type only what follows tells, or nothing.
pub fn k(a: &Frame<Vec4>, p: i32, q: u32, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for n in 0..3 {
        sum += (n.min(pixel.x) + p) as f32;
    }
    for n in 2..5 {
        sum += (n.clamp(3, 9).max(q & 3) >> 1) as f32;
    }
    let least = 7.min(3);
    a.load(pixel) + sum + least as f32
}

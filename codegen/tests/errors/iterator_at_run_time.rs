pub fn k(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let sum: f32 = (0..taps).map(|x| color.load(pixel + ivec2(x, 0)).x).sum();
    color.load(pixel) * sum
}

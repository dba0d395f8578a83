pub fn k(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let sum: f32 = (0..taps).map(|x| color.load(pixel + ivec2(x, 0)).x).sum();
    let endless = [1.0_f32, 2.0].iter().cycle();
    color.load(pixel) * sum
}

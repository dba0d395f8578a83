pub fn k(weights: &Buffer<f32>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut called = 0;
    let odd: f32 = (0..taps).filter(|k| k % 2 == 1).skip(1).map(|k| k as f32).sum();
    let counted: i32 = (0..taps).map(|k| { called += 1; k }).skip(1).sum();
    vec4(odd, counted as f32, called as f32, weights.load(pixel.x as usize))
}

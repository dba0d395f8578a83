pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let endless: f32 = [1.0_f32, 2.0].iter().cycle().sum();
    color.load(pixel) * endless
}

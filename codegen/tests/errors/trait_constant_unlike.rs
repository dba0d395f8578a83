trait Curve {
    const GAIN: f32;
}
impl Curve for f32 {
    const GAIN: i32 = 2;
}
pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * f32::GAIN as f32
}

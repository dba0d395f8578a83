fn is_below(x: f32) -> bool {
    (x < 0.0).is_finite()
}
fn bounded(x: f32) -> f32 {
    x.saturated()
}
pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let color = color.load(pixel);
    if false && is_below(color.x) { color * bounded(color.y) } else { color }
}

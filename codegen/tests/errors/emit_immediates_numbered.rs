// parameters: immediate
// binding: parameters=3
pub fn k(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    color.load(pixel) * strength
}

// parameters: immediate
pub fn k(color: &Frame<Vec4>, a: Mat4, b: Mat4, c: f32, pixel: IVec2) -> Vec4 {
    a * (b * color.load(pixel)) * c
}

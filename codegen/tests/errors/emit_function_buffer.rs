// form: function
pub fn k(color: &Frame<Vec4>, weights: &Buffer<f32>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * weights.load(0)
}

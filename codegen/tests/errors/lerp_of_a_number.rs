pub fn k(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    color.load(pixel) * strength.lerp(1.0, 0.5)
}

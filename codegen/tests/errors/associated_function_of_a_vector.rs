pub fn k(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    color.load(pixel) + Vec4::from_angle(strength)
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> f32 {
    color.load(pixel).x
}

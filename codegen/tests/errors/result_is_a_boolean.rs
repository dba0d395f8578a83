pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> bool {
    color.load(pixel).x > 0.5
}

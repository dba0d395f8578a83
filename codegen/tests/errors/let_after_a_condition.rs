pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    if pixel.x > 2 && let 1 = pixel.y {
        return Vec4::ZERO;
    }
    color.load(pixel)
}

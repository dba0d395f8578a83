pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let 1 = 1 else { return Vec4::ZERO };
    color.load(pixel)
}

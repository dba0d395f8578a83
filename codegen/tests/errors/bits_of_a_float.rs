pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = color.load(pixel).x & 1.0;
    color.load(pixel)
}

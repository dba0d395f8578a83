pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a;
    color.load(pixel) * a
}

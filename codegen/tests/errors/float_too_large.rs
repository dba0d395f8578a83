pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = 1.0e40;
    color.load(pixel) * x
}

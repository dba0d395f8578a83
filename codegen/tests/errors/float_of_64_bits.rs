pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = 1.0f64;
    color.load(pixel)
}

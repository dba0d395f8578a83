pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = 1.0
    let y = 2.0;
    color.load(pixel)
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = async { 1.0 };
    color.load(pixel)
}

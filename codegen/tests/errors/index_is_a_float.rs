pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = [1.0, 2.0];
    color.load(pixel) * a[1.0]
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = vec![1.0, 2.0];
    color.load(pixel) * v[0]
}

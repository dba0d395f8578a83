pub fn k(color: &Frame<Vec4>, pixel: IVec2) {
    let _ = color.load(pixel);
}

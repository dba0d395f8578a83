pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let s = if color.load(pixel).x > 0.5 { (1.0, 2.0) } else { (1.0, 2.0, 3.0) };
    color.load(pixel)
}

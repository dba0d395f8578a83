pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut x = 0.0;
    for i in 0..2_000_000_000 {
        x += 1.0;
    }
    color.load(pixel) * x
}

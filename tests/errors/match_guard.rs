pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = match 3 {
        n if n > 2 => 1.0,
        _ => 0.0,
    };
    color.load(pixel) * x
}

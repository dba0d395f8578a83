pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    match pixel.x & 1 {
        0 => color.load(pixel),
        1 => Vec4::ONE,
        _ => unreachable!(),
    }
}

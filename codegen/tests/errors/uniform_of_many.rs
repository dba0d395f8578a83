pub fn k(color: &Frame<Vec4>, names: &[usize; 3], pixel: IVec2) -> Vec4 {
    if names[0] > 0 { color.load(pixel) } else { Vec4::ZERO }
}

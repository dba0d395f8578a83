pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(fwidth(color.load(pixel).x))
}

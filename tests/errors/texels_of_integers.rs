pub fn k(color: &Frame<UVec4>, pixel: IVec2) -> Vec4 {
    Vec4::ONE
}

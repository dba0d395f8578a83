pub fn k(color: &Frame<Mat3>, pixel: IVec2) -> Vec4 {
    Vec4::ONE
}

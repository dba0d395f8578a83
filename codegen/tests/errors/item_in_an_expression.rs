pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel)
        * {
            fn inner() -> f32 {
                1.0
            }
            inner()
        }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut a = 1.0;
    #[cfg(feature = "fast")]
    {
        a = 2.0;
    }
    #[cfg(any(unix, test))]
    let b = 1.0;
    color.load(pixel) * a
}

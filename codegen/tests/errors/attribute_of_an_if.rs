pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    #[cfg_attr(false, flatten)]
    if pixel.x > 3 {
        sum += 1.0;
    }
    color.load(pixel) * sum
}

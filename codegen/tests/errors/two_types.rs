pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = pixel.x + 1u32;
    let b = color.load(pixel).x + pixel.x;
    color.load(pixel)
}

// binding: color=1000
pub fn k(color: &Frame<Vec4>, image: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) + image.load(pixel)
}

pub fn k(texture: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    texture.load(pixel)
}

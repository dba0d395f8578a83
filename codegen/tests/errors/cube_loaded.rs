pub fn k(around: &TextureCube<Vec4>, pixel: IVec2) -> Vec4 {
    around.load(pixel)
}

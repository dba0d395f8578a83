pub fn k(color: &Frame<Vec4>, out: &StorageTexture<Vec4>, pixel: IVec2) -> Vec4 {
    out.store(pixel, color.load(pixel));
    out.load(pixel)
}

pub fn k(color: &Frame<Vec4>, out: &StorageTexture<bool>, pixel: IVec2) -> Vec4 {
    out.store(pixel, true);
    color.load(pixel)
}

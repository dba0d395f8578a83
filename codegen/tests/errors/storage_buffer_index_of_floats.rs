pub fn k(color: &Frame<Vec4>, out: &StorageBuffer<Vec4>, pixel: IVec2) {
    let here = color.load(pixel);
    out.store(here.x, here);
}

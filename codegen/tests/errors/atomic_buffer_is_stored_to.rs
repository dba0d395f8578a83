pub fn k(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, pixel: IVec2) {
    bins.store(0, color.load(pixel).x as u32);
}

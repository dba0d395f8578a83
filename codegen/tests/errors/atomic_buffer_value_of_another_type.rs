pub fn k(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, pixel: IVec2) {
    bins.add(0, color.load(pixel).x);
}

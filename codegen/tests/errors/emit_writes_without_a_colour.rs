// stage: fragment
pub fn k(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, pixel: IVec2) {
    bins.add((color.load(pixel).x * 8.0) as usize, 1);
}

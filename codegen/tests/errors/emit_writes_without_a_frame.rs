pub fn k(image: &Texture<Vec4>, bins: &AtomicBuffer<u32>, pixel: IVec2) {
    bins.add((image.load(pixel).x * 8.0) as usize, 1);
}

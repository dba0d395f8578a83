pub fn k(counts: &AtomicBuffer<u32>, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let drawn = [1, 2].into_iter().map(|k: usize| counts.add(k, 1));
    let largest = drawn.fold(0u32, |most, n| most.max(n));
    color.load(pixel) * largest as f32
}

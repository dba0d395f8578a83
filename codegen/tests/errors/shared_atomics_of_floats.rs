pub fn k(sums: &AtomicShared<[f32; 8]>, group: &Workgroup<8, 8>) -> PerThread<f32> {
    group.each(|thread| sums.load(thread.index))
}

pub fn k(sums: &Shared<f32>, group: &Workgroup<8, 8>) -> PerThread<f32> {
    group.each(|thread| sums.load(thread.index))
}

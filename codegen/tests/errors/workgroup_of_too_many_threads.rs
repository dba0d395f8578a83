pub fn k(group: &Workgroup<32, 16>) -> PerThread<f32> {
    group.each(|_| 1.0)
}

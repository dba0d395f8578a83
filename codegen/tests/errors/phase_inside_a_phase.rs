pub fn k(group: &Workgroup<8, 8>) -> PerThread<f32> {
    group.each(|_| {
        group.each(|_| 1.0);
        2.0
    })
}

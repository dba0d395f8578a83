pub fn k(group: &Workgroup<8, 8>) -> PerThread<f32> {
    let mut sum = 0.0;
    group.each(|thread| sum += thread.index as f32);
    group.each(|_| sum)
}

pub fn k(sums: &Shared<[Vec3; 8]>, group: &Workgroup<8, 8>) -> PerThread<Vec3> {
    group.each(|thread| sums.load(thread.index))
}

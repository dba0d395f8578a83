pub fn k(sums: &Shared<[u32; 8]>, group: &Workgroup<8, 8>) -> PerThread<u32> {
    group.each(|thread| sums.add(thread.index, 1))
}

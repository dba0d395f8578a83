pub fn k(bins: &AtomicBuffer<u32>, color: &Frame<Vec4>, group: &Workgroup<8, 8>) {
    bins.add(0, 1);
    group.each(|thread| bins.add(thread.index, 1));
}

// The old value of an atomic operation is the result of one side of a branch. The branch's variable replaced it, but the
// operation went on writing to the variable that was gone.
pub fn k(a: &Frame<Vec4>, q: u32, ha: &AtomicShared<[u32; 2]>, group: &Workgroup<2, 1>) -> PerThread<Vec4> {
    group.each(|thread| ha.add(thread.index, q));
    group.each(|thread| {
        let first = ha.load(thread.index);
        if thread.inside {
            let second = if q > 0 { ha.load(thread.index) } else { first + first };
            ha.max(thread.index, second & 0xffff);
        }
        a.load(thread.pixel) + (first & 0xffff) as f32
    })
}

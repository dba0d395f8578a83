pub fn k(color: &Frame<Vec4>, sums: &Shared<[f32; 16]>, group: &Workgroup<4, 4>) {
    group.each(|thread| sums.store(thread.index, color.load(thread.pixel).x));
}

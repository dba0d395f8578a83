pub fn k(tile: &Shared<[Vec4; 1025]>, group: &Workgroup<8, 8>) -> PerThread<Vec4> {
    group.each(|thread| tile.load(thread.index))
}

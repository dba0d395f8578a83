pub fn k(color: &Frame<Vec4>, pixel: IVec2, group: &Workgroup<8, 8>) -> PerThread<Vec4> {
    group.each(|_| color.load(pixel))
}

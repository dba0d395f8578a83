pub fn k(color: &Frame<Vec4>, group: &Workgroup<8, 8>) -> Vec4 {
    color.load(group.origin())
}

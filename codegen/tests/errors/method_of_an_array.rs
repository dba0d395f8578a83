pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut all = color.load(pixel).to_array();
    all.sort_unstabel();
    Vec4::from_array(all)
}

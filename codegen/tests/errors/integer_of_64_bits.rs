pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = 0x1_0000_0000;
    let y = 5u64;
    color.load(pixel)
}

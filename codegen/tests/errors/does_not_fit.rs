pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let n = 4_000_000_000u32;
    let m: i32 = 5_000 * 1_000_000;
    color.load(pixel)
}

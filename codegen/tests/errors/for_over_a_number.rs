pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for i in 5 {
        sum += 1.0;
    }
    Vec4::splat(sum)
}

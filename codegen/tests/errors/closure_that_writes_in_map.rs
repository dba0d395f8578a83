pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut n = 0.0;
    let sums = [1.0, 2.0].map(|x| {
        n += x;
        n
    });
    color.load(pixel) * sums[1]
}

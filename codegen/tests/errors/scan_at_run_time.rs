pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let row = [0, 1, 2].map(|k| color.load(pixel + ivec2(k, 0)).x);
    let sums = row.iter().scan(0.0, |sum, x| {
        *sum += x;
        if *sum < 1.0 { Some(*sum) } else { None }
    });
    Vec4::splat(sums.sum())
}

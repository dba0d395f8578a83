pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for i in 0..8 {
        let tap = color.load(pixel + ivec2(i, 0)).x;
        if tap > 0.5 {
            break;
        }
        sum += tap;
    }
    Vec4::splat(sum)
}

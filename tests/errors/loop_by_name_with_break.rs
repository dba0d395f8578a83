// unroll-loop: k.i=none
pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for i in 0..8 {
        if i * i > 30 {
            break;
        }
        sum += color.load(pixel + ivec2(i, 0));
    }
    sum
}

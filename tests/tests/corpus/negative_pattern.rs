// A negative literal as a pattern was refused as more than 32 bits.
// expect 0 0: 5 5 5 5

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for i in -1..=1 {
        sum += match i {
            -1 => 1.0,
            _ => 2.0,
        };
    }
    Vec4::splat(sum)
}

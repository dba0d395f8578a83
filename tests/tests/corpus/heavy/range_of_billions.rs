// Memory for every value of the range is taken before the first round: the process is aborted.

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    for i in 0..2000000000 {
        break;
    }
    Vec4::ZERO
}

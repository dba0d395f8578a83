enum Mode {
    First,
    Second,
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let m = Mode::Third;
    color.load(pixel)
}

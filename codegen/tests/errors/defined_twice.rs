fn g() -> f32 {
    1.0
}

mod other {
    fn g() -> f32 {
        2.0
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * g()
}

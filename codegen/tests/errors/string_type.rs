fn g(x: &dyn Copy) -> f32 {
    1.0
}

fn dyn_value() -> f32 {
    1.0
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * g(dyn_value())
}

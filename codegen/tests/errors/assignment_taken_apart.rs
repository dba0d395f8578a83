fn first((x, 0..=3): (f32, i32)) -> f32 {
    x
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (mut a, b) = (1.0, 2.0);
    (a, b) = (b, a);
    (a, 2.0) = (3.0, first((a, pixel.x)));
    color.load(pixel) * a * b
}

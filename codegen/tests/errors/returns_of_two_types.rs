fn f(x: f32) -> f32 {
    if x > 0.5 {
        return 1;
    }
    x
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(f(color.load(pixel).x))
}

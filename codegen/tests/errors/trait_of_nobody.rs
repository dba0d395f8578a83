fn area<T: Shape>(x: T) -> f32 {
    T::area(x)
}
pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(area(color.load(pixel).x))
}

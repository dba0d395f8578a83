pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> (f32, f32, f32, f32, f32, f32, f32, f32, f32) {
    let x = color.load(pixel).x;
    (x, x, x, x, x, x, x, x, x)
}

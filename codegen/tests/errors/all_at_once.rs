pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = missing(1.0);
    let b: f32 = pixel.x;
    let c = 2.0;
    c += b;
    color.load(pixel) * a
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x: f32 = pixel.x;
    let v: Vec3 = color.load(pixel);
    color.load(pixel)
}

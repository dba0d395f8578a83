pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let a = c.x.clamp(1.0, 0.5);
    let b = c.clamp(Vec4::ZERO, vec4(1.0, 1.0, -1.0, 1.0));
    let d = pixel.x.clamp(3, -3);
    b * a * d as f32
}

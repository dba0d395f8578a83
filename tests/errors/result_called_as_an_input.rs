pub struct GBuffer {
    pub albedo: Vec4,
    pub color: f32,
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> GBuffer {
    let here = color.load(pixel);
    GBuffer { albedo: here, color: here.x }
}

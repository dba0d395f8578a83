pub struct Surface {
    pub normal: Vec3,
    pub depth: f32,
}

pub struct GBuffer {
    pub albedo: Vec4,
    pub surface: Surface,
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> GBuffer {
    let here = color.load(pixel);
    let surface = Surface { normal: here.xyz(), depth: here.w };
    GBuffer { albedo: here, surface }
}

pub struct Light {
    pub position: Vec3,
    pub kind: u32,
    pub powers: [f32; 3],
}

/// Matrices, arrays and structures.
pub fn graded(
    lights: &Buffer<Light>,
    grade: Mat3,
    palette: &[Vec3; 4],
    weights: &[f32; 3],
    offset: Vec2,
    steps: i32,
    pixel: IVec2,
) -> Vec4 {
    let light = lights.load((pixel.y & 1) as usize);
    let tint = grade * palette[(pixel.x & 3) as usize] + light.position * light.powers[1];
    tint.extend(weights[2] * offset.x + (steps + light.kind as i32) as f32)
}

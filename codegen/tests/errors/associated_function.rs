pub fn k(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    let turn = Mat3::from_rotation(Vec3::Z, strength);
    (turn * color.load(pixel).truncate()).extend(1.0)
}

pub fn k(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    let turn = Affine2::from_angle(strength);
    color.load(turn.transform_point2(pixel.as_vec2()).as_ivec2())
}

pub fn k(around: &TextureCube<UVec2>, pixel: IVec2) -> Vec4 {
    Vec4::splat(around.size().x as f32)
}

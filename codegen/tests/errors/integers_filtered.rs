pub fn k(ids: &Texture<u32>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    Vec4::splat(ids.sample(linear, pixel.as_vec2()) as f32)
}

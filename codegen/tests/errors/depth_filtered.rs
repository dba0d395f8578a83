pub fn k(shadow: &DepthTexture, linear: &Sampler, pixel: IVec2) -> Vec4 {
    Vec4::splat(shadow.sample(linear, pixel.as_vec2()))
}

pub fn k(stack: &TextureArray<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    stack.sample(linear, pixel.as_vec2())
}

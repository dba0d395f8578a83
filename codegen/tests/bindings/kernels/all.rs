/// Resources of every kind that kernels read.
pub fn all(
    color: &Frame<Vec4>,
    stack: &FrameLayers<f32>,
    samples: &Multisampled<Vec4>,
    image: &Texture<Vec4>,
    linear: &Sampler,
    shadow: &DepthTexture,
    less: &ComparisonSampler,
    weights: &Buffer<f32>,
    tau: f32,
    pixel: IVec2,
) -> Vec4 {
    let uv = (pixel.as_vec2() + 0.3) / image.size().as_vec2();
    let lit = shadow.compare(less, uv, 0.5);
    let near = color.load(pixel + ivec2(1, 2)) * tau + image.sample(linear, uv) * weights.load((pixel.x % 3) as usize);
    near + samples.load(pixel / 2, 1) * stack.load(pixel, 2) + lit
}

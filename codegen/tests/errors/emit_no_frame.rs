// stage: fragment
pub fn k(image: &Texture<Vec4>, s: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
    image.sample(s, pixel.as_vec2() / resolution.as_vec2())
}

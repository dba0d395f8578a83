pub fn k(image: &Texture<Vec4>, s: &ComparisonSampler, pixel: IVec2) -> Vec4 {
    image.sample(s, pixel.as_vec2())
}

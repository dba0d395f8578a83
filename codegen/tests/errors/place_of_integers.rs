pub fn k(image: &Texture<Vec4>, s: &Sampler, pixel: IVec2) -> Vec4 {
    image.sample(s, pixel)
}

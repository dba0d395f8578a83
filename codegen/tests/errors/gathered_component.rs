pub fn k(image: &Texture<Vec2>, s: &Sampler, pixel: IVec2) -> Vec4 {
    image.gather(2, s, pixel.as_vec2())
}

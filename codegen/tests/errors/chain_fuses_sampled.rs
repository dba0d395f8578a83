// fuse: half
pub fn k(color: &Texture<Vec4>, linear: &Sampler) -> Texture<Vec4> {
    let half: Texture<Vec4> = draw(color.size() / 2, |pixel| color.load(pixel * 2));
    draw(color.size(), |pixel| half.sample(linear, (pixel.as_vec2() + 0.5) / color.size().as_vec2()))
}

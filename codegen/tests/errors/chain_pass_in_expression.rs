pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    let sum = total(&draw(color.size(), |pixel| color.load(pixel)));
    draw(color.size(), |pixel| color.load(pixel) * sum)
}

fn total(color: &Texture<Vec4>) -> f32 {
    color.load(ivec2(0, 0)).x
}

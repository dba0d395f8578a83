pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    draw(uvec2(color.size().y, color.size().x), |pixel| color.load(pixel.yx()))
}

pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    draw(color.size() / 0, |pixel| color.load(pixel))
}

pub fn k(color: &Texture<Vec4>, strength: f32) -> Texture<Vec4> {
    if strength > 0.5 {
        draw(color.size(), |pixel| color.load(pixel) * 2.0)
    } else {
        draw(color.size(), |pixel| color.load(pixel))
    }
}

pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    let rows = draw(color.size(), |pixel| color.load(pixel));
    draw(color.size(), |pixel| rows.load(pixel))
}

pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    let first: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    let levels = vec![first];
    let from = &levels[1];
    draw(color.size(), |pixel| from.load(pixel))
}

pub fn k(color: &Texture<Vec4>, which: usize) -> Texture<Vec4> {
    let first: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    let levels = vec![first];
    draw(color.size(), |pixel| levels[which].load(pixel))
}

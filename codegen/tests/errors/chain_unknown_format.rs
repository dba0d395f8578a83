pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    #[cfg_attr(false, format(rgb8))]
    let rows: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    draw(color.size(), |pixel| rows.load(pixel))
}

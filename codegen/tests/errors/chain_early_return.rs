pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    let rows: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    if 1 < 2 {
        return rows;
    }
    draw(color.size(), |pixel| rows.load(pixel))
}

pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    let mut current: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    let corner = current.load(ivec2(0, 0));
    current = draw(color.size(), |pixel| current.load(pixel) * 0.5);
    draw(color.size(), |pixel| current.load(pixel) + corner)
}

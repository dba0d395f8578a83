pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    let mut side = 1;
    while side > 0 {
        side = 2 - side;
    }
    draw(color.size(), |pixel| color.load(pixel))
}

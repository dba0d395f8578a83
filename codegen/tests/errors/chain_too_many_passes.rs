pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    let mut current: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    for _ in 0..1000 {
        current = draw(color.size(), |pixel| current.load(pixel) * 0.5);
    }
    current
}

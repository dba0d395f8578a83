pub fn k(color: &Texture<Vec4>, strength: f32) -> Texture<Vec4> {
    let a: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    let mut current: Texture<Vec4> = draw(color.size(), |pixel| a.load(pixel) * 2.0);
    if strength > 0.5 {
        current = a;
    }
    draw(color.size(), |pixel| current.load(pixel))
}

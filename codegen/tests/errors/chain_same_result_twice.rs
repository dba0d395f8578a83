pub fn k(color: &Texture<Vec4>) -> (Texture<Vec4>, Texture<Vec4>) {
    let a: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    (a, a)
}

pub fn k(color: &Texture<Vec4>) -> Texture<Vec4> {
    k(color)
}

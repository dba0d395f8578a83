pub fn k(color: &Texture<Vec4>, pixel: IVec2) -> Texture<Vec4> {
    draw(color.size(), |p| color.load(p + pixel))
}

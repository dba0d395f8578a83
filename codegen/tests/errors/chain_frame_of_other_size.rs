pub fn k(color: &Frame<Vec4>) -> Texture<Vec4> {
    let half: Texture<Vec4> = draw(color.size() / 2, |pixel| color.load(pixel * 2));
    draw(color.size(), |pixel| half.load(pixel / 2))
}

pub fn k(color: &Texture<Vec4>, across: u32) -> Texture<Vec4> {
    draw(uvec2(across, 4), |pixel| color.load(pixel))
}

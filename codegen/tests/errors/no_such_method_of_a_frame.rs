pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let uv = pixel.as_vec2();
    color.sample(uv)
}

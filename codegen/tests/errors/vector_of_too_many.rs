pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = vec3(1.0, 2.0, 3.0, 4.0);
    color.load(pixel)
}

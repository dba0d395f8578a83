pub fn k(color: &Frame<Vec4>, names: &[String], pixel: IVec2) -> Vec4 {
    color.load(pixel)
}

fn head(values: &[f32]) -> f32 {
    values.split_first().0
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(head(&color.load(pixel).to_array()))
}

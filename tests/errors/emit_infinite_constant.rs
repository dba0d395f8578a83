pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let far = f32::MAX * 2.0;
    color.load(pixel).min(Vec4::splat(far))
}

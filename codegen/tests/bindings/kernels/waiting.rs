/// A loop that runtime values end.
pub fn waiting(color: &Frame<Vec4>, limit: f32, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    while sum < limit {
        sum += 1.0 + color.load(pixel).x.abs();
    }
    Vec4::splat(sum)
}

type Near = Far;
type Far = Near;
pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x: Near = color.load(pixel);
    x
}

#[cfg_attr(false, exakt)]
fn difference(a: f32, b: f32) -> f32 {
    #[cfg_attr(false, exact)]
    let sum = a + b;
    sum - a
}

#[cfg_attr(false, bound(3))]
struct Pair {
    a: f32,
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    #[cfg_attr(false, extact)]
    let c = color.load(pixel);
    #[cfg_attr(false, exact)]
    const SCALE: f32 = 2.0;
    let pair = Pair { a: difference(c.x, c.y) };
    Vec4::splat(pair.a * SCALE)
}

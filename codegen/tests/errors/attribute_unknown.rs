#[instrument(level = "debug")]
fn half(x: f32) -> f32 {
    x * 0.5
}

#[cfg_attr(feature = "serde", derive(Serialize))]
#[cfg_attr(false, unroll(4))]
const N: u32 = 4;

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    #[unroll(none)]
    for y in 0..4 {}
    #[cfg_attr(test, unroll(none))]
    for x in 0..4 {}
    #[cfg_attr(false, branch)]
    let a = half(1.0);
    color.load(pixel) * a
}

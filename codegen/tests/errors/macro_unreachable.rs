fn component(v: Vec4, k: u32) -> f32 {
    match k {
        0 => v.x,
        1 => v.y,
        _ => unreachable!("no component {k}"),
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * component(color.load(pixel), 2)
}

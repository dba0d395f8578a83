fn add(x: f32) -> f32 {
    x + 1.0
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = (add)(1.0);
    let y = [add][0](1.0);
    color.load(pixel) * x
}

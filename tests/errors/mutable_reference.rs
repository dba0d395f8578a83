fn add(x: &mut f32) {
    *x += 1.0;
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut x = 1.0;
    add(&mut x);
    color.load(pixel) * x
}

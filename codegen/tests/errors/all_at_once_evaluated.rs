pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let b = color.load(pixel).x.exp_m1();
    let c = [1.0, 2.0][2];
    Vec4::splat(b * c)
}

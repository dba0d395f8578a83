pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = color.load(pixel);
    let b = a.x.mul_add(a.y, 1.0);
    let c = a.y.exp_m1();
    let d = a.z.ln_1p();
    vec4(b, c, d, 1.0)
}

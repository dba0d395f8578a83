pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = color.load(pixel);
    let b = a.x.cbrt() + a.y.hypot(a.z);
    let c = a.mul_add(a, a);
    let d = a.w.exp_m1() + a.w.ln_1p() + a.w.log10() + a.w.log(2.0);
    let e = i32::from(a.x);
    c * (b + d + e as f32)
}

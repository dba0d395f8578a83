pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = color.load(pixel);
    let b = a.x.round();
    let c = a.y.fract();
    let d = a.z.signum();
    vec4(b, c, d, 1.0)
}

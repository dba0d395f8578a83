pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = color.load(pixel);
    let b = a.normalize_or(a.xyz());
    let mask = a.cmplt(Vec4::ONE) + a.cmpgt(Vec4::ZERO);
    let c = Vec4::select(a.xyz().cmplt(Vec3::ONE), a, b);
    c.with_x(1) * mask
}

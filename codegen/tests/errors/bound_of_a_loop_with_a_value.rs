pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut x = color.load(pixel).x;
    #[cfg_attr(false, bound(8))]
    loop {
        x *= 0.5;
        if x < 0.1 {
            return Vec4::splat(x);
        }
    }
}

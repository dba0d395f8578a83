pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let bright = here.x > 0.5 && {
        if here.y > 0.5 {
            return Vec4::ONE;
        }
        here.z > 0.5
    };
    if bright { here } else { Vec4::ZERO }
}

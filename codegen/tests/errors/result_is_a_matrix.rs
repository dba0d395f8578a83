pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Mat2 {
    let here = color.load(pixel);
    Mat2::from_cols(here.xy(), here.zw())
}

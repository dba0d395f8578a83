pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut a = [1.0, 2.0];
    a[pixel.x as usize * 0 - 1] = 3.0;
    color.load(pixel)
}

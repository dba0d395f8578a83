pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let endless = [1.0_f32, 2.0].iter().cycle();
    color.load(pixel)
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    println!("{}", pixel.x);
    color.load(pixel)
}

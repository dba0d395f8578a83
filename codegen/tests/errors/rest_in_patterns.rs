pub struct Triple(f32, f32, f32);

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let row = color.load(pixel).to_array();
    let [a, .., b, ..] = row;
    let (rest @ .., c) = (a, b);
    let Triple(.., d) = Triple(a, b, c);
    color.load(pixel) * d
}

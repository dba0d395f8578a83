// stage: fragment
// origin: lower-left
pub fn k(color: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let [own, beside, below, across] = color.load(pixel).gather();
    own + beside + below + across
}

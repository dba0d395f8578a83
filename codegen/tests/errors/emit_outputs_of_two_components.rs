// target: essl310
pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec2 {
    color.load(pixel).xy()
}

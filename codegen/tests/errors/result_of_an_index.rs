pub fn k(pixel: IVec2) -> usize {
    7
}

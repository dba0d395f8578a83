pub fn k(sums: &Shared<[u32; 8]>, pixel: IVec2) -> u32 {
    sums.load(pixel.x as usize)
}

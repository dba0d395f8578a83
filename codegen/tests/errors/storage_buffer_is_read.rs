pub fn k(out: &StorageBuffer<Vec4>, pixel: IVec2) -> Vec4 {
    out.load(pixel.x as usize)
}

pub fn k(table: &Texture3D<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    table.sample(linear, pixel.as_vec2())
}

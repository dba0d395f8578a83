// A known zero beside lanes that are runtime values was written as such, which WGSL refuses.
// expect 1 1: 1 2 3 4

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    (ivec4(1, 2, 3, 4) / ivec4(pixel.x, 0, 0, 0)).as_vec4()
}

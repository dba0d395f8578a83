// `1 << 31` of known `i32` is `i32::MIN` in Rust.
// expect 0 0: -2147483648 -2147483648 -2147483648 -2147483648

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x: i32 = 1 << 31;
    Vec4::splat(x as f32)
}

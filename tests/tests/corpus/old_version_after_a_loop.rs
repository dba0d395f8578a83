// An array that a structured loop changed and the kernel changes again: cannot be emitted where it is then read at an index
// that is known and at one that is not, "uses an old version of the array".
// expect 0 0: 2 2 2 2

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [0.0, 0.0, 0.0, 0.0];
    for i in 0..2 {
        v[0] += 0.5;
    }
    v[1] += 1.0;
    Vec4::splat(v[0] + v[pixel.x.clamp(0, 3) as usize])
}

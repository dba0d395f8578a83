// Parts of a pattern were kept in variables `_0` and `_1`, which a kernel may have too.
// expect 0 0: 1 4 321 7

fn taken((a, b): (f32, f32), _0: f32) -> f32 {
    a + b * 10.0 + _0 * 100.0
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let _0 = 1;
    let mut v = [0.0, 0.0];
    let mut x = 3.0;
    (x, v[_0]) = (x + 4.0, x + 1.0);
    vec4(_0 as f32, v[1], taken((1.0, 2.0), 3.0), x)
}

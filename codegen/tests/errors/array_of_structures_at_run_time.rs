#[derive(Clone, Copy)]
struct S {
    x: f32,
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut a = [S { x: 1.0 }, S { x: 2.0 }];
    a[pixel.x as usize].x = 3.0;
    color.load(pixel) * a[0].x
}

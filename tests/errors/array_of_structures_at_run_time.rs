#[derive(Clone, Copy)]
struct S {
    x: f32,
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = [S { x: 1.0 }, S { x: 2.0 }];
    color.load(pixel) * a[pixel.x as usize].x
}

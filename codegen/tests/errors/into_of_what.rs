#[derive(Clone, Copy)]
struct Complex(f32, f32);

impl From<Vec2> for Complex {
    fn from(v: Vec2) -> Self {
        Complex(v.x, v.y)
    }
}

impl From<f32> for Complex {
    fn from(x: f32) -> Self {
        Complex(x, 0.0)
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let a = here.x.into();
    let b: Complex = pixel.into();
    let c = Complex::from(here);
    let d: Complex = Default::default();
    here * b.0 * c.0 * d.0
}

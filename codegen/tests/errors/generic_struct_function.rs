struct Curve<F: Fn(f32) -> u32> {
    f: F,
}

struct Pair<A, B> where A: Fn(f32) -> f32, B: Fn(f32, f32) -> f32 {
    a: A,
    b: B,
}

impl<A: Fn(f32) -> f32, B: Fn(f32, u32) -> f32> Pair<A, B> {
    fn both(&self, x: f32) -> f32 { (self.a)(x) + (self.b)(x, 1) }
}

enum Shape<F: Fn(f32) -> f32> {
    Flat,
    Curved(F),
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let curve = Curve { f: |x: f32| x * 2.0 };
    let pair = Pair { a: |x| x, b: |x: f32, y: f32| x * y };
    let shape = Shape::Curved(|x: f32| x > 1.0);
    let bent = match shape { Shape::Flat => 1.0, Shape::Curved(f) => f(0.5) };
    color.load(pixel) * bent * (curve.f)(0.5) * pair.both(0.5)
}

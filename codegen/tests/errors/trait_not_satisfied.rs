trait Shape {
    const STEP: f32;
    fn distance(&self, at: Vec3) -> f32;
}

struct Ball(f32);
struct Slab(Vec3);

impl Shape for Ball {
    const STEP: f32 = 1.0;
    fn distance(&self, at: Vec3) -> f32 {
        at.length() - self.0
    }
}

fn march<S: Shape>(shape: &S, from: Vec3) -> f32 {
    shape.distance(from) * S::STEP
}

fn far(shape: &impl Shape) -> f32 {
    march(shape, 8.0)
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let a = march(&Slab(Vec3::ONE), here.truncate());
    let b = march(&1.0, here.truncate());
    let c = Shape::distance(&Ball(1.0), here);
    let d = Shape::distance(&Slab(Vec3::ONE), here.truncate());
    here * a * b * c * d * far(&Ball(1.0))
}

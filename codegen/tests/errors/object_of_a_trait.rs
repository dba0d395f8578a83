trait Shape {
    const STEP: f32;
    fn distance(&self, at: Vec3) -> f32;
}

struct Ball(f32);

impl Shape for Ball {
    const STEP: f32 = 1.0;
    fn distance(&self, at: Vec3) -> f32 {
        at.length() - self.0
    }
}

fn far(shape: &dyn Shape, at: Vec3) -> f32 {
    shape.distance(at)
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let x: &dyn Copy = &here.x;
    here * far(&Ball(1.0), here.truncate())
}

trait Shape {
    const STEP: f32;
    fn distance(&self, at: Vec3) -> f32;
    fn made(radius: f32) -> Self;
}

struct Ball(f32);

impl Shape for Ball {
    fn distance(&self, at: Vec3) -> f32 {
        at.length() - self.0
    }
    fn radius(&self) -> f32 {
        self.0
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let ball = Ball(0.5);
    here * ball.distance(here.truncate()) * ball.radius()
}

use std::f32::consts::PI as PART;
use straightline_kernels::sraa::weigh as weight;

type Colour = Vec3;
type Pair<T> = (T, T);
static mut COUNT: i32 = 0;

fn half(x: f32) -> f32 {
    type Colour = Vec4;
    let c: Colour = Vec4::splat(x);
    c.x * 0.5
}

fn third(x: f32) -> f32 {
    use std::f32::consts::TAU as PART;
    fn half(x: f32) -> f32 {
        x / 3.0
    }
    half(x) * PART
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here: Colour = color.load(pixel).truncate();
    let both: Pair<f32> = (here.x, here.y);
    (here * half(both.0) * third(both.1) * COUNT as f32).extend(weight(1.0))
}

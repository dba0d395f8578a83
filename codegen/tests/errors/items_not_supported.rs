use noise::hash;
use std::f32::consts::TAU as FULL;

type Colour = Vec4;

static SCALE: f32 = 2.0;

trait Shade {
    fn shade(self) -> f32;
}

impl Shade for f32 {
    fn shade(self) -> f32 {
        self * 0.5
    }
}

enum Shape {
    Round(f32),
    square = 3,
}

struct Vec3 {
    x: f64,
}

unsafe extern "C" {
    fn sinf(x: f32) -> f32;
}

macro_rules! twice {
    ($x:expr) => {
        $x * 2.0
    };
}

unsafe fn raw(x: f32) -> f32 {
    x
}

async fn later(x: f32) -> f32 {
    x
}

const small: f32 = 1.0;

// Nothing of this is reached.
extern "C" fn far(x: f64, rest: ...) -> f64 {
    x
}
static mut OTHER: f64 = 1.0;

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here: Colour = color.load(pixel);
    let a = here.x.shade() + hash(here.y) * FULL * SCALE * small;
    let b = sinf(a) + raw(a) + later(a) + twice!(a);
    let s = Shape::square;
    let v = Vec3 { x: 1.0 };
    here * a * b
}

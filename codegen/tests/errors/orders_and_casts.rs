#[derive(Clone, Copy)]
enum Held {
    None,
    One(f32),
}

#[derive(Clone, Copy)]
enum Plain {
    A,
    B,
}

#[derive(Clone, Copy, PartialEq)]
struct Unordered(f32);

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let held = if pixel.x > 3 { Held::None } else { Held::One(1.0) };
    let plain = if pixel.y > 3 { Plain::A } else { Plain::B };
    let order = Unordered(here.x) < Unordered(here.z);
    let vectors = here < here;
    if order || vectors { here * held as i32 as f32 * plain as f32 } else { Vec4 { x: 1.0, y: 0.0, z: 0.0, w: 1.0 } }
}

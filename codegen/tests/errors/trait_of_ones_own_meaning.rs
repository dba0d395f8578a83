use std::ops::{Deref, Mul};

#[derive(Clone, Copy, PartialEq)]
struct Level(f32);

impl Deref for Level {
    type Target = f32;

    fn deref(&self) -> &f32 {
        &self.0
    }
}

trait Ends {
    fn first(&self) -> f32;
}

impl Ends for [f32; 2] {
    fn first(&self) -> f32 {
        self[0]
    }
}

trait Halved {
    fn halved(self) -> Self;
}

impl<T: Mul<f32, Output = T>> Halved for T {
    fn halved(self) -> T {
        self * 0.5
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let a = [here.x, here.y].first();
    let b = here.halved();
    if *Level(here.x) < *Level(here.y) { here * a } else { b }
}

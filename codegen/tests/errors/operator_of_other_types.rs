use std::ops::{Add, Index, Mul};

#[derive(Clone, Copy)]
struct Complex {
    re: f32,
    im: f32,
}

impl Add for Complex {
    type Output = Complex;
    fn add(self, other: Complex) -> Complex {
        Complex { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Mul<f32> for Complex {
    type Output = Complex;
    fn mul(self, by: f32) -> Complex {
        Complex { re: self.re * by, im: self.im * by }
    }
}

impl Index<usize> for Complex {
    type Output = f32;
    fn index(&self, k: usize) -> &f32 {
        if k == 0 { &self.re } else { &self.im }
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut z = Complex { re: here.x, im: here.y };
    let a = z * z;
    let b = z + 1.0;
    let c = z - z;
    let d = 2.0 * z;
    let e = -z;
    z += z;
    let f = z == z;
    let g = z * 2;
    let h: i32 = z[0];
    here * a.re * b.re * c.re * d.re * e.re * g.re
}

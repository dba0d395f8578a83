//! The Mandelbrot set by escape time (Peitgen and Richter, The Beauty of Fractals, 1986), with fractional iterations
//! for smooth colours (Vepstas, Renormalizing the Mandelbrot escape, 1997).

use std::ops::{Add, Mul};
use straightline_kernels::prelude::*;

/// Iterations after which a point counts as inside the set.
const MOST: u32 = 200;

#[derive(Clone, Copy)]
struct Complex {
    re: f32,
    im: f32,
}

impl Complex {
    fn norm_squared(self) -> f32 {
        self.re * self.re + self.im * self.im
    }
}

impl Add for Complex {
    type Output = Complex;
    fn add(self, other: Complex) -> Complex {
        Complex {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }
}

impl Mul for Complex {
    type Output = Complex;
    fn mul(self, other: Complex) -> Complex {
        Complex {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

/// Iterations until a point leaves a circle of radius 16; `None` if it does not.
fn escape(c: Complex) -> Option<f32> {
    let mut z = c;
    for k in 0..MOST {
        if z.norm_squared() > 256.0 {
            let past = z.norm_squared().log2().log2() - 3.0;
            return Some(k as f32 - past);
        }
        z = z * z + c;
    }
    None
}

/// Picture of the set, `scale` units high around `centre`.
pub fn mandelbrot(resolution: UVec2, centre: Vec2, scale: f32, pixel: IVec2) -> Vec4 {
    let size = resolution.as_vec2();
    let at = centre + (pixel.as_vec2() + 0.5 - 0.5 * size) * scale / size.y;
    let Some(count) = escape(Complex { re: at.x, im: at.y }) else {
        return vec4(0.0, 0.0, 0.0, 1.0);
    };
    let phase = vec3(0.0, 0.6, 1.0) + 3.0 + 0.15 * count;
    (0.5 + 0.5 * phase.map(f32::cos)).extend(1.0)
}

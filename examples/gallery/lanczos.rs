//! Resampling by a three-lobed Lanczos window (Duchon 1979), from any size to any larger size.

use std::f32::consts::PI;
use straightline_kernels::prelude::*;

fn sinc(x: f32) -> f32 {
    if x.abs() < 1.0e-4 {
        return 1.0;
    }
    (PI * x).sin() / (PI * x)
}

fn lanczos3(x: f32) -> f32 {
    if x.abs() < 3.0 { sinc(x) * sinc(x / 3.0) } else { 0.0 }
}

pub fn lanczos(image: &Texture<Vec4>, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let at = (pixel.as_vec2() + 0.5) / resolution.as_vec2() * image.size().as_vec2() - 0.5;
    let corner = at.floor();
    let from = corner.as_ivec2();
    let offset = at - corner;
    let mut columns = [0.0; 6];
    for x in 0..6 {
        columns[x] = lanczos3(x as f32 - 2.0 - offset.x);
    }
    let (mut sum, mut total) = (Vec4::ZERO, 0.0);
    for y in -2..=3 {
        let row = lanczos3(y as f32 - offset.y);
        for (x, column) in columns.iter().enumerate() {
            let weight = row * column;
            sum += image.load(from + ivec2(x as i32 - 2, y)) * weight;
            total += weight;
        }
    }
    sum / total
}

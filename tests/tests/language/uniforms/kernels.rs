use straightline_kernels::prelude::*;

#[derive(Clone, Copy, PartialEq)]
pub enum Mode {
    Sharp,
    Soft,
}

#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Blend {
    Over,
    Add,
    Multiply,
    Screen,
}

pub enum Only {
    One,
}

#[derive(Clone, Copy)]
pub struct Layer {
    pub blend: Blend,
    pub opaque: bool,
    pub amount: f32,
}

fn blended(blend: Blend, a: Vec4, b: Vec4) -> Vec4 {
    match blend {
        Blend::Over => b,
        Blend::Add => a + b,
        Blend::Multiply => a * b,
        Blend::Screen => a + b - a * b,
    }
}

pub fn modes(color: &Frame<Vec4>, mode: Mode, blend: Blend, only: Only, pixel: IVec2) -> Vec4 {
    let here = match only {
        Only::One => color.load(pixel),
    };
    let mut sum = Vec4::ZERO;
    let reach = if mode == Mode::Soft { 2 } else { 1 };
    for x in -reach..=reach {
        sum = blended(blend, sum, color.load(pixel + ivec2(x, 0)) * 0.25);
    }
    match (mode, blend) {
        (Mode::Sharp, Blend::Add | Blend::Screen) => sum + here,
        (Mode::Soft, Blend::Over) => sum * 0.5,
        _ => sum,
    }
}

pub fn layers(color: &Frame<Vec4>, layer: Layer, blends: [Blend; 3], pixel: IVec2) -> Vec4 {
    let mut sum = color.load(pixel);
    for (k, blend) in blends.iter().enumerate() {
        sum = blended(*blend, sum, color.load(pixel + ivec2(k as i32, 1)) * layer.amount);
    }
    let chosen = blends[(pixel.x & 1) as usize];
    let last = if layer.opaque && chosen != Blend::Add {
        layer.blend
    } else {
        chosen
    };
    blended(last, sum, Vec4::splat(0.5))
}

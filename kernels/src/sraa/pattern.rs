//! Where in a pixel geometry and shading are sampled. Offsets are in pixels from the pixel's centre, y down.

use super::Sraa;
use crate::prelude::*;

/// Where in a pixel geometry is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// A regular 2×2 grid.
    Ordered4,
    /// The rotated grid that graphics hardware uses for 4× multisampling (D3D's standard pattern).
    Latin4,
    /// A regular 4×4 grid.
    Ordered16,
    /// Sixteen distinct rows and columns of a 16×16 grid (D3D's standard pattern).
    Latin16,
}

/// Where in a pixel shading is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// At the first geometry sample: no geometry beyond the pattern's own is needed.
    Sample0,
    /// At the pixel's centre, whose geometry is one more layer, the last.
    Centre,
}

impl Pattern {
    /// Number of geometry samples in a pixel.
    pub fn samples(self) -> usize {
        match self {
            Pattern::Ordered4 => 4,
            Pattern::Latin4 => 4,
            Pattern::Ordered16 => 16,
            Pattern::Latin16 => 16,
        }
    }

    /// Offset of a geometry sample from the pixel's centre, each axis in -0.5..0.5 pixel.
    pub fn offset(self, sample: usize) -> Vec2 {
        match self {
            Pattern::Ordered4 => ordered(sample, 2),
            Pattern::Latin4 => LATIN4[sample].as_vec2() / 16.0,
            Pattern::Ordered16 => ordered(sample, 4),
            Pattern::Latin16 => LATIN16[sample].as_vec2() / 16.0,
        }
    }
}

impl Sraa {
    /// Offset of the shading sample from the pixel's centre.
    pub fn shaded_offset(&self) -> Vec2 {
        match self.shading {
            Shading::Sample0 => self.pattern.offset(0),
            Shading::Centre => vec2(0.0, 0.0),
        }
    }

    /// Layer of the G-buffer that holds the geometry of the shading sample.
    pub fn shaded_layer(&self) -> usize {
        match self.shading {
            Shading::Sample0 => 0,
            Shading::Centre => self.pattern.samples(),
        }
    }
}

/// Centre of cell `sample` of a `side` × `side` grid over the pixel, row by row.
fn ordered(sample: usize, side: usize) -> Vec2 {
    let cell = ivec2((sample % side) as i32, (sample / side) as i32);
    (cell.as_vec2() + 0.5) / side as f32 - 0.5
}

/// In sixteenths of a pixel.
const LATIN4: [IVec2; 4] = [ivec2(-2, -6), ivec2(6, -2), ivec2(-6, 2), ivec2(2, 6)];

/// In sixteenths of a pixel.
const LATIN16: [IVec2; 16] = [
    ivec2(1, 1),
    ivec2(-1, -3),
    ivec2(-3, 2),
    ivec2(4, -1),
    ivec2(-5, -2),
    ivec2(2, 5),
    ivec2(5, 3),
    ivec2(3, -5),
    ivec2(-2, 6),
    ivec2(0, -7),
    ivec2(-4, -6),
    ivec2(-6, 4),
    ivec2(-8, 0),
    ivec2(7, -4),
    ivec2(6, 7),
    ivec2(-7, -8),
];

//! Positions of the geometry and shading samples in a pixel. Offsets are in pixels from the pixel's centre, y down.

use super::gbuffer::{Layout, Normals};
use super::metric::Metric;
use super::options::{Normalisation, Resolve, Search, Sraa};
use crate::prelude::*;

/// Positions of the geometry samples in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Regular 2×2 grid.
    Ordered4,
    /// Rotated grid of 4× multisampling in graphics hardware (D3D's standard pattern).
    Latin4,
    /// Pattern of 8× multisampling in graphics hardware (D3D's standard pattern).
    Standard8,
    /// Regular 4×4 grid.
    Ordered16,
    /// Centres of sixteen cells of a 16×16 grid, in distinct rows and columns, whose mean is the pixel's centre. Samples are
    /// numbered quadrant by quadrant.
    Latin16,
    /// Pattern of 16× multisampling in graphics hardware (D3D's standard pattern): `latin16` moved 1/32 pixel up and to the
    /// left, in the hardware's order.
    Standard16,
    /// Offsets from the option `offsets`.
    Listed,
}

/// Positions of the shading samples in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// First geometry sample: no geometry beyond the pattern's own is needed.
    Sample0,
    /// Pixel's centre, where geometry is sampled too.
    Centre,
    /// Geometry samples listed in the option `shaded`.
    Listed,
    /// Position from the image `place`, per pixel: a geometry sample, or the pixel's centre, where geometry is sampled
    /// too. The kernel `sraa_place` writes that image.
    Placed,
}

/// Position of a sample relative to the filtered pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Pixel of the sample, relative to the filtered one.
    pub(super) pixel: IVec2,
    /// Index of the sample in its pixel; the number of samples for the pixel's centre.
    pub(super) sample: usize,
    /// `true` at the pixel's centre.
    pub(super) centre: bool,
    /// `true` for the pixel's further shading sample.
    pub(super) extra: bool,
    /// Offset from the centre of the filtered pixel, in pixels, y down.
    pub(super) at: Vec2,
}

impl Sraa {
    /// Number of geometry samples in a pixel, without the pixel's centre.
    pub fn samples(&self) -> usize {
        match self.pattern {
            Pattern::Ordered4 => 4,
            Pattern::Latin4 => 4,
            Pattern::Standard8 => 8,
            Pattern::Ordered16 => 16,
            Pattern::Latin16 | Pattern::Standard16 => 16,
            Pattern::Listed => self.offsets.len() / 2,
        }
    }

    /// Offset of a geometry sample from the pixel's centre, each axis in -0.5..=0.5 pixel.
    pub fn offset(&self, sample: usize) -> Vec2 {
        match self.pattern {
            Pattern::Ordered4 => ordered(sample, 2),
            Pattern::Latin4 => LATIN4[sample].as_vec2() / 16.0,
            Pattern::Standard8 => STANDARD8[sample].as_vec2() / 16.0,
            Pattern::Ordered16 => ordered(sample, 4),
            Pattern::Latin16 => (STANDARD16[VISITED16[sample]].as_vec2() + 0.5) / 16.0,
            Pattern::Standard16 => STANDARD16[sample].as_vec2() / 16.0,
            Pattern::Listed => vec2(self.offsets[2 * sample], self.offsets[2 * sample + 1]),
        }
    }

    /// Number of shading samples in a pixel.
    pub fn shading_samples(&self) -> usize {
        match self.shading {
            Shading::Sample0 | Shading::Centre | Shading::Placed => 1,
            Shading::Listed => self.shaded.len(),
        }
    }

    /// Geometry sample at which shading sample `k` lies. With shading=placed, the position that a pixel has unless the image
    /// moves it: the centre.
    pub fn shaded_sample(&self, k: usize) -> usize {
        match self.shading {
            Shading::Sample0 => 0,
            Shading::Centre | Shading::Placed => self.samples(),
            Shading::Listed => self.shaded[k] as usize,
        }
    }

    /// Panics if the options contradict each other.
    pub(super) fn check(&self) {
        let samples = self.samples();
        if self.pattern == Pattern::Listed {
            assert!(
                self.offsets.len().is_multiple_of(2),
                "`offsets` needs an x and a y for each sample: an even count of numbers"
            );
            assert!(
                (1..=64).contains(&samples),
                "pattern=listed needs 1 to 64 samples in `offsets`"
            );
            for later in 0..samples {
                for earlier in 0..later {
                    let (a, b) = (self.offset(earlier), self.offset(later));
                    assert!(
                        a.x != b.x || a.y != b.y,
                        "two samples of `offsets` lie at the same place: leave one out"
                    );
                    if self.latin {
                        let apart = (cell(a, samples) - cell(b, samples)).abs();
                        assert!(
                            apart.x != 0 && apart.y != 0,
                            "`offsets` is no Latin square: two samples share a row or a column of the grid with as many of \
                             them as there are samples; move one, or set latin=false"
                        );
                    }
                }
            }
        }
        if self.shading == Shading::Listed {
            let shaded = self.shading_samples();
            assert!(
                shaded == 1 || shaded == 2 || shaded == 4,
                "shading=listed needs one, two or four samples in `shaded`"
            );
            for k in 0..shaded {
                assert!(
                    self.shaded_sample(k) < samples,
                    "`shaded` names a sample that the pattern does not have: they are counted from 0"
                );
                for earlier in 0..k {
                    assert!(
                        self.shaded_sample(earlier) != self.shaded_sample(k),
                        "`shaded` names a sample twice"
                    );
                }
            }
        }
        if self.layout == Layout::Multisampled {
            assert!(
                self.pattern != Pattern::Ordered4
                    && self.pattern != Pattern::Ordered16
                    && self.pattern != Pattern::Latin16,
                "layout=multisampled needs a pattern that hardware samples: latin4, standard8 or standard16, or listed for \
                 one of your device's own"
            );
            assert!(samples >= 2, "layout=multisampled needs two samples at least");
        }
        if self.layout == Layout::Split {
            assert!(
                self.normals != Normals::Packed
                    && (self.metric == Metric::DepthNormals || self.metric == Metric::PlanesNormals),
                "layout=split parts depth from normals: set a metric that compares both, and normals that are not packed"
            );
        }
        if self.search != Search::None {
            assert!(
                samples <= 32,
                "search needs a pattern of 32 samples at most: a bit for each says which are unseen"
            );
            assert!(
                self.resolve == Resolve::Box
                    && self.shading_samples() == 1
                    && self.normalisation == Normalisation::Shifted,
                "search needs resolve=box, one shading sample a pixel and normalisation=shifted"
            );
        }
        self.check_projection();
        self.check_extra();
        self.check_demodulate();
        self.check_guide();
        self.check_history();
        assert!(
            self.normals != Normals::Packed
                || self.metric == Metric::PlanesNormals
                || self.metric == Metric::DepthNormals,
            "normals=packed holds normals and depth in one texel, and this metric compares one of them only: use \
             metric=planes-normals or metric=depth-normals, or another encoding"
        );
    }

    /// Number of geometry samples reconstructed for a pixel.
    pub(super) fn reconstructed(&self) -> usize {
        match self.resolve {
            Resolve::Box => self.samples(),
            _ => 9 * self.samples(),
        }
    }

    /// Index of the reconstructed sample that is visited as number `k`. The samples of a quadrant of a pixel follow each
    /// other, as do adjacent quadrants: they use the same taps, so that few are held at a time.
    pub(super) fn visited(&self, k: usize) -> usize {
        let (pixel, own) = (k / self.samples(), k % self.samples());
        let sample = match self.pattern {
            Pattern::Standard8 => VISITED8[own],
            Pattern::Standard16 => VISITED16[own],
            // These are numbered in that order, have one sample a quadrant, or are visited row by row.
            _ => own,
        };
        pixel * self.samples() + sample
    }

    /// Position of reconstructed sample `k`: one of the pixel's own, or of its neighbours'.
    pub(super) fn place(&self, k: usize) -> Place {
        match self.resolve {
            Resolve::Box => self.geometry_sample(IVec2::ZERO, k),
            _ => self.geometry_sample(neighbour(k / self.samples(), 3), k % self.samples()),
        }
    }

    /// Share of reconstructed sample `k` in the pixel, before the shares are normalised.
    pub(super) fn share(&self, k: usize) -> f32 {
        match self.resolve {
            Resolve::Box => 1.0,
            Resolve::Tent => tent(self.place(k).at / self.resolve_radius),
            Resolve::Gaussian => {
                let away = self.place(k).at / self.resolve_radius;
                if tent(away) > 0.0 {
                    (-2.0 * away.dot(away)).exp()
                } else {
                    0.0
                }
            }
            Resolve::Mitchell => {
                let away = self.place(k).at.abs() * (2.0 / self.resolve_radius);
                mitchell(away.x) * mitchell(away.y)
            }
            Resolve::Lanczos => {
                let away = self.place(k).at.abs() * (2.0 / self.resolve_radius);
                lanczos(away.x) * lanczos(away.y)
            }
        }
    }

    /// Width and height of the square of pixels around the filtered one that contains all taps. The farthest sample lies
    /// half a pixel from the pixel's centre, or up to one and a half with a resolve filter wider than a pixel.
    pub(super) fn side(&self) -> usize {
        let mut beyond = 1;
        if self.radius > 1.0 {
            beyond += 1;
        }
        if self.resolve != Resolve::Box {
            beyond += 1;
        }
        2 * beyond + 1
    }

    /// Position of tap `tap` in a square of `side` × `side` pixels: the shading samples of each, pixel by pixel.
    pub(super) fn tap(&self, tap: usize, side: usize) -> Place {
        match self.shading {
            Shading::Sample0 => self.geometry_sample(neighbour(tap, side), 0),
            Shading::Centre | Shading::Placed => self.centre(neighbour(tap, side)),
            Shading::Listed => {
                let several = self.shading_samples();
                self.geometry_sample(neighbour(tap / several, side), self.shaded_sample(tap % several))
            }
        }
    }

    /// Position of a pixel's centre.
    pub(super) fn centre(&self, pixel: IVec2) -> Place {
        Place {
            pixel,
            sample: self.samples(),
            centre: true,
            extra: false,
            at: pixel.as_vec2(),
        }
    }

    /// Position of a geometry sample of a pixel.
    pub(super) fn geometry_sample(&self, pixel: IVec2, sample: usize) -> Place {
        Place {
            pixel,
            sample,
            centre: false,
            extra: false,
            at: pixel.as_vec2() + self.offset(sample),
        }
    }
}

/// Mitchell and Netravali's cubic with B = C = 1/3; 0 from 2 on.
fn mitchell(x: f32) -> f32 {
    let (x2, x3) = (x * x, x * x * x);
    if x < 1.0 {
        (7.0 * x3 - 12.0 * x2 + 16.0 / 3.0) / 6.0
    } else if x < 2.0 {
        (-7.0 / 3.0 * x3 + 12.0 * x2 - 20.0 * x + 32.0 / 3.0) / 6.0
    } else {
        0.0
    }
}

/// sinc(x) sinc(x / 2); 0 from 2 on.
fn lanczos(x: f32) -> f32 {
    let angle = std::f32::consts::PI * x;
    if x < 1.0e-3 {
        1.0
    } else if x < 2.0 {
        2.0 * angle.sin() * (0.5 * angle).sin() / (angle * angle)
    } else {
        0.0
    }
}

/// Tent on each axis: linear from 1 at zero to 0 at one.
pub(super) fn tent(away: Vec2) -> f32 {
    (1.0 - away.x.abs()).max(0.0) * (1.0 - away.y.abs()).max(0.0)
}

/// Pixel `k` of the `side` × `side` ones around the middle one, row by row, relative to it.
pub(super) fn neighbour(k: usize, side: usize) -> IVec2 {
    let (k, side) = (k as i32, side as i32);
    ivec2(k % side - side / 2, k / side - side / 2)
}

/// Centre of cell `sample` of a `side` × `side` grid over the pixel, row by row.
fn ordered(sample: usize, side: usize) -> Vec2 {
    let cell = ivec2((sample % side) as i32, (sample / side) as i32);
    (cell.as_vec2() + 0.5) / side as f32 - 0.5
}

/// Column and row of an offset in a `side` × `side` grid over the pixel.
fn cell(offset: Vec2, side: usize) -> IVec2 {
    let place = (offset + 0.5) * side as f32;
    place.floor().as_ivec2().min(IVec2::splat(side as i32 - 1))
}

/// Offsets of the 4× pattern, in sixteenths of a pixel.
const LATIN4: [IVec2; 4] = [ivec2(-2, -6), ivec2(6, -2), ivec2(-6, 2), ivec2(2, 6)];

/// Offsets of the 8× pattern, in sixteenths of a pixel.
const STANDARD8: [IVec2; 8] = [
    ivec2(1, -3),
    ivec2(-1, 3),
    ivec2(5, 1),
    ivec2(-3, -5),
    ivec2(-5, 5),
    ivec2(-7, -1),
    ivec2(3, 7),
    ivec2(7, -7),
];

/// Order of the hardware's samples, quadrant by quadrant, clockwise from the quadrant of the first.
const VISITED8: [usize; 8] = [0, 7, 2, 6, 1, 4, 3, 5];
const VISITED16: [usize; 16] = [0, 5, 6, 14, 2, 8, 11, 12, 1, 4, 10, 15, 3, 7, 9, 13];

/// Offsets of the 16× pattern, in sixteenths of a pixel.
const STANDARD16: [IVec2; 16] = [
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

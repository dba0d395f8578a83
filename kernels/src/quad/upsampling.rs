//! Cross-bilateral upsampling with one or two reads a pixel (§2.7), and the pass that creates its input.

use super::surface::{DEEPEST, bounded, is_bright, is_bright_color, no_surface};
use crate::prelude::*;

options! {
    /// Options of the upsampling.
    pub struct Upsampling {
        /// Pixels of the frame per low-resolution pixel, across and down.
        pub factor: Factor = Factor::Twice,
        /// Reads of the low-resolution images.
        pub reads: Reads = Reads::Packed,
        /// Components to upsample.
        pub payload: Payload = Payload::Color,
        /// Weights of texels by their distance on the screen.
        pub screen: Screen = Screen::Tent,
        /// Distance on the screen, in low-resolution texels, at which a weight has fallen to exp(-1/2). `screen=gaussian` only.
        pub screen_sigma: f32 [0.1..=10.0] = 0.5,
        /// Comparison of normals as well as depths. Not with `reads=packed`, which has no room for normals.
        pub normals: bool = false,
        /// Difference in depth, in the unit of depth, at which a weight has fallen to exp(-1/2).
        pub depth_sigma: f32 [1.0e-6..=1.0e6] = 0.1,
        /// 1 minus the cosine between normals at which a weight has fallen to exp(-1/2).
        pub normal_sigma: f32 [1.0e-3..=2.0] = 0.1,
    }
}

/// Pixels of the frame per low-resolution pixel, across and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// 2.
    Twice,
    /// 4.
    FourTimes,
}

/// Reads of the low-resolution images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reads {
    /// Each lane reads one texel of `low`, whose fourth component is its depth: one read.
    Packed,
    /// Each lane reads one texel of `low` and one of `low_surface`: two reads.
    Apart,
    /// Each pixel reads all four texels of both by itself: eight reads and no message.
    Naive,
}

/// Components to upsample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Payload {
    /// First component of `low`, such as ambient occlusion. Messages are shorter.
    Scalar,
    /// All components of `low`; with `reads=packed`, three.
    Color,
}

/// Weights of texels by their distance on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Screen {
    /// A tent on each axis, as in bilinear filtering: a texel at a distance of one texel has no weight.
    Tent,
    /// A Gaussian, as for the depth.
    Gaussian,
}

/// For a sum of weights below this, none of the four texels shows the pixel's surface.
const SMALLEST: f32 = 1.0e-20;

/// A low-resolution texel, as received by each lane.
#[derive(Clone, Copy)]
struct Tap {
    color: Quad<Vec4>,
    depth: Quad<f32>,
    normal: Quad<Vec3>,
    /// Weight by distance on the screen.
    screen: Quad<f32>,
}

/// Colours of a quad, each from the nearest four texels of `low`: those near on the screen (`screen`) and of a
/// similar surface (a Gaussian of the difference in depth, and of normals). If none is of a similar surface, the texel with the
/// nearest depth is used.
///
/// `low` is created by [`downsampling`]: its texel n represents the corner at 2n (4n), half a pixel off, so that a quad's
/// pixels all have the same four texels around them and each lane reads one. It has ceil(W/2) + 1 columns and
/// ceil(H/2) + 1 rows (with a factor of 4: ceil(W/4) + 1). `low_surface` contains normals and, as the fourth component, depths.
///
/// The result is finite for every input. A texel with a colour that is not finite, or is 1.5e38 or more, is black and farther
/// from every depth than any other. A depth that is NaN, or is 1e30 or more, counts as 1e30. A NaN normal is ignored.
pub fn quad_upsampling(
    cfg: &Upsampling,
    low: &Texture<Vec4>,
    low_surface: &Texture<Vec4>,
    depth: &Frame<f32>,
    normal: &Frame<Vec3>,
    pixel: Quad<IVec2>,
) -> Quad<Vec4> {
    assert!(
        cfg.reads != Reads::Packed || !cfg.normals,
        "reads=packed has no room for normals: set reads=apart, or leave normals out"
    );
    let factor = cfg.factor.pixels();
    let corner = pixel / factor;
    // Share of the texels on the right and at the bottom.
    let share = ((pixel - corner * factor).as_vec2() + 0.5) / factor as f32;
    let own_depth = bounded(depth.load(pixel));
    let own_normal = if cfg.compares_normals() {
        normal.load(pixel)
    } else {
        Quad::splat(Vec3::ZERO)
    };
    let taps = match cfg.reads {
        Reads::Naive => around(cfg, low, low_surface, corner, share),
        _ => heard(cfg, low, low_surface, corner, share),
    };
    let mut total = Quad::splat(0.0);
    let mut weights = [Quad::splat(0.0); 4];
    let mut nearest = Quad::splat(0.0);
    let mut fallback = taps[0].color;
    for k in 0..4 {
        let away = (taps[k].depth - own_depth).abs();
        let z = away / cfg.depth_sigma;
        let mut exponent = z * z;
        if cfg.compares_normals() {
            let n = (1.0 - taps[k].normal.dot(own_normal)) / cfg.normal_sigma;
            // A NaN normal is ignored.
            exponent += (n * n).ge(0.0).select(n * n, Quad::splat(0.0));
        }
        let weight = tally("weight_evaluations", taps[k].screen * (exponent * HALF_LOG2_E).exp2());
        weights[k] = weight;
        total += weight;
        if k == 0 {
            nearest = away;
        } else {
            let nearer = away.lt(nearest);
            nearest = nearer.select(away, nearest);
            fallback = nearer.select(taps[k].color, fallback);
        }
    }
    // Differences from one texel: for four equal texels nothing else remains.
    let scale = 1.0 / total.max(SMALLEST);
    let mut color = taps[0].color;
    for k in 1..4 {
        color += (taps[k].color - taps[0].color) * (weights[k] * scale);
    }
    total.gt(SMALLEST).select(color, fallback)
}

/// Factor such that exp(-x / 2) is exp2(x * factor).
const HALF_LOG2_E: f32 = -0.5 * std::f32::consts::LOG2_E;

/// The texel read by each lane, and those read by the other lanes.
fn heard(
    cfg: &Upsampling,
    low: &Texture<Vec4>,
    low_surface: &Texture<Vec4>,
    corner: Quad<IVec2>,
    share: Quad<Vec2>,
) -> [Tap; 4] {
    let own = low.load(corner + lane_position());
    let counts = cfg.counts(own);
    let counted = match cfg.reads {
        Reads::Packed => counts.select(own.truncate().extend(bounded(own.w())), no_surface()),
        _ => counts.select(own, Quad::splat(Vec4::ZERO)),
    };
    // Each lane's own texel lies in the lane's own direction. For the other texels the weights are flipped.
    let near = match cfg.factor {
        Factor::Twice => Quad::splat(vec2(0.75, 0.75)),
        Factor::FourTimes => {
            let side = quad_select();
            share * side + (1.0 - share) * (1.0 - side)
        }
    };
    let (near, far) = (cfg.on_screen(near), cfg.on_screen(1.0 - near));
    let screen = [
        near.x() * near.y(),
        far.x() * near.y(),
        near.x() * far.y(),
        far.x() * far.y(),
    ];
    let mut taps = [Tap {
        color: counted,
        depth: counted.w(),
        normal: Quad::splat(Vec3::ZERO),
        screen: screen[0],
    }; 4];
    match cfg.reads {
        Reads::Packed => match cfg.payload {
            Payload::Scalar => {
                let messages = Quad::from_xy(counted.x(), counted.w()).gather();
                for k in 0..4 {
                    taps[k].color = Vec4::ONE * messages[k].x();
                    taps[k].depth = messages[k].y();
                }
            }
            Payload::Color => {
                let messages = counted.gather();
                for k in 0..4 {
                    taps[k].color = messages[k].truncate().extend(1.0);
                    taps[k].depth = messages[k].w();
                }
            }
        },
        _ => {
            let surface = low_surface.load(corner + lane_position());
            let depth = counts.select(bounded(surface.w()), no_surface().w());
            match cfg.payload {
                Payload::Scalar => {
                    let messages = counted.x().gather();
                    for k in 0..4 {
                        taps[k].color = Vec4::ONE * messages[k];
                    }
                }
                Payload::Color => {
                    let messages = counted.gather();
                    for k in 0..4 {
                        taps[k].color = messages[k];
                    }
                }
            }
            if cfg.compares_normals() {
                let messages = surface.truncate().extend(depth).gather();
                for k in 0..4 {
                    taps[k].normal = messages[k].truncate();
                    taps[k].depth = messages[k].w();
                }
            } else {
                let messages = depth.gather();
                for k in 0..4 {
                    taps[k].depth = messages[k];
                }
            }
        }
    }
    for k in 0..4 {
        taps[k].screen = screen[k];
    }
    taps
}

/// All four texels, read by each pixel itself.
fn around(
    cfg: &Upsampling,
    low: &Texture<Vec4>,
    low_surface: &Texture<Vec4>,
    corner: Quad<IVec2>,
    share: Quad<Vec2>,
) -> [Tap; 4] {
    let mut taps = [Tap {
        color: Quad::splat(Vec4::ZERO),
        depth: Quad::splat(0.0),
        normal: Quad::splat(Vec3::ZERO),
        screen: Quad::splat(0.0),
    }; 4];
    let (share, rest) = (cfg.on_screen(share), cfg.on_screen(1.0 - share));
    for k in 0..4 {
        let (right, below) = (k % 2 == 1, k / 2 == 1);
        let at = corner + ivec2(k as i32 % 2, k as i32 / 2);
        let texel = low.load(at);
        let counts = cfg.counts(texel);
        let color = counts.select(texel, Quad::splat(Vec4::ZERO));
        let surface = low_surface.load(at);
        let x = if right { share.x() } else { rest.x() };
        let y = if below { share.y() } else { rest.y() };
        taps[k].color = match cfg.payload {
            Payload::Scalar => Vec4::ONE * color.x(),
            Payload::Color => color,
        };
        taps[k].depth = counts.select(bounded(surface.w()), no_surface().w());
        taps[k].normal = surface.truncate();
        taps[k].screen = x * y;
    }
    taps
}

impl Upsampling {
    /// Returns whether a low-resolution texel has a finite colour in the upsampled components.
    fn counts(&self, texel: Quad<Vec4>) -> Quad<bool> {
        match self.payload {
            Payload::Scalar => is_bright(texel.x()),
            Payload::Color => {
                let color = is_bright_color(texel.truncate());
                match self.reads {
                    Reads::Packed => color,
                    _ => color & is_bright(texel.w()),
                }
            }
        }
    }

    /// Weights on each axis of a texel at a distance of 1 - `near`.
    fn on_screen(&self, near: Quad<Vec2>) -> Quad<Vec2> {
        match self.screen {
            Screen::Tent => near,
            Screen::Gaussian => {
                let z = (1.0 - near) / self.screen_sigma;
                (z * z * HALF_LOG2_E).exp2()
            }
        }
    }

    fn compares_normals(&self) -> bool {
        self.normals
    }
}

impl Factor {
    fn pixels(self) -> i32 {
        match self {
            Factor::Twice => 2,
            Factor::FourTimes => 4,
        }
    }
}

options! {
    /// Options of the downsampling.
    pub struct Downsampling {
        /// Pixels of the image per low-resolution pixel, across and down.
        pub factor: Factor = Factor::Twice,
        /// Components to write.
        pub gives: Gives = Gives::Packed,
    }
}

/// Components to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// The first three components of the colour, and the depth.
    Packed,
    /// The colour.
    Color,
    /// The normal and the depth.
    Surface,
}

/// Low-resolution texel for the corner at twice (four times) `pixel`: of the 2×2 (4×4) pixels around
/// that corner, the one nearest to the viewer, whose colour, normal and depth stay together.
///
/// The output frame is the low-resolution image, half a pixel off the full one, so that it needs one more column and row:
/// ceil(W/2) + 1 by ceil(H/2) + 1 (with a factor of 4: ceil(W/4) + 1). Reads beyond the border return the border's pixels.
///
/// A depth that is NaN, or has a magnitude of 1e30 or more, is the farthest; 1e30 is written if there is no other. Colours and
/// normals are written unchanged: [`quad_upsampling`] tests them.
pub fn downsampling(
    cfg: &Downsampling,
    image: &Texture<Vec4>,
    depth: &Texture<f32>,
    normal: &Texture<Vec3>,
    pixel: IVec2,
) -> Vec4 {
    let factor = cfg.factor.pixels();
    let first = pixel * factor - factor / 2;
    let mut at = first;
    let mut nearest = DEEPEST;
    for j in 0..factor {
        for i in 0..factor {
            let z = depth.load(first + ivec2(i, j));
            if z < nearest && z > -DEEPEST {
                nearest = z;
                at = first + ivec2(i, j);
            }
        }
    }
    match cfg.gives {
        Gives::Packed => image.load(at).truncate().extend(nearest),
        Gives::Color => image.load(at),
        Gives::Surface => normal.load(at).extend(nearest),
    }
}

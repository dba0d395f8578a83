//! Definition of the edge filters: their formulas, evaluated in double precision without regard to speed.
//!
//! Nothing here is shared with the kernels but the containers that texels are read from. Beyond the border lies the
//! nearest pixel.
//!
//! S.T.A.L.K.E.R.: with [·] for 1 where it holds and 0 elsewhere, over the diagonals k and the four axes (a, −a),
//!
//! > w = 1 − min(1, ¼ u Σₖ [n·nₖ ≥ b]) · min(1, ¼ v Σₐ [|2d − d₊ₐ − d₋ₐ| ≤ e]),  colour = ¼ Σₖ C(p + ½ w·kernel·k);
//!
//! printed, both ¼ and the ½ are 1, and |n·nₖ| stands for n·nₖ.
//!
//! Tabula Rasa: over the four axes, with g± = |d± − d| and c± = n·n±,
//!
//! > w = ¼ Σₐ [max g ≥ s·max(min g, 10⁻⁵) or t·max(|c₊ − c₋|, 1 − min c) ≥ 0.4],
//! > colour = (2 C(p) + Σₖ C(p + w·weight·k)) / 10
//!
//! with k the eight neighbours; printed, there is no 1 − min c.

use straightline_kernels::prelude::{Frame, IVec2, UVec2, Vec3, Vec4};

/// Depth and normals of one sample a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Geometry<'a> {
    /// Depth, as the filter takes it.
    pub depth: &'a Frame<f32>,
    /// Unit normals.
    pub normal: &'a Frame<Vec3>,
}

/// Edge weight of a pixel, and its certainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// 0 to 1.
    pub weight: f64,
    /// Distance of the closest decision: the smallest difference of two numbers that were compared, relative to the larger of
    /// those that went into it. Below some 10⁻⁶, 32 bits may decide otherwise.
    pub margin: f64,
}

/// Values of S.T.A.L.K.E.R.'s filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stalker {
    /// As printed.
    pub printed: bool,
    /// Depth is linear: its reciprocal is compared.
    pub linear_depth: bool,
    /// b: cosine from which normals are alike.
    pub normal_barrier: f64,
    /// e: second difference of depth up to which a surface is flat.
    pub depth_barrier: f64,
    /// u: weight of like normals.
    pub normal_weight: f64,
    /// v: weight of flat directions.
    pub depth_weight: f64,
    /// Reach of the blur: in pixels as printed, else in half pixels.
    pub kernel: f64,
}

/// Values of Tabula Rasa's filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TabulaRasa {
    /// As printed.
    pub printed: bool,
    /// s: how many times steeper depth must become.
    pub depth_sensibility: f64,
    /// t: how strongly normals count.
    pub normal_sensibility: f64,
    /// Reach of the blur in pixels.
    pub weight: f64,
}

/// Opposite neighbours: both diagonals, across, down.
const AXES: [(i32, i32); 4] = [(1, 1), (-1, 1), (1, 0), (0, 1)];

impl Stalker {
    /// Returns the edge of each pixel, row by row from the top.
    pub fn edges(&self, geometry: &Geometry) -> Vec<Edge> {
        let depth = |p: IVec2| {
            let d = f64::from(geometry.depth.load(p));
            if self.linear_depth {
                1.0 / clamp_depth(d).max(NEAREST)
            } else {
                d
            }
        };
        map_pixels(geometry.depth.size(), |p| {
            let mut margin = f64::INFINITY;
            let (mut alike, mut flat) = (0, 0);
            for (x, y) in AXES {
                let away = IVec2::new(x, y);
                let (d, d1, d2) = (depth(p), depth(p + away), depth(p - away));
                let bend = (2.0 * d - d1 - d2).abs();
                let size = d.abs().max(d1.abs()).max(d2.abs()).max(self.depth_barrier);
                margin = margin.min(decided_margin((bend - self.depth_barrier).abs() / size));
                flat += i32::from(bend <= self.depth_barrier);
                if x * y != 0 {
                    for neighbour in [p + away, p - away] {
                        let cosine = normal_cosine(geometry.normal, p, neighbour);
                        let cosine = if self.printed { cosine.abs() } else { cosine };
                        margin = margin.min(decided_margin(
                            (cosine - self.normal_barrier).abs() / cosine.abs().max(1.0),
                        ));
                        alike += i32::from(cosine >= self.normal_barrier);
                    }
                }
            }
            let share = |count: i32, weight: f64| match self.printed {
                true => (f64::from(count) * weight).min(1.0),
                false => (f64::from(count) * weight / 4.0).min(1.0),
            };
            let weight = 1.0 - share(alike, self.normal_weight) * share(flat, self.depth_weight);
            Edge { weight, margin }
        })
    }

    /// The filtered picture, row by row from the top.
    pub fn filter_picture(&self, geometry: &Geometry, color: &Frame<Vec4>) -> Vec<[f64; 4]> {
        let edges = self.edges(geometry);
        let width = color.size().x as i32;
        map_pixels(color.size(), |p| {
            let kernel = if self.printed { self.kernel } else { self.kernel / 2.0 };
            let reach = edges[(p.y * width + p.x) as usize].weight * kernel;
            let corners = [(-1.0, -1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, 1.0)];
            let taps = corners.map(|(x, y)| interpolate_color(color, p, [x * reach, y * reach]));
            [0, 1, 2, 3].map(|lane| taps.iter().map(|tap| tap[lane]).sum::<f64>() / 4.0)
        })
    }
}

impl TabulaRasa {
    /// Returns the edge of each pixel, row by row from the top.
    pub fn edges(&self, geometry: &Geometry) -> Vec<Edge> {
        let depth = |p: IVec2| clamp_depth(f64::from(geometry.depth.load(p)));
        map_pixels(geometry.depth.size(), |p| {
            let mut margin = f64::INFINITY;
            let mut edges = 0;
            for (x, y) in AXES {
                let away = IVec2::new(x, y);
                let (d, d1, d2) = (depth(p), depth(p + away), depth(p - away));
                let (g1, g2) = ((d1 - d).abs(), (d2 - d).abs());
                let needed = self.depth_sensibility * g1.min(g2).max(1.0e-5);
                // Gradients are exact up to rounding of the depths that they are differences of.
                let size = d.abs().max(d1.abs()).max(d2.abs()) * (1.0 + self.depth_sensibility);
                margin = margin.min((g1.max(g2) - needed).abs() / size.max(needed));

                let (c1, c2) = (
                    normal_cosine(geometry.normal, p, p + away),
                    normal_cosine(geometry.normal, p, p - away),
                );
                let changes = match self.printed {
                    true => [(c1 - c2).abs(); 2],
                    false => [1.0 - c1, 1.0 - c2],
                };
                let size = c1.abs().max(c2.abs()).max(1.0);
                let mut edge = g1.max(g2) >= needed;
                for change in changes.map(|change| change * self.normal_sensibility) {
                    margin = margin.min(decided_margin((change - 0.4).abs() / size));
                    // A change that is not a number is an edge.
                    edge |= change >= 0.4 || change.is_nan();
                }
                edges += i32::from(edge);
            }
            let weight = f64::from(edges) / 4.0;
            Edge { weight, margin }
        })
    }

    /// The filtered picture, row by row from the top.
    pub fn filter_picture(&self, geometry: &Geometry, color: &Frame<Vec4>) -> Vec<[f64; 4]> {
        let edges = self.edges(geometry);
        let width = color.size().x as i32;
        map_pixels(color.size(), |p| {
            let reach = edges[(p.y * width + p.x) as usize].weight * self.weight;
            let mut sum = finite_color(color, p).map(|lane| 0.2 * lane);
            for y in -1..=1 {
                for x in -1..=1 {
                    if (x, y) == (0, 0) {
                        continue;
                    }
                    let share = 0.1;
                    let tap = interpolate_color(color, p, [f64::from(x) * reach, f64::from(y) * reach]);
                    sum.iter_mut().zip(tap).for_each(|(sum, tap)| *sum += share * tap);
                }
            }
            sum
        })
    }
}

/// Clamps a depth to 10³⁰, by definition of both filters; infinities and NaN get the same depth.
fn clamp_depth(depth: f64) -> f64 {
    let deepest = f64::from(1.0e30_f32);
    if depth.abs() < deepest { depth } else { deepest }
}

/// The least depth whose reciprocal is taken.
const NEAREST: f64 = 1.0e-30;

/// Returns a margin; for NaN, which every precision decides alike, an infinite one.
fn decided_margin(margin: f64) -> f64 {
    if margin.is_nan() { f64::INFINITY } else { margin }
}

fn map_pixels<T>(size: UVec2, pixel: impl Fn(IVec2) -> T) -> Vec<T> {
    let size = size.as_ivec2();
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| IVec2::new(x, y)));
    pixels.map(pixel).collect()
}

/// The colour of a pixel, black if it is not finite.
fn finite_color(color: &Frame<Vec4>, p: IVec2) -> [f64; 4] {
    let own = color.load(p);
    if own.is_finite() {
        own.as_dvec4().to_array()
    } else {
        [0.0; 4]
    }
}

fn normal_cosine(normal: &Frame<Vec3>, a: IVec2, b: IVec2) -> f64 {
    normal.load(a).as_dvec3().dot(normal.load(b).as_dvec3())
}

/// The colour `away` from the centre of `p` in pixels: the mean of the texels around, each weighted by a tent of one
/// pixel on each axis. If one of them is not finite it is that of `p`, and black if that is not either.
fn interpolate_color(color: &Frame<Vec4>, p: IVec2, away: [f64; 2]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    let reach = away.map(|a| a.abs().ceil() as i32 + 1);
    for y in -reach[1]..=reach[1] {
        for x in -reach[0]..=reach[0] {
            let tent = |at: i32, from: f64| (1.0 - (f64::from(at) - from).abs()).max(0.0);
            let weight = tent(x, away[0]) * tent(y, away[1]);
            if weight > 0.0 {
                let texel = color.load(p + IVec2::new(x, y)).as_dvec4().to_array();
                if texel.iter().any(|lane| !lane.is_finite()) {
                    return finite_color(color, p);
                }
                sum.iter_mut()
                    .zip(texel)
                    .for_each(|(sum, texel)| *sum += weight * texel);
            }
        }
    }
    sum
}

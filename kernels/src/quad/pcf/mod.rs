//! Percentage-closer filtering of shadow maps, with comparisons shared over the quad (§2.9).

mod table;
mod weights;

use super::coordinates::{counted, mean};
use super::guards::Guards;
use crate::prelude::*;
use weights::weigh;

pub use table::table;
pub use weights::ShadowWeights;

options! {
    /// Options of the shadow filter.
    pub struct Pcf {
        /// Distribution of the comparisons.
        pub method: Method = Method::Quad,
        /// Width of the filter in texels, across and down.
        pub width: Width = Width::Eight,
        /// Weights of the texels.
        pub weights: ShadowWeights = ShadowWeights::Box,
        /// Method by which the pixels of a quad, which share a value, get different results. `method=quad` only.
        pub gradient: Gradient = Gradient::None,
        /// Distance between comparisons relative to that of a dense filter: more than 1 covers a wider footprint sparsely, for
        /// distant shadow maps. `method=quad` only.
        pub spread: f32 [1.0..=64.0] = 1.0,
        /// Positions of a lane's comparisons. `method=quad` only, and not `width=four`.
        pub mirroring: Mirroring = Mirroring::Local,
        /// Tests for coordinates that are not finite or far from the map, and for the table's weights.
        pub guards: Guards = Guards::Inline,
    }
}

/// Positions of a lane's comparisons in the shadow map (figure 2.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mirroring {
    /// Next to those of the other lanes. The quad's simultaneous reads lie within 4×4 texels, which suits caches.
    Local,
    /// All in the lane's own quarter. Simpler, but the quad's simultaneous reads lie as far apart as the filter is wide.
    Simple,
}

/// Distribution of the comparisons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Each pixel takes one comparison for each texel.
    Naive,
    /// Each pixel takes one comparison between every 2×2 texels, placed so that the sampler's filter weights them.
    Bilinear,
    /// The quad takes one comparison between every 2×2 texels around its mean position; each lane takes a quarter of them.
    Quad,
    /// The quad gathers 8×8 texels around its mean position. Each pixel weights 6×6 of them around its own
    /// position, which is at most a texel off. All comparisons use the quad's mean depth.
    Gather,
}

/// Width of the filter in texels, across and down. `method=gather` needs 8.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// 4 by 4.
    Four,
    /// 8 by 8.
    Eight,
    /// 12 by 12.
    Twelve,
    /// 16 by 16.
    Sixteen,
}

/// Method by which the pixels of a quad get different results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gradient {
    /// None: all pixels have one value.
    None,
    /// The slope from a Prewitt operator on the comparisons, as if they lay in the middle of their texels.
    Prewitt,
    /// The slope of the plane through the comparisons at their actual positions.
    Fitted,
}

/// Light on each pixel of a quad, 0 to 1, in every component.
///
/// `coord` is interpolated: a position in the shadow map, 0 to 1, and the depth to compare. The sampler weights 2×2 texels,
/// so it must filter linearly.
///
/// The chapter's `g01 = g0 = g1` is a sum, its `a.xxyy` is `a.xyxy`, and its gradient is corrected: for taps at -3, -1, 1
/// and 3 texels the slope is their moment divided by 80, and a pixel's value is offset by it from the middle of the
/// weighted texels.
///
/// `lookup` is read only with `weights=lookup`, through a sampler that filters linearly and clamps. [`table`] creates it.
///
/// The light is a number from 0 to 1 for every `coord` and `lookup`. A lane whose coordinates are not finite, or so far from the
/// map that the filter reads only its border, does not move the quad's mean position. Its own result is that of a position beside
/// the map, or of the map's first corner at depth 0 if its coordinates are not finite. `guards=none` omits these tests; it is a
/// promise that coordinates are finite and at most a map's width away from the map, and that the table has weights.
pub fn pcf(
    cfg: &Pcf,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    lookup: &Texture<Vec4>,
    lookup_sampler: &Sampler,
    coord: Quad<Vec3>,
) -> Quad<Vec4> {
    if cfg.method != Method::Quad {
        assert!(
            cfg.gradient == Gradient::None,
            "gradient is of method=quad alone: the pixels of a quad share a value there, and in no other method"
        );
        assert!(
            cfg.spread == 1.0,
            "spread is of method=quad alone: the other methods compare every texel of the width"
        );
    }
    if cfg.method != Method::Quad || cfg.width == Width::Four {
        assert!(
            cfg.mirroring == Mirroring::Local,
            "mirroring=simple is of method=quad and widths of eight and more: elsewhere no lane takes several comparisons of a quad's"
        );
    }
    if cfg.method == Method::Gather {
        assert!(
            cfg.width == Width::Eight,
            "method=gather takes 8 by 8 texels: leave width at eight"
        );
    }
    if cfg.weights == ShadowWeights::Lookup {
        assert!(
            cfg.method == Method::Quad || cfg.method == Method::Bilinear,
            "weights=lookup has weights of two texels at a time: set method to quad or bilinear"
        );
    }
    let seen = counted(shadow, coord, cfg.width.half() * cfg.spread + 2.0);
    let (coord, centre) = match cfg.guards {
        Guards::Inline => (seen.coord, mean(&seen)),
        Guards::None => (coord, coord.average()),
    };
    let lit = match cfg.method {
        Method::Naive => naive(cfg, shadow, shadow_sampler, coord),
        Method::Bilinear => bilinear(cfg, shadow, shadow_sampler, lookup, lookup_sampler, coord),
        Method::Quad => match cfg.width {
            Width::Four => shared::<1>(cfg, shadow, shadow_sampler, lookup, lookup_sampler, coord, centre),
            Width::Eight => shared::<4>(cfg, shadow, shadow_sampler, lookup, lookup_sampler, coord, centre),
            Width::Twelve => shared::<9>(cfg, shadow, shadow_sampler, lookup, lookup_sampler, coord, centre),
            Width::Sixteen => shared::<16>(cfg, shadow, shadow_sampler, lookup, lookup_sampler, coord, centre),
        },
        Method::Gather => gathered(cfg, shadow, shadow_sampler, coord, centre),
    };
    Vec4::ONE * lit
}

/// Offset of a position past the centre of the texel to its upper left, 0 to 1 on each axis.
fn fraction(shadow: &DepthTexture, coord: Quad<Vec3>) -> Quad<Vec2> {
    fract(coord.truncate() * shadow.size().as_vec2() - 0.5)
}

/// Each pixel compares every texel, at its centre.
fn naive(cfg: &Pcf, shadow: &DepthTexture, shadow_sampler: &ComparisonSampler, coord: Quad<Vec3>) -> Quad<f32> {
    let size = shadow.size().as_vec2();
    let a = fraction(shadow, coord);
    let n = cfg.width.texels();
    let mut sum = Quad::splat(0.0);
    let mut total = Quad::splat(0.0);
    for j in 0..n {
        for i in 0..n {
            let offset = vec2((i - n / 2 + 1) as f32, (j - n / 2 + 1) as f32) - a;
            let weight = match cfg.weights {
                ShadowWeights::Box => Quad::splat(Vec2::ONE),
                _ => weigh(cfg.weights, cfg.width.half(), offset),
            };
            let weight = weight.x() * weight.y();
            sum += weight * shadow.compare(shadow_sampler, coord.truncate() + offset / size, coord.z());
            total += weight;
        }
    }
    sum / total
}

/// Two adjacent texels of a row and of a column: the position between them where the sampler weights them as the filter does,
/// and the sum of their weights (Sigg and Hadwiger 2005).
struct Pair {
    place: Quad<Vec2>,
    weight: Quad<Vec2>,
}

fn pair(cfg: &Pcf, lookup: &Texture<Vec4>, lookup_sampler: &Sampler, first: Quad<Vec2>) -> Pair {
    match cfg.weights {
        ShadowWeights::Box => Pair {
            place: first + 0.5,
            weight: Quad::splat(Vec2::ONE),
        },
        ShadowWeights::Lookup => {
            let columns = looked_up(cfg, lookup, lookup_sampler, first.x());
            let rows = looked_up(cfg, lookup, lookup_sampler, first.y());
            Pair {
                place: first + Quad::from_xy(columns.y(), rows.y()),
                weight: Quad::from_xy(columns.x(), rows.x()),
            }
        }
        _ => {
            let w0 = weigh(cfg.weights, cfg.width.half(), first);
            let w1 = weigh(cfg.weights, cfg.width.half(), first + 1.0);
            let weight = w0 + w1;
            Pair {
                place: first + w1 / weight,
                weight,
            }
        }
    }
}

/// Looks up the pair that starts at `first` in the table.
fn looked_up(cfg: &Pcf, lookup: &Texture<Vec4>, lookup_sampler: &Sampler, first: Quad<f32>) -> Quad<Vec2> {
    let half = cfg.width.half();
    let texels = lookup.size().x as f32;
    // Between the centres of the first and the last texel of the table.
    let at = (first + half) / (2.0 * half - 1.0) * (texels - 1.0) + 0.5;
    let at = Quad::from_xy(at / texels, Quad::splat(0.5));
    let found = lookup.sample_level(lookup_sampler, at, Quad::splat(0.0)).xy();
    match cfg.guards {
        Guards::Inline => {
            // A weight that is not above 0, or is NaN, counts as 0.
            let (weight, place) = (found.x(), found.y());
            let weight = weight.gt(0.0).select(weight.min(HEAVIEST), Quad::splat(0.0));
            let place = place.gt(0.0).select(place.min(1.0), Quad::splat(0.0));
            Quad::from_xy(weight, place)
        }
        Guards::None => found,
    }
}

/// Upper bound on a table's weight.
const HEAVIEST: f32 = 1.0e10;

/// A sum of weights up to this counts as 0: the table has no weights here.
const LIGHTEST: f32 = 1.0e-20;

/// Divides the light by the sum of its weights. Where a table has no weights, everything is lit.
fn over(cfg: &Pcf, lit: Quad<f32>, weight: Quad<f32>) -> Quad<f32> {
    if cfg.has_doubtful_weights() {
        weight.gt(LIGHTEST).select(lit / weight, Quad::splat(1.0))
    } else {
        lit / weight
    }
}

/// Each pixel compares between every 2×2 texels.
fn bilinear(
    cfg: &Pcf,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    lookup: &Texture<Vec4>,
    lookup_sampler: &Sampler,
    coord: Quad<Vec3>,
) -> Quad<f32> {
    let size = shadow.size().as_vec2();
    let a = fraction(shadow, coord);
    let n = cfg.width.texels();
    let mut sum = Quad::splat(0.0);
    let mut total = Quad::splat(0.0);
    for j in 0..n / 2 {
        for i in 0..n / 2 {
            let column = pair(cfg, lookup, lookup_sampler, (2 * i - n / 2 + 1) as f32 - a);
            let row = pair(cfg, lookup, lookup_sampler, (2 * j - n / 2 + 1) as f32 - a);
            let place = Quad::from_xy(column.place.x(), row.place.y());
            let weight = column.weight.x() * row.weight.y();
            sum += weight * shadow.compare(shadow_sampler, coord.truncate() + place / size, coord.z());
            total += weight;
        }
    }
    over(cfg, sum, total)
}

/// The quad compares between every 2×2 texels around its mean position, with `N` comparisons for each lane.
fn shared<const N: usize>(
    cfg: &Pcf,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    lookup: &Texture<Vec4>,
    lookup_sampler: &Sampler,
    coord: Quad<Vec3>,
    centre: Quad<Vec3>,
) -> Quad<f32> {
    let taps = compare::<N>(cfg, shadow, shadow_sampler, lookup, lookup_sampler, centre);
    let away = (coord.truncate() - centre.truncate()) * shadow.size().as_vec2();
    join(cfg, taps, fraction(shadow, centre), away)
}

/// Comparison of a lane: its result, its position in texels from the quad's mean position, and its weight.
#[derive(Clone, Copy)]
pub struct Tap {
    /// Result of the comparison.
    pub lit: Quad<f32>,
    /// Position of the comparison.
    pub place: Quad<Vec2>,
    /// Position as if the comparison had been taken in the middle of its texels.
    pub middle: Quad<Vec2>,
    /// Weight of the comparison.
    pub weight: Quad<f32>,
}

/// Each lane takes its quarter of the comparisons around `centre`.
fn compare<const N: usize>(
    cfg: &Pcf,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    lookup: &Texture<Vec4>,
    lookup_sampler: &Sampler,
    centre: Quad<Vec3>,
) -> [Tap; N] {
    let size = shadow.size().as_vec2();
    let a = fraction(shadow, centre);
    let mut taps = [Tap {
        lit: Quad::splat(0.0),
        place: Quad::splat(Vec2::ZERO),
        middle: Quad::splat(Vec2::ZERO),
        weight: Quad::splat(0.0),
    }; N];
    let n = cfg.width.lane_taps() as usize;
    for k in 0..N {
        // All taps use the same few columns and rows.
        let (i, j) = (first_texel(cfg, k % n), first_texel(cfg, k / n));
        let column = pair(cfg, lookup, lookup_sampler, i - a);
        let row = pair(cfg, lookup, lookup_sampler, j - a);
        let place = Quad::from_xy(column.place.x(), row.place.y()) * cfg.spread;
        taps[k] = Tap {
            lit: shadow.compare(shadow_sampler, centre.truncate() + place / size, centre.z()),
            place,
            middle: Quad::from_xy(i.x(), j.y()) * cfg.spread,
            weight: column.weight.x() * row.weight.y(),
        };
    }
    taps
}

/// Offset of the first texel of column, or row, `k` of a lane's comparisons from the middle of the filter.
fn first_texel(cfg: &Pcf, k: usize) -> Quad<Vec2> {
    match cfg.mirroring {
        Mirroring::Local => quad_vector() + cfg.width.away(k),
        Mirroring::Simple => quad_vector() * (2 * k + 1) as f32,
    }
}

/// Joins the comparisons of all lanes to one value, and adds the slope for each pixel. `fraction` is that of the quad's mean
/// position; `away` is the offset of each pixel from it, in texels.
pub fn join<const N: usize>(cfg: &Pcf, taps: [Tap; N], fraction: Quad<Vec2>, away: Quad<Vec2>) -> Quad<f32> {
    let mut sums = Quad::splat(Vec4::ZERO);
    for k in 0..N {
        let weighed = (taps[k].place * taps[k].weight).extend(taps[k].weight);
        sums += weighed.extend(taps[k].lit * taps[k].weight);
    }
    let (lit, middle) = match (cfg.weights, cfg.gradient) {
        // Weights of 1: their sum is known, and their centroid lies midway between two texels.
        (ShadowWeights::Box, _) => {
            let share = 1.0 / N as f32;
            (sums.w().average() * share, (0.5 - fraction) * cfg.spread)
        }
        (_, Gradient::None) => {
            let sums = sums.zw().sum();
            (over(cfg, sums.y(), sums.x()), Quad::splat(Vec2::ZERO))
        }
        _ => {
            let sums = sums.sum();
            let lit = over(cfg, sums.w(), sums.z());
            let weight = match cfg.has_doubtful_weights() {
                true => sums.z().max(LIGHTEST),
                false => sums.z(),
            };
            (lit, sums.xy() / weight)
        }
    };
    match cfg.gradient {
        Gradient::None => lit,
        Gradient::Prewitt => saturate(lit + prewitt(cfg, taps).dot(away - middle)),
        Gradient::Fitted => saturate(lit + fitted(taps).dot(away - middle)),
    }
}

/// Change of light per texel, for taps at -1 and 1, or -3, -1, 1 and 3, and so on: the moment over the sum of squares.
fn prewitt<const N: usize>(cfg: &Pcf, taps: [Tap; N]) -> Quad<Vec2> {
    let mut moment = Quad::splat(Vec2::ZERO);
    for k in 0..N {
        moment += taps[k].middle * taps[k].lit;
    }
    let squares = match cfg.width {
        Width::Four => 4.0,
        Width::Eight => 80.0,
        Width::Twelve => 420.0,
        Width::Sixteen => 1344.0,
    };
    moment.sum() / (squares * cfg.spread * cfg.spread)
}

/// Change of light per texel, from the plane that fits the taps best.
fn fitted<const N: usize>(taps: [Tap; N]) -> Quad<Vec2> {
    let mut lit = Quad::splat(0.0);
    let mut place = Quad::splat(Vec2::ZERO);
    for k in 0..N {
        lit += taps[k].lit;
        place += taps[k].place;
    }
    let share = 1.0 / N as f32;
    let mean_lit = lit.average() * share;
    let mean_place = place.average() * share;
    let mut moments = Quad::splat(Vec4::ZERO);
    for k in 0..N {
        let from = taps[k].place - mean_place;
        let moment = from * (taps[k].lit - mean_lit);
        let square = from * from;
        moments += moment.extend(square.x()).extend(square.y());
    }
    let moments = moments.sum();
    moments.xy() / moments.zw()
}

/// Each lane gathers its quarter of 8×8 texels and passes them on. Each pixel weights those around its own position.
fn gathered(
    cfg: &Pcf,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    coord: Quad<Vec3>,
    centre: Quad<Vec3>,
) -> Quad<f32> {
    let size = shadow.size().as_vec2();
    let a = fraction(shadow, centre);
    // Offset of the pixel's own position from the quad's. Where the quad covers more texels than the filter has to spare, a
    // pixel takes the nearest position for which all texels are available.
    let away = ((coord.truncate() - centre.truncate()) * size)
        .max(-Vec2::ONE)
        .min(Vec2::ONE);
    let shift = -away - a;
    let mut sum = Quad::splat(0.0);
    let mut total = Quad::splat(0.0);
    for k in 0..4 {
        let (i, j) = (Width::Eight.away(k % 2), Width::Eight.away(k / 2));
        let place = quad_vector() + vec2(i, j) - a + 0.5;
        let texels = shadow.gather_compare(shadow_sampler, centre.truncate() + place / size, centre.z());
        let messages = texels.gather();
        for lane in 0..4 {
            // The sending lane's texels, mirrored if it lies on the other side.
            let [x0, x1] = columns(cfg, shift + i, lane % 2 == 1);
            let [y0, y1] = columns(cfg, shift + j, lane / 2 == 1);
            let from = messages[lane];
            sum += y1.y() * (x0.x() * from.x() + x1.x() * from.y());
            sum += y0.y() * (x1.x() * from.z() + x0.x() * from.w());
            total += (x0.x() + x1.x()) * (y0.y() + y1.y());
        }
    }
    sum / total
}

/// Weights of two adjacent columns, and rows, of texels that a lane gathered.
fn columns(cfg: &Pcf, shift: Quad<Vec2>, mirrored: bool) -> [Quad<Vec2>; 2] {
    let first = if mirrored {
        shift - quad_vector()
    } else {
        shift + quad_vector()
    };
    [weigh(cfg.weights, 3.0, first), weigh(cfg.weights, 3.0, first + 1.0)]
}

impl Pcf {
    /// Returns whether weights come from a table, which may have none.
    fn has_doubtful_weights(&self) -> bool {
        self.weights == ShadowWeights::Lookup && self.guards == Guards::Inline
    }
}

impl Width {
    /// Comparisons of a lane per axis. For 4×4 texels there is one for each lane.
    fn lane_taps(self) -> i32 {
        match self {
            Width::Four => 1,
            Width::Eight => 2,
            Width::Twelve => 3,
            Width::Sixteen => 4,
        }
    }

    fn texels(self) -> i32 {
        4 * self.lane_taps()
    }

    /// Distance from the middle to the end of the filter, in texels.
    fn half(self) -> f32 {
        (2 * self.lane_taps()) as f32
    }

    /// Offset of column, or row, `k` of a lane's comparisons from that of a lane with only one comparison.
    fn away(self, k: usize) -> f32 {
        (4 * k as i32 - 2 * (self.lane_taps() - 1)) as f32
    }
}

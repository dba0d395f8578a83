//! Reading between texels, as the prelude's textures do natively.

use super::bindings::{Address, Comparison, SamplerState, Texels};
use super::cube;
use crate::ir::{Real, TextureKind, UnaryOp};

/// A texture seen through a sampler.
pub struct Sampled<'a> {
    /// The image.
    pub image: &'a dyn Texels,
    /// Kind of texture in the kernel.
    pub kind: TextureKind,
    /// State of the sampler.
    pub state: SamplerState,
    /// The layer that is read, where there are several.
    pub layer: u32,
}

/// Level of detail of a read.
pub enum Detail<R> {
    /// The finest.
    Finest,
    /// A level, or a position between two of them.
    Level(R),
    /// That at which the longer of two steps is one texel.
    Steps([[R; 3]; 2]),
}

impl Sampled<'_> {
    /// Texels through the sampler at a place, of which a third component counts where there is one.
    pub fn sample<R: Real>(&self, place: [R; 3], detail: &Detail<R>) -> [R; 4] {
        let level = match detail {
            Detail::Finest => return self.of_level(place, 0),
            Detail::Level(level) => *level,
            Detail::Steps(steps) => self.level_of(steps),
        };
        let (zero, one) = (R::from_f64(0.0), R::from_f64(1.0));
        let last = self.image.levels() - 1;
        // A NaN is the finest level.
        let level = if level > zero { level } else { zero };
        let level = if level < R::from_f64(last.into()) {
            level
        } else {
            R::from_f64(last.into())
        };
        if !self.state.linear_mip {
            let up = apply_unary(UnaryOp::Ceil, level + R::from_f64(0.5));
            return self.of_level(place, (up - one).to_f64() as u32);
        }
        let finer = floor(level);
        let (t, k) = (level - finer, finer.to_f64() as u32);
        let fine = self.of_level(place, k);
        if t > zero {
            return lerp_texels(fine, self.of_level(place, (k + 1).min(last)), t);
        }
        fine
    }

    fn level_of<R: Real>(&self, steps: &[[R; 3]; 2]) -> R {
        let [width, height, _] = self.image.extent(0);
        let length = |step: &[R; 3]| {
            let (x, y) = (
                step[0] * R::from_f64(width.into()),
                step[1] * R::from_f64(height.into()),
            );
            apply_unary(UnaryOp::Sqrt, x * x + y * y)
        };
        let [across, down] = [length(&steps[0]), length(&steps[1])];
        let longer = match down.to_f64().is_nan() || across > down {
            true => across,
            false => down,
        };
        apply_unary(UnaryOp::Log2, longer)
    }

    fn of_level<R: Real>(&self, place: [R; 3], level: u32) -> [R; 4] {
        let texel = |x: u32, y: u32, layer: u32| {
            let bits = self.image.texel(x, y, layer, level);
            bits.map(|v| R::from_f64(f32::from_bits(v).into()))
        };
        self.filter_level(place, level, texel)
    }

    /// The share of depths at a place that pass the comparison with `reference`.
    pub fn compare<R: Real>(&self, place: [R; 3], reference: R) -> R {
        self.filter_level(place, 0, |x, y, layer| [self.compare_texel(x, y, layer, reference); 4])[0]
    }

    /// 1 for each of the four depths around `uv` that passes the comparison with `reference`.
    pub fn gather_compare<R: Real>(&self, uv: [R; 3], reference: R) -> [R; 4] {
        let ([x, y], _) = self.level_footprint(uv, 0);
        let tap = |dx, dy| {
            let [x, y] = self.wrap_coordinates([x + dx, y + dy], 0);
            self.compare_texel(x, y, self.layer, reference)
        };
        [tap(0, 1), tap(1, 1), tap(1, 0), tap(0, 0)]
    }

    fn compare_texel<R: Real>(&self, x: u32, y: u32, layer: u32, reference: R) -> R {
        let depth = R::from_f64(f32::from_bits(self.image.texel(x, y, layer, 0)[0]).into());
        let holds = match self.state.comparison {
            Comparison::Less => reference < depth,
            Comparison::LessEqual => reference <= depth,
            Comparison::Greater => reference > depth,
            Comparison::GreaterEqual => reference >= depth,
        };
        R::from_f64(if holds { 1.0 } else { 0.0 })
    }

    /// A component of the four texels around `uv`.
    pub fn gather<R: Real>(&self, component: u8, uv: [R; 3]) -> [R; 4] {
        let ([x, y], _) = self.level_footprint(uv, 0);
        let tap = |dx, dy| {
            let [x, y] = self.wrap_coordinates([x + dx, y + dy], 0);
            let bits = self.image.texel(x, y, self.layer, 0)[component as usize & 3];
            R::from_f64(f32::from_bits(bits).into())
        };
        [tap(0, 1), tap(1, 1), tap(1, 0), tap(0, 0)]
    }

    /// Filters the texels of a level: `texel` returns those inside by column, row and layer, slice or face.
    fn filter_level<R: Real>(&self, place: [R; 3], level: u32, texel: impl Fn(u32, u32, u32) -> [R; 4]) -> [R; 4] {
        let linear = self.state.linear;
        if self.kind.is_cube() {
            return cube::filter_cube(self.image.extent(level)[0], linear, place, texel);
        }
        let flat = |layer: u32| {
            let texel = |at: [i64; 2]| {
                let [x, y] = self.wrap_coordinates(at, level);
                texel(x, y, layer)
            };
            if !linear {
                let at = self.texel_place(place, level).map(|v| index(floor(v)));
                return texel([at[0], at[1]]);
            }
            let ([x, y], [tx, ty]) = self.level_footprint(place, level);
            let upper = lerp_texels(texel([x, y]), texel([x + 1, y]), tx);
            let lower = lerp_texels(texel([x, y + 1]), texel([x + 1, y + 1]), tx);
            lerp_texels(upper, lower, ty)
        };
        if self.kind != TextureKind::Volume {
            return flat(self.layer.min(self.image.extent(level)[2] - 1));
        }
        let depth = self.image.extent(level)[2];
        let (at, wrapped) = (self.texel_place(place, level)[2], |k| {
            wrap(self.state.address, k, depth)
        });
        if !linear {
            return flat(wrapped(index(floor(at))));
        }
        let from = at - R::from_f64(0.5);
        let slice = floor(from);
        let k = index(slice);
        lerp_texels(flat(wrapped(k)), flat(wrapped(k + 1)), from - slice)
    }

    fn wrap_coordinates(&self, at: [i64; 2], level: u32) -> [u32; 2] {
        let [width, height, _] = self.image.extent(level);
        let address = self.state.address;
        [wrap(address, at[0], width), wrap(address, at[1], height)]
    }

    /// The upper left of the four texels around a place, and the weights of those to the right and below.
    fn level_footprint<R: Real>(&self, place: [R; 3], level: u32) -> ([i64; 2], [R; 2]) {
        let at = self.texel_place(place, level);
        linear_footprint([at[0], at[1]])
    }

    /// A place in texels of a level.
    fn texel_place<R: Real>(&self, place: [R; 3], level: u32) -> [R; 3] {
        let extent = self.image.extent(level);
        [0, 1, 2].map(|k| place[k] * R::from_f64(extent[k].into()))
    }
}

/// The upper left of the four texels around a place in texels, and the weights of those to the right and below.
pub fn linear_footprint<R: Real>(at: [R; 2]) -> ([i64; 2], [R; 2]) {
    let from = at.map(|v| v - R::from_f64(0.5));
    let corner = from.map(floor);
    let t = [from[0] - corner[0], from[1] - corner[1]];
    (corner.map(index), t)
}

/// From `a` to `b` as `t` goes from 0 to 1.
pub fn lerp_texels<R: Real>(a: [R; 4], b: [R; 4], t: R) -> [R; 4] {
    let one = R::from_f64(1.0);
    let lane = |k: usize| a[k] * (one - t) + b[k] * t;
    [lane(0), lane(1), lane(2), lane(3)]
}

/// A column, row or slice by number. One that is far from any texture stands for all beyond, as natively.
fn index<R: Real>(whole: R) -> i64 {
    const FARTHEST: i64 = 1 << 30;
    (whole.to_f64() as i64).clamp(-FARTHEST, FARTHEST)
}

/// The largest integer that is not above.
pub fn floor<R: Real>(x: R) -> R {
    apply_unary(UnaryOp::Floor, x)
}

/// An operation on one number.
pub fn apply_unary<R: Real>(op: UnaryOp, x: R) -> R {
    x.unary(op).unwrap_or(x)
}

fn wrap(address: Address, k: i64, size: u32) -> u32 {
    let n = i64::from(size);
    let inside = match address {
        Address::Clamp => k.clamp(0, n - 1),
        Address::Repeat => k.rem_euclid(n),
        Address::Mirror => {
            let k = k.rem_euclid(2 * n);
            k.min(2 * n - 1 - k)
        }
    };
    inside as u32
}

//! Reading between texels, as the prelude's textures do natively.

use super::bindings::{Address, Comparison, SamplerState, Texels};
use crate::ir::{Real, UnaryOp};

/// A texture seen through a sampler.
pub struct Sampled<'a> {
    /// The image.
    pub image: &'a dyn Texels,
    /// How it is read.
    pub state: SamplerState,
}

impl Sampled<'_> {
    fn texel<R: Real>(&self, x: i64, y: i64) -> [R; 4] {
        let [width, height, _] = self.image.extent();
        let (x, y) = (wrap(self.state.address, x, width), wrap(self.state.address, y, height));
        self.image.texel(x, y, 0).map(|v| R::from_f64(v.into()))
    }

    /// Texels through the sampler at `uv`.
    pub fn sample<R: Real>(&self, uv: [R; 2]) -> [R; 4] {
        self.filtered(uv, |x, y| self.texel(x, y))
    }

    /// The share of depths at `uv` that pass the comparison with `reference`.
    pub fn compare<R: Real>(&self, uv: [R; 2], reference: R) -> R {
        self.filtered(uv, |x, y| [self.passes(x, y, reference); 4])[0]
    }

    /// 1 for each of the four depths around `uv` that passes the comparison with `reference`.
    pub fn gather_compare<R: Real>(&self, uv: [R; 2], reference: R) -> [R; 4] {
        let ([x, y], _) = self.footprint(uv);
        let tap = |dx, dy| self.passes(x + dx, y + dy, reference);
        [tap(0, 1), tap(1, 1), tap(1, 0), tap(0, 0)]
    }

    fn passes<R: Real>(&self, x: i64, y: i64, reference: R) -> R {
        let depth = self.texel::<R>(x, y)[0];
        let holds = match self.state.comparison {
            Comparison::Less => reference < depth,
            Comparison::LessEqual => reference <= depth,
            Comparison::Greater => reference > depth,
            Comparison::GreaterEqual => reference >= depth,
        };
        R::from_f64(if holds { 1.0 } else { 0.0 })
    }

    /// A component of the four texels around `uv`.
    pub fn gather<R: Real>(&self, component: u8, uv: [R; 2]) -> [R; 4] {
        let ([x, y], _) = self.footprint(uv);
        let tap = |dx, dy| self.texel::<R>(x + dx, y + dy)[component as usize & 3];
        [tap(0, 1), tap(1, 1), tap(1, 0), tap(0, 0)]
    }

    fn filtered<R: Real>(&self, uv: [R; 2], texel: impl Fn(i64, i64) -> [R; 4]) -> [R; 4] {
        if !self.state.linear {
            let at = self.place(uv).map(|v| floor(v).to_f64() as i64);
            return texel(at[0], at[1]);
        }
        let ([x, y], [tx, ty]) = self.footprint(uv);
        let one = R::from_f64(1.0);
        let between = |a: [R; 4], b: [R; 4], t: R| {
            let lane = |k: usize| a[k] * (one - t) + b[k] * t;
            [lane(0), lane(1), lane(2), lane(3)]
        };
        let upper = between(texel(x, y), texel(x + 1, y), tx);
        let lower = between(texel(x, y + 1), texel(x + 1, y + 1), tx);
        between(upper, lower, ty)
    }

    /// The upper left of the four texels around a place, and the weights of those to the right and below.
    fn footprint<R: Real>(&self, uv: [R; 2]) -> ([i64; 2], [R; 2]) {
        let from = self.place(uv).map(|v| v - R::from_f64(0.5));
        let corner = from.map(floor);
        let t = [from[0] - corner[0], from[1] - corner[1]];
        (corner.map(|v| v.to_f64() as i64), t)
    }

    fn place<R: Real>(&self, uv: [R; 2]) -> [R; 2] {
        let [width, height, _] = self.image.extent();
        [uv[0] * R::from_f64(width.into()), uv[1] * R::from_f64(height.into())]
    }
}

fn floor<R: Real>(x: R) -> R {
    x.unary(UnaryOp::Floor).unwrap_or(x)
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

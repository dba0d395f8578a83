//// CRT by Lottes: a constant argument of a method
// Source: CRT-Lottes, public domain CRT styled scan-line shader by Timothy Lottes.
const HARD_SCAN: f32 = -8.0;
const HARD_PIX: f32 = -3.0;
const WARP: Vec2 = Vec2::new(1.0 / 32.0, 1.0 / 24.0);
const MASK_DARK: f32 = 0.5;
const MASK_LIGHT: f32 = 1.5;
const HARD_BLOOM_SCAN: f32 = -2.0;
const HARD_BLOOM_PIX: f32 = -1.5;
const BLOOM_AMOUNT: f32 = 1.0 / 16.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowMask {
    CompressedTv,
    Aperture,
    StretchedVga,
    Vga,
}

options! {
    /// The tube.
    pub struct Tube {
        /// Arrangement of the phosphors.
        pub mask: ShadowMask = ShadowMask::StretchedVga,
    }
}

fn to_linear1(c: f32) -> f32 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

fn to_srgb1(c: f32) -> f32 {
    if c < 0.0031308 { c * 12.92 } else { 1.055 * c.powf(0.41666) - 0.055 }
}

struct Crt<'a> {
    source: &'a Texture<Vec4>,
    nearest: &'a Sampler,
    res: Vec2,
}

impl Crt<'_> {
    fn fetch(&self, pos: Vec2, off: Vec2) -> Vec3 {
        let pos = (pos * self.res + off).floor() / self.res;
        if (pos - 0.5).abs().max_element() > 0.5 {
            return Vec3::ZERO;
        }
        self.source.sample(self.nearest, pos + 0.5 / self.res).xyz().map(to_linear1)
    }

    fn dist(&self, pos: Vec2) -> Vec2 {
        let pos = pos * self.res;
        -((pos - pos.floor()) - Vec2::splat(0.5))
    }

    fn horz<const TAPS: usize>(&self, pos: Vec2, off: f32, scale: f32) -> Vec3 {
        let dst = self.dist(pos).x;
        let half = (TAPS / 2) as i32;
        let (mut sum, mut total) = (Vec3::ZERO, 0.0);
        for k in -half..=half {
            let w = gaus(dst + k as f32, scale);
            sum += self.fetch(pos, vec2(k as f32, off)) * w;
            total += w;
        }
        sum / total
    }

    fn scan(&self, pos: Vec2, off: f32, scale: f32) -> f32 {
        gaus(self.dist(pos).y + off, scale)
    }

    fn tri(&self, pos: Vec2) -> Vec3 {
        let a = self.horz::<3>(pos, -1.0, HARD_PIX);
        let b = self.horz::<5>(pos, 0.0, HARD_PIX);
        let c = self.horz::<3>(pos, 1.0, HARD_PIX);
        a * self.scan(pos, -1.0, HARD_SCAN) + b * self.scan(pos, 0.0, HARD_SCAN) + c * self.scan(pos, 1.0, HARD_SCAN)
    }

    fn bloom(&self, pos: Vec2) -> Vec3 {
        let rows = [
            (-2.0, self.horz::<5>(pos, -2.0, HARD_BLOOM_PIX)),
            (-1.0, self.horz::<7>(pos, -1.0, HARD_BLOOM_PIX)),
            (0.0, self.horz::<7>(pos, 0.0, HARD_BLOOM_PIX)),
            (1.0, self.horz::<7>(pos, 1.0, HARD_BLOOM_PIX)),
            (2.0, self.horz::<5>(pos, 2.0, HARD_BLOOM_PIX)),
        ];
        rows.iter().map(|&(off, row)| row * self.scan(pos, off, HARD_BLOOM_SCAN)).sum()
    }
}

fn gaus(pos: f32, scale: f32) -> f32 {
    (scale * pos * pos).exp2()
}

fn warp(pos: Vec2) -> Vec2 {
    let pos = pos * 2.0 - 1.0;
    let pos = pos * vec2(1.0 + pos.y * pos.y * WARP.x, 1.0 + pos.x * pos.x * WARP.y);
    pos * 0.5 + 0.5
}

fn mask(kind: ShadowMask, mut pos: Vec2) -> Vec3 {
    let mut mask = Vec3::splat(MASK_DARK);
    let light_third = |mask: &mut Vec3, x: f32| {
        if x < 0.333 {
            mask.x = MASK_LIGHT;
        } else if x < 0.666 {
            mask.y = MASK_LIGHT;
        } else {
            mask.z = MASK_LIGHT;
        }
    };
    match kind {
        ShadowMask::CompressedTv => {
            let mut line = MASK_LIGHT;
            let odd = if fract(pos.x / 6.0) < 0.5 { 1.0 } else { 0.0 };
            if fract((pos.y + odd) / 2.0) < 0.5 {
                line = MASK_DARK;
            }
            light_third(&mut mask, fract(pos.x / 3.0));
            mask *= line;
        }
        ShadowMask::Aperture => light_third(&mut mask, fract(pos.x / 3.0)),
        ShadowMask::StretchedVga => {
            pos.x += pos.y * 3.0;
            light_third(&mut mask, fract(pos.x / 6.0));
        }
        ShadowMask::Vga => {
            pos = (pos * vec2(1.0, 0.5)).floor();
            pos.x += pos.y * 3.0;
            light_third(&mut mask, fract(pos.x / 6.0));
        }
    }
    mask
}

pub fn crt(cfg: &Tube, image: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let crt = Crt { source: image, nearest: linear, res: image.size().as_vec2() };
    let frag = pixel.as_vec2() + 0.5;
    let pos = warp(frag / resolution.as_vec2());
    let lit = (crt.tri(pos) + crt.bloom(pos) * BLOOM_AMOUNT) * mask(cfg.mask, frag);
    lit.map(to_srgb1).extend(1.0)
}

//// Gabor noise: `flat_map`
// Source: Lagae, Lefebvre, Drettakis, Dutre 2009: procedural noise by sparse Gabor convolution.
use std::f32::consts::{PI, TAU};

struct Lcg(u32);

impl Lcg {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(3039177861);
        self.0
    }

    fn uniform(&mut self) -> f32 {
        self.next() as f32 / u32::MAX as f32
    }

    fn range(&mut self, min: f32, max: f32) -> f32 {
        min + self.uniform() * (max - min)
    }

    fn poisson(&mut self, mean: f32) -> u32 {
        let g = (-mean).exp();
        let mut em = 0;
        let mut t = self.uniform();
        while t > g {
            em += 1;
            t *= self.uniform();
        }
        em
    }
}

fn morton(x: u32, y: u32) -> u32 {
    let part = |mut v: u32| {
        v &= 0xffff;
        v = (v | (v << 8)) & 0x00ff00ff;
        v = (v | (v << 4)) & 0x0f0f0f0f;
        v = (v | (v << 2)) & 0x33333333;
        (v | (v << 1)) & 0x55555555
    };
    part(x) | (part(y) << 1)
}

pub struct Noise {
    pub k: f32,
    pub a: f32,
    pub f0: f32,
    pub omega0: f32,
    pub impulses: f32,
    pub offset: u32,
}

impl Noise {
    fn kernel_radius(&self) -> f32 {
        (-0.05f32.ln() / PI).sqrt() / self.a
    }

    fn gabor(&self, omega: f32, p: Vec2) -> f32 {
        let envelope = self.k * (-PI * self.a * self.a * p.length_squared()).exp();
        envelope * (TAU * self.f0 * (p.x * omega.cos() + p.y * omega.sin())).cos()
    }

    fn cell(&self, cell: IVec2, p: Vec2) -> f32 {
        let seed = morton(cell.x as u32, cell.y as u32).wrapping_add(self.offset);
        let mut prng = Lcg(if seed == 0 { 1 } else { seed });
        let radius = self.kernel_radius();
        let density = self.impulses / (PI * radius * radius);
        let count = prng.poisson(density * radius * radius);
        let mut noise = 0.0;
        for _ in 0..count {
            let at = vec2(prng.uniform(), prng.uniform());
            let weight = prng.range(-1.0, 1.0);
            let _unused = prng.range(0.0, TAU);
            let d = p - at;
            if d.length_squared() < 1.0 {
                noise += weight * self.gabor(self.omega0, d * radius);
            }
        }
        noise
    }

    fn at(&self, p: Vec2) -> f32 {
        let p = p / self.kernel_radius();
        let base = p.floor();
        let frac = p - base;
        let mut noise = 0.0;
        for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
            noise += self.cell(base.as_ivec2() + ivec2(i, j), frac - vec2(i as f32, j as f32));
        }
        noise
    }
}

pub fn gabor(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> f32 {
    let noise = Noise { k: 1.0, a: 0.05, f0: 0.0625 * strength, omega0: 0.785, impulses: 8.0, offset: 7 };
    color.load(pixel).x + noise.at(pixel.as_vec2()) * 0.25
}

//// XDoG: an array of structures in a loop with runtime bounds
// Source: Winnemoeller, Kyprianidis, Olsen 2012: XDoG, one pass with two Gaussians and soft thresholding.
struct Gaussian {
    inv_two_sigma2: f32,
    sum: f32,
    norm: f32,
}

impl Gaussian {
    fn new(sigma: f32) -> Self {
        Self { inv_two_sigma2: (2.0 * sigma * sigma).recip(), sum: 0.0, norm: 0.0 }
    }

    fn push(&mut self, d2: f32, value: f32) -> &mut Self {
        let w = (-d2 * self.inv_two_sigma2).exp();
        self.sum += w * value;
        self.norm += w;
        self
    }

    fn value(&self) -> f32 {
        self.sum / self.norm
    }
}

pub fn xdog(color: &Frame<Vec4>, tint: Vec4, strength: f32, pixel: IVec2) -> Vec4 {
    let Vec4 { x: sigma, y: tau, z: epsilon, w: phi } = tint;
    let k = strength;
    let mut gaussians = [Gaussian::new(sigma), Gaussian::new(sigma * k)];
    let reach = (2.0 * sigma * k).ceil() as i32;
    for y in -reach..=reach {
        for x in -reach..=reach {
            let luma = color.load(pixel + ivec2(x, y)).xyz().dot(vec3(0.299, 0.587, 0.114));
            for g in gaussians.iter_mut() {
                g.push((x * x + y * y) as f32, luma);
            }
        }
    }
    let [narrow, wide] = &gaussians;
    let d = (1.0 + tau) * narrow.value() - tau * wide.value();
    let e = if d >= epsilon { 1.0 } else { 1.0 + (phi * (d - epsilon)).tanh() };
    Vec3::splat(e).extend(1.0)
}

//// Shadows by moments: `&dyn Trait` chosen by an option
// Source: Peters and Klein 2015, Hamburger 4-moment shadow mapping, with VSM and ESM beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Technique {
    Variance,
    Exponential,
    Moments,
}

options! {
    /// Filterable shadows.
    pub struct ShadowOptions {
        /// Shadow technique.
        pub technique: Technique = Technique::Moments,
        /// Amount of light bleeding to cut off.
        pub bleeding: f32 [0.0..=0.9] = 0.2,
    }
}

trait ShadowTest {
    fn lit(&self, moments: Vec4, depth: f32) -> f32;
}

struct Vsm {
    min_variance: f32,
}
struct Esm(f32);
struct Msm {
    moment_bias: f32,
}

impl ShadowTest for Vsm {
    fn lit(&self, m: Vec4, depth: f32) -> f32 {
        if depth <= m.x {
            return 1.0;
        }
        let variance = (m.y - m.x * m.x).max(self.min_variance);
        let d = depth - m.x;
        variance / (variance + d * d)
    }
}

impl ShadowTest for Esm {
    fn lit(&self, m: Vec4, depth: f32) -> f32 {
        saturate((self.0 * (m.x - depth)).exp())
    }
}

impl ShadowTest for Msm {
    fn lit(&self, moments: Vec4, depth: f32) -> f32 {
        let b = moments.lerp(Vec4::splat(0.5), self.moment_bias);
        let mut z = Vec3::ZERO;
        z[0] = depth;
        // Cholesky factorisation of the Hankel matrix.
        let l32_d22 = -b[0] * b[1] + b[2];
        let d22 = -b[0] * b[0] + b[1];
        let squared_depth_variance = -b[1] * b[1] + b[3];
        let d33_d22 = squared_depth_variance * d22 - l32_d22 * l32_d22;
        let inv_d22 = 1.0 / d22;
        let l32 = l32_d22 * inv_d22;
        let mut c = vec3(1.0, z.x, z.x * z.x);
        c.y -= b.x;
        c.z -= b.y + l32 * c.y;
        c.y *= inv_d22;
        c.z *= d22 / d33_d22;
        c.y -= l32 * c.z;
        c.x -= c.yz().dot(b.xy());
        let inv_c2 = 1.0 / c.z;
        let p = c.y * inv_c2;
        let q = c.x * inv_c2;
        let r = ((p * p * 0.25) - q).sqrt();
        z.y = -p * 0.5 - r;
        z.z = -p * 0.5 + r;
        let switch = if z.z < z.x {
            vec4(z.y, z.x, 1.0, 1.0)
        } else if z.y < z.x {
            vec4(z.x, z.y, 0.0, 1.0)
        } else {
            Vec4::ZERO
        };
        let quotient = (switch.x * z.z - b.x * (switch.x + z.z) + b.y) / ((z.z - switch.y) * (z.x - z.y));
        1.0 - saturate(switch.z + switch.w * quotient)
    }
}

fn reduce_bleeding(lit: f32, amount: f32) -> f32 {
    saturate((lit - amount) / (1.0 - amount))
}

pub fn shadowed(cfg: &ShadowOptions, image: &Texture<Vec4>, linear: &Sampler, color: &Frame<Vec4>, pixel: IVec2) -> f32 {
    let Vec4 { x: u, y: v, z: depth, .. } = color.load(pixel);
    let m = image.sample(linear, vec2(u, v));
    let test: &dyn ShadowTest = match cfg.technique {
        Technique::Variance => &Vsm { min_variance: 1e-5 },
        Technique::Exponential => &Esm(80.0),
        Technique::Moments => &Msm { moment_bias: 3e-5 },
    };
    reduce_bleeding(test.lit(m, depth), cfg.bleeding)
}

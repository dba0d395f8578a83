//// Perlin's noise: a table of `u8`, constant parameters
#[rustfmt::skip]
const PERM: [u8; 256] = [
    151,160,137,91,90,15,131,13,201,95,96,53,194,233,7,225,140,36,103,30,69,142,8,99,37,240,21,10,23,
    190,6,148,247,120,234,75,0,26,197,62,94,252,219,203,117,35,11,32,57,177,33,88,237,149,56,87,174,
    20,125,136,171,168,68,175,74,165,71,134,139,48,27,166,77,146,158,231,83,111,229,122,60,211,133,
    230,220,105,92,41,55,46,245,40,244,102,143,54,65,25,63,161,1,216,80,73,209,76,132,187,208,89,18,
    169,200,196,135,130,116,188,159,86,164,100,109,198,173,186,3,64,52,217,226,250,124,123,5,202,38,
    147,118,126,255,82,85,212,207,206,59,227,47,16,58,17,182,189,28,42,223,183,170,213,119,248,152,2,
    44,154,163,70,221,153,101,155,167,43,172,9,129,22,39,253,19,98,108,110,79,113,224,232,178,185,112,
    104,218,246,97,228,251,34,242,193,238,210,144,12,191,179,162,241,81,51,145,235,249,14,239,107,49,
    192,214,31,181,199,106,157,184,84,204,176,115,121,50,45,127,4,150,254,138,236,205,93,222,114,67,
    29,24,72,243,141,128,195,78,66,215,61,156,180,
];

fn perm(i: i32) -> i32 {
    PERM[(i & 255) as usize] as i32
}

fn fade(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

fn grad(hash: i32, p: Vec3) -> f32 {
    let h = hash & 15;
    let u = if h < 8 { p.x } else { p.y };
    let v = if h < 4 {
        p.y
    } else if h == 12 || h == 14 {
        p.x
    } else {
        p.z
    };
    (if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v })
}

fn lerp(t: f32, a: f32, b: f32) -> f32 {
    a + t * (b - a)
}

fn noise(p: Vec3) -> f32 {
    let i = p.floor();
    let IVec3 { x, y, z } = i.as_ivec3() & 255;
    let f = p - i;
    let (u, v, w) = (fade(f.x), fade(f.y), fade(f.z));
    let a = perm(x) + y;
    let aa = perm(a) + z;
    let ab = perm(a + 1) + z;
    let b = perm(x + 1) + y;
    let ba = perm(b) + z;
    let bb = perm(b + 1) + z;
    lerp(w,
        lerp(v,
            lerp(u, grad(perm(aa), f), grad(perm(ba), f - Vec3::X)),
            lerp(u, grad(perm(ab), f - Vec3::Y), grad(perm(bb), f - vec3(1.0, 1.0, 0.0)))),
        lerp(v,
            lerp(u, grad(perm(aa + 1), f - Vec3::Z), grad(perm(ba + 1), f - vec3(1.0, 0.0, 1.0))),
            lerp(u, grad(perm(ab + 1), f - vec3(0.0, 1.0, 1.0)), grad(perm(bb + 1), f - Vec3::ONE))))
}

fn fbm<const OCTAVES: usize>(mut p: Vec3, gain: f32) -> f32 {
    let mut sum = 0.0;
    let mut amplitude = 0.5;
    for _ in 0..OCTAVES {
        sum += amplitude * noise(p);
        amplitude *= gain;
        p = 2.0 * p + Vec3::splat(17.3);
    }
    sum
}

pub fn perlin(strength: f32, pixel: IVec2) -> Vec4 {
    let uv = pixel.as_vec2() / 7.0;
    let p = (uv * 8.0).extend(strength);
    let q = Vec3::from_array([fbm::<3>(p, 0.5), fbm::<3>(p + vec3(5.2, 1.3, 0.0), 0.5), 0.0]);
    let n = fbm::<5>(p + 4.0 * q, 0.5);
    Vec4::splat(n * 0.5 + 0.5).with_w(1.0)
}

//// Cellular noise: guards, closures and functions as metrics
fn hash22(p: IVec2) -> Vec2 {
    let mut v = p.as_uvec2().wrapping_mul(UVec2::splat(1664525)).wrapping_add(UVec2::splat(1013904223));
    v.x = v.x.wrapping_add(v.y.wrapping_mul(1664525));
    v.y = v.y.wrapping_add(v.x.wrapping_mul(1664525));
    v ^= v >> 16u32;
    v.x = v.x.wrapping_add(v.y.wrapping_mul(1664525));
    v.y = v.y.wrapping_add(v.x.wrapping_mul(1664525));
    v ^= v >> 16u32;
    v.as_vec2() / u32::MAX as f32
}

#[derive(Default, Clone, Copy)]
struct Cell {
    f1: f32,
    f2: f32,
    border: f32,
    id: IVec2,
}

fn cells(p: Vec2, metric: impl Fn(Vec2) -> f32) -> Cell {
    let base = p.floor().as_ivec2();
    let f = p.fract_gl();
    let mut cell = Cell { f1: f32::MAX, f2: f32::MAX, ..Default::default() };
    let mut to_nearest = Vec2::ZERO;
    for (dx, dy) in (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y))) {
        let g = ivec2(dx, dy);
        let r = g.as_vec2() + hash22(base + g) - f;
        match metric(r) {
            d if d < cell.f1 => {
                cell = Cell { f1: d, f2: cell.f1, id: base + g, ..cell };
                to_nearest = r;
            }
            d if d < cell.f2 => cell.f2 = d,
            _ => {}
        }
    }
    cell.border = f32::MAX;
    let center = cell.id - base;
    for dy in -2..=2 {
        for dx in -2..=2 {
            let g = center + ivec2(dx, dy);
            let r = g.as_vec2() + hash22(base + g) - f;
            let away = r - to_nearest;
            if away.length_squared() > 1e-5 {
                cell.border = cell.border.min((0.5 * (to_nearest + r)).dot(away.normalize()));
            }
        }
    }
    cell
}

fn palette(t: f32, [a, b, c, d]: [Vec3; 4]) -> Vec3 {
    a + b * (std::f32::consts::TAU * (c * t + d)).map(f32::cos)
}

pub fn voronoi(strength: f32, taps: i32, pixel: IVec2) -> Vec4 {
    let p = pixel.as_vec2() / 3.0 + strength;
    let cell = match taps + pixel.y % 3 {
        0 => cells(p, |v| v.length()),
        1 => cells(p, |v| v.abs().element_sum()),
        2 => cells(p, |v| v.abs().max_element()),
        _ => cells(p, Vec2::length_squared),
    };
    let tint = palette(hash22(cell.id).x, [Vec3::splat(0.5), Vec3::splat(0.5), Vec3::ONE, vec3(0.0, 0.33, 0.67)]);
    let edge = smoothstep(0.02, 0.05, cell.border);
    (tint * edge * (cell.f2 - cell.f1).min(1.0)).extend(1.0)
}

//// Dithering to a palette: tables by `const fn`, bytes, `min_by`
const PALETTE: [u32; 8] = [0x1a1c2c, 0x5d275d, 0xb13e53, 0xef7d57, 0xffcd75, 0xa7f070, 0x38b764, 0x257179];

const fn bayer<const N: usize>() -> [[u32; N]; N] {
    let mut m = [[0; N]; N];
    let mut y = 0;
    while y < N {
        let mut x = 0;
        while x < N {
            let (mut v, mut mask, mut xc, mut yc) = (0, N >> 1, x ^ y, y);
            let mut bit = 0;
            while mask > 0 {
                v |= (yc & 1) << (2 * bit + 0) | (xc & 1) << (2 * bit + 1);
                xc >>= 1;
                yc >>= 1;
                bit += 1;
                mask >>= 1;
            }
            m[y][x] = v as u32;
            x += 1;
        }
        y += 1;
    }
    m
}

static BAYER: [[u32; 8]; 8] = bayer::<8>();

fn unpack(rgb: u32) -> Vec3 {
    let [_, r, g, b] = rgb.to_be_bytes();
    Vec3::new(r as f32, g as f32, b as f32) / 255.0
}

fn linear_to_oklab(c: Vec3) -> Vec3 {
    let lms = Mat3::from_cols(
        vec3(0.4122214708, 0.2119034982, 0.0883024619),
        vec3(0.5363325363, 0.6806995451, 0.2817188376),
        vec3(0.0514459929, 0.1073969566, 0.6299787005),
    ) * c;
    let lms = lms.map(|x| x.cbrt());
    Mat3::from_cols(
        vec3(0.2104542553, 1.9779984951, 0.0259040371),
        vec3(0.7936177850, -2.4285922050, 0.7827717662),
        vec3(-0.0040720468, 0.4505937099, -0.8086757660),
    ) * lms
}

pub fn palette_dither(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    let threshold = BAYER[(pixel.y & 7) as usize][(pixel.x & 7) as usize] as f32 / 64.0 - 0.5;
    let target = linear_to_oklab((color.load(pixel).truncate() + strength * threshold).max(Vec3::ZERO));
    let nearest = PALETTE
        .iter()
        .map(|&rgb| unpack(rgb))
        .min_by(|&a, &b| {
            let d = |c: Vec3| linear_to_oklab(c * c).distance_squared(target);
            d(a).total_cmp(&d(b))
        })
        .unwrap();
    nearest.extend(1.0)
}

//// Contour lines: a table of slices of tuples, `use Edge::*`
use Edge::*;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Edge {
    Left,
    Right,
    Top,
    Bottom,
}

type Segment = (Edge, Edge);

const CASES: [&[Segment]; 16] = [
    &[],
    &[(Left, Top)],
    &[(Top, Right)],
    &[(Left, Right)],
    &[(Right, Bottom)],
    &[(Left, Top), (Right, Bottom)],
    &[(Top, Bottom)],
    &[(Left, Bottom)],
    &[(Bottom, Left)],
    &[(Top, Bottom)],
    &[(Top, Right), (Bottom, Left)],
    &[(Bottom, Right)],
    &[(Right, Left)],
    &[(Right, Top)],
    &[(Top, Left)],
    &[],
];

#[derive(Clone, Copy)]
struct Square {
    corners: [f32; 4],
}

impl Square {
    fn code(&self, level: f32) -> usize {
        self.corners.iter().enumerate().map(|(i, &c)| usize::from(c > level) << i).sum()
    }

    fn point(&self, edge: Edge, level: f32) -> Vec2 {
        let [a, b, c, d] = self.corners;
        let t = |from: f32, to: f32| if from == to { 0.5 } else { (level - from) / (to - from) };
        match edge {
            Left => vec2(0.0, t(a, d)),
            Right => vec2(1.0, t(b, c)),
            Top => vec2(t(a, b), 0.0),
            Bottom => vec2(t(d, c), 1.0),
        }
    }
}

fn segment_distance(p: Vec2, a: Vec2, b: Vec2) -> f32 {
    let (pa, ba) = (p - a, b - a);
    let h = (pa.dot(ba) / ba.length_squared().max(1e-12)).clamp(0.0, 1.0);
    (pa - ba * h).length()
}

pub fn contours(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let (levels, scale) = ([0.2, 0.5, 0.8], taps + 2);
    let cell = pixel / scale;
    let local = (pixel % scale).as_vec2() / scale as f32;
    let square = Square {
        corners: [IVec2::ZERO, IVec2::X, IVec2::ONE, IVec2::Y].map(|o| color.load(cell + o).x),
    };
    let mut nearest = f32::INFINITY;
    for level in levels {
        let code = square.code(level);
        for (case, segments) in CASES.iter().enumerate() {
            if case == code {
                for &(from, to) in segments.iter() {
                    nearest = nearest.min(segment_distance(local, square.point(from, level), square.point(to, level)));
                }
            }
        }
    }
    let ink = (1.5 - nearest * scale as f32).clamp(0.0, 1.0);
    Vec4::splat(1.0 - ink)
}

//// A Mandelbrot set in pairs of floats: generic complex numbers
use std::ops::{Add, Mul, Neg, Sub};

#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Double {
    hi: f32,
    lo: f32,
}

impl Double {
    fn new(x: f32) -> Self {
        Self { hi: x, lo: 0.0 }
    }
    fn quick_two_sum(a: f32, b: f32) -> Self {
        let s = a + b;
        Self { hi: s, lo: b - (s - a) }
    }
    fn two_sum(a: f32, b: f32) -> Self {
        let s = a + b;
        let bb = s - a;
        Self { hi: s, lo: (a - (s - bb)) + (b - bb) }
    }
    fn split(a: f32) -> (f32, f32) {
        let t = 4097.0 * a;
        let hi = t - (t - a);
        (hi, a - hi)
    }
    fn two_product(a: f32, b: f32) -> Self {
        let p = a * b;
        let (ah, al) = Self::split(a);
        let (bh, bl) = Self::split(b);
        Self { hi: p, lo: ((ah * bh - p) + ah * bl + al * bh) + al * bl }
    }
}

impl Add for Double {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        let s = Self::two_sum(self.hi, o.hi);
        Self::quick_two_sum(s.hi, s.lo + self.lo + o.lo)
    }
}
impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}
impl Sub for Double {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}
impl Mul for Double {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let p = Self::two_product(self.hi, o.hi);
        Self::quick_two_sum(p.hi, p.lo + self.hi * o.lo + self.lo * o.hi)
    }
}
impl From<f32> for Double {
    fn from(x: f32) -> Self {
        Self::new(x)
    }
}

#[derive(Clone, Copy)]
struct Complex<T> {
    re: T,
    im: T,
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Complex<T> {
    fn square(self) -> Self {
        let cross = self.re * self.im;
        Complex { re: self.re * self.re - self.im * self.im, im: cross + cross }
    }
}

impl<T: Add<Output = T>> Add for Complex<T> {
    type Output = Complex<T>;
    fn add(self, o: Self) -> Self {
        Complex { re: self.re + o.re, im: self.im + o.im }
    }
}

pub fn deep_mandelbrot(strength: f32, taps: i32, pixel: IVec2) -> Vec4 {
    let (center_hi, center_lo) = (vec2(-0.5, 0.0), vec2(1e-9, 2e-9));
    let uv = (pixel.as_vec2() - 4.0) / 3.0 * strength;
    let c = Complex {
        re: Double { hi: center_hi.x, lo: center_lo.x } + uv.x.into(),
        im: Double { hi: center_hi.y, lo: center_lo.y } + Double::from(uv.y),
    };
    let mut z = Complex { re: Double::new(0.0), im: Double::new(0.0) };
    let mut n = 0u32;
    let escaped = loop {
        if n == 8 + taps as u32 {
            break None;
        }
        z = z.square() + c;
        let norm = z.re * z.re + z.im * z.im;
        if norm > Double::new(256.0) {
            break Some(norm.hi);
        }
        n += 1;
    };
    let Some(norm) = escaped else { return Vec4::W };
    let smooth = n as f32 + 1.0 - (norm.ln() * 0.5).log2();
    let color = 0.5 + 0.5 * (vec3(3.0, 4.0, 11.0) + smooth * 0.15).map(f32::cos);
    color.extend(1.0)
}

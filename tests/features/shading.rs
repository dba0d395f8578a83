//// A path tracer: enums with data, `?`, `find`, constants of structures
#[derive(Clone, Copy, PartialEq)]
enum Material {
    Diffuse { albedo: Vec3 },
    Mirror { tint: Vec3, fuzz: f32 },
    Glass(f32),
    Light(Vec3),
}

#[derive(Clone, Copy)]
struct Sphere {
    center: Vec3,
    radius: f32,
    material: Material,
}

#[derive(Clone, Copy)]
struct Hit {
    t: f32,
    point: Vec3,
    normal: Vec3,
    front: bool,
    material: Material,
}

#[derive(Debug, Clone, Copy)]
struct Ray {
    origin: Vec3,
    dir: Vec3,
}

struct Rng(u32);

impl Rng {
    fn new(pixel: IVec2, frame: u32) -> Self {
        Self((pixel.x as u32).wrapping_mul(1973) ^ (pixel.y as u32).wrapping_mul(9277) ^ frame.wrapping_mul(26699) | 1)
    }
    fn next_u32(&mut self) -> u32 {
        let state = self.0;
        self.0 = state.wrapping_mul(747796405).wrapping_add(2891336453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277803737);
        (word >> 22) ^ word
    }
    fn next_f32(&mut self) -> f32 {
        (self.next_u32() >> 8) as f32 / (1u32 << 24) as f32
    }
    fn unit_vector(&mut self) -> Vec3 {
        let z = 1.0 - 2.0 * self.next_f32();
        let a = self.next_f32() * std::f32::consts::TAU;
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(r * a.cos(), r * a.sin(), z)
    }
}

const WORLD: [Sphere; 5] = [
    Sphere { center: Vec3::new(0.0, -1000.0, 0.0), radius: 1000.0, material: Material::Diffuse { albedo: Vec3::splat(0.6) } },
    Sphere { center: Vec3::new(-1.1, 0.5, 0.0), radius: 0.5, material: Material::Diffuse { albedo: Vec3::new(0.8, 0.2, 0.2) } },
    Sphere { center: Vec3::new(0.0, 0.5, 0.0), radius: 0.5, material: Material::Glass(1.5) },
    Sphere { center: Vec3::new(1.1, 0.5, 0.0), radius: 0.5, material: Material::Mirror { tint: Vec3::new(0.9, 0.9, 0.8), fuzz: 0.1 } },
    Sphere { center: Vec3::new(0.0, 4.0, 1.0), radius: 1.0, material: Material::Light(Vec3::splat(6.0)) },
];

impl Sphere {
    fn hit(&self, ray: &Ray, min: f32, max: f32) -> Option<Hit> {
        let oc = self.center - ray.origin;
        let h = ray.dir.dot(oc);
        let disc = h * h - oc.length_squared() + self.radius * self.radius;
        if disc < 0.0 {
            return None;
        }
        let s = disc.sqrt();
        let t = [h - s, h + s].into_iter().find(|&t| t > min && t < max)?;
        let point = ray.origin + t * ray.dir;
        let outward = (point - self.center) / self.radius;
        let front = ray.dir.dot(outward) < 0.0;
        Some(Hit { t, point, normal: if front { outward } else { -outward }, front, material: self.material })
    }
}

fn closest(ray: &Ray) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    for sphere in &WORLD {
        let max = best.map_or(f32::INFINITY, |h| h.t);
        if let Some(hit) = sphere.hit(ray, 1e-3, max) {
            best = Some(hit);
        }
    }
    best
}

fn schlick(cosine: f32, ratio: f32) -> f32 {
    let r0 = ((1.0 - ratio) / (1.0 + ratio)).powi(2);
    r0 + (1.0 - r0) * (1.0 - cosine).powi(5)
}

enum Scatter {
    Bounce(Ray, Vec3),
    Emit(Vec3),
}

fn scatter(ray: &Ray, hit: &Hit, rng: &mut Rng) -> Scatter {
    match hit.material {
        Material::Diffuse { albedo } => {
            let dir = (hit.normal + rng.unit_vector()).try_normalize().unwrap_or(hit.normal);
            Scatter::Bounce(Ray { origin: hit.point, dir }, albedo)
        }
        Material::Mirror { tint, fuzz } => {
            let dir = (ray.dir.reflect(hit.normal) + fuzz * rng.unit_vector()).normalize();
            Scatter::Bounce(Ray { origin: hit.point, dir }, tint)
        }
        Material::Glass(index) => {
            let ratio = if hit.front { 1.0 / index } else { index };
            let cosine = (-ray.dir).dot(hit.normal).min(1.0);
            let sine = (1.0 - cosine * cosine).sqrt();
            let dir = if ratio * sine > 1.0 || schlick(cosine, ratio) > rng.next_f32() {
                ray.dir.reflect(hit.normal)
            } else {
                ray.dir.refract(hit.normal, ratio)
            };
            Scatter::Bounce(Ray { origin: hit.point, dir: dir.normalize() }, Vec3::ONE)
        }
        Material::Light(e) => Scatter::Emit(e),
    }
}

fn trace(mut ray: Ray, rng: &mut Rng, bounces: u32) -> Vec3 {
    let mut throughput = Vec3::ONE;
    for _ in 0..bounces {
        let Some(hit) = closest(&ray) else {
            let t = 0.5 * (ray.dir.y + 1.0);
            return throughput * Vec3::ONE.lerp(vec3(0.5, 0.7, 1.0), t);
        };
        match scatter(&ray, &hit, rng) {
            Scatter::Emit(light) => return throughput * light,
            Scatter::Bounce(next, tint) => {
                throughput *= tint;
                ray = next;
            }
        }
        let survive = throughput.max_element();
        if survive < rng.next_f32() {
            break;
        }
        throughput /= survive;
    }
    Vec3::ZERO
}

pub fn path_tracer(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let (frame_index, bounces) = (taps as u32, 2 + taps as u32 % 3);
    let mut rng = Rng::new(pixel, frame_index);
    let size = color.size().as_vec2();
    let jitter = Vec2::new(rng.next_f32(), rng.next_f32());
    let uv = (pixel.as_vec2() + jitter) / size;
    let dir = Vec3::new((uv.x - 0.5) * size.x / size.y, 0.5 - uv.y, -1.0).normalize();
    let ray = Ray { origin: Vec3::new(0.0, 1.0, 4.0), dir };
    let traced = trace(ray, &mut rng, bounces);
    let previous = color.load(pixel);
    previous.lerp(traced.extend(1.0), 1.0 / (frame_index + 1) as f32)
}

//// Packed formats: RGB9E5, R11G11B10, octahedral normals
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
enum Format {
    Rgb9e5 = 1,
    R11g11b10 = 4,
    Oct16 = 9,
}

impl Format {
    const ALL: [Self; 3] = [Self::Rgb9e5, Self::R11g11b10, Self::Oct16];

    fn from_code(code: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|f| *f as u32 == code)
    }
}

#[derive(Clone, Copy)]
struct Rgb9e5(u32);

impl From<Vec3> for Rgb9e5 {
    fn from(color: Vec3) -> Self {
        const MAX: f32 = 511.0 / 512.0 * 65536.0;
        let c = color.clamp(Vec3::ZERO, Vec3::splat(MAX));
        let largest = c.max_element();
        let exponent = (-16i32).max(largest.log2().floor() as i32) + 1 + 15;
        let mut scale = ((exponent - 15 - 9) as f32).exp2();
        let mut exponent = exponent as u32;
        if (largest / scale + 0.5).floor() as u32 == 512 {
            scale *= 2.0;
            exponent += 1;
        }
        let UVec3 { x: r, y: g, z: b } = (c / scale + 0.5).floor().as_uvec3();
        Rgb9e5(exponent << 27 | b << 18 | g << 9 | r)
    }
}

impl From<Rgb9e5> for Vec3 {
    fn from(Rgb9e5(bits): Rgb9e5) -> Vec3 {
        let exponent = (bits >> 27) as i32 - 15 - 9;
        let parts = uvec3(bits, bits >> 9, bits >> 18) & 0x1ff;
        parts.as_vec3() * (exponent as f32).exp2()
    }
}

fn to_small_float<const MANTISSA: u32>(x: f32) -> u32 {
    let bits = x.max(0.0).to_bits();
    let exponent = (bits >> 23) as i32 - 127;
    match exponent {
        ..=-15 => 0,
        16.. => (30 << MANTISSA) | ((1 << MANTISSA) - 1),
        e => (((e + 15) as u32) << MANTISSA) | ((bits & 0x7f_ffff) >> (23 - MANTISSA)),
    }
}

fn from_small_float<const MANTISSA: u32>(bits: u32) -> f32 {
    let exponent = bits >> MANTISSA;
    let mantissa = bits & ((1 << MANTISSA) - 1);
    if exponent == 0 { 0.0 } else { f32::from_bits(((exponent + 112) << 23) | (mantissa << (23 - MANTISSA))) }
}

fn pack_oct(n: Vec3) -> u32 {
    let n = n / n.abs().element_sum();
    let wrap = |v: Vec2| (1.0 - v.yx().abs()) * vec2(1.0f32.copysign(v.x), 1f32.copysign(v.y));
    let p = if n.z >= 0.0 { n.xy() } else { wrap(n.xy()) };
    let [x, y] = (p.clamp(Vec2::NEG_ONE, Vec2::ONE) * 32767.0).round().as_ivec2().to_array();
    (x as u32 & 0xffff) | (y as u32) << 16
}

fn unpack_oct(bits: u32) -> Vec3 {
    let x = ((bits as i32) << 16 >> 16) as f32 / 32767.0;
    let y = (bits as i32 >> 16) as f32 / 32767.0;
    let mut v = vec3(x, y, 1.0 - x.abs() - y.abs());
    let t = (-v.z).max(0.0);
    v.x += if v.x >= 0.0 { -t } else { t };
    v.y += if v.y >= 0.0 { -t } else { t };
    v.normalize()
}

pub fn packed_formats(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel).xyz();
    let back = match Format::from_code((taps + pixel.x) as u32) {
        Some(Format::Rgb9e5) => {
            let packed: Rgb9e5 = c.into();
            Vec3::from(packed)
        }
        Some(Format::R11g11b10) => {
            let bits = to_small_float::<6>(c.x) | to_small_float::<6>(c.y) << 11 | to_small_float::<5>(c.z) << 22;
            vec3(from_small_float::<6>(bits & 0x7ff), from_small_float::<6>(bits >> 11 & 0x7ff), from_small_float::<5>(bits >> 22))
        }
        Some(Format::Oct16) => unpack_oct(pack_oct(c * 2.0 - 1.0)) * 0.5 + 0.5,
        None => Vec3::ZERO,
    };
    back.extend(1.0)
}

//// Tone curves chosen by type: `C::Space::FROM_SRGB`, own indices
use std::ops::{Index, IndexMut};

trait Curve {
    const WHITE: f32;
    type Space: ColorSpace;
    fn apply(x: f32) -> f32;
    fn normalized(x: f32) -> f32 {
        Self::apply(x) / Self::apply(Self::WHITE)
    }
}

trait ColorSpace {
    const FROM_SRGB: Mat3;
    const TO_SRGB: Mat3;
}

struct Srgb;
struct AcesCg;

impl ColorSpace for Srgb {
    const FROM_SRGB: Mat3 = Mat3::IDENTITY;
    const TO_SRGB: Mat3 = Mat3::IDENTITY;
}

impl ColorSpace for AcesCg {
    const FROM_SRGB: Mat3 = Mat3::from_cols_array(&[0.613, 0.070, 0.021, 0.340, 0.916, 0.110, 0.047, 0.013, 0.870]);
    const TO_SRGB: Mat3 = Mat3::from_cols_array_2d(&[[1.705, -0.130, -0.024], [-0.622, 1.141, -0.129], [-0.083, -0.010, 1.153]]);
}

struct Hable;
struct Aces;
struct Reinhard;

impl Curve for Hable {
    const WHITE: f32 = 11.2;
    type Space = Srgb;
    fn apply(x: f32) -> f32 {
        const A: f32 = 0.15;
        const B: f32 = 0.50;
        const C: f32 = 0.10;
        const D: f32 = 0.20;
        const E: f32 = 0.02;
        const F: f32 = 0.30;
        ((x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F)) - E / F
    }
}

impl Curve for Aces {
    const WHITE: f32 = 8.0;
    type Space = AcesCg;
    fn apply(x: f32) -> f32 {
        (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)
    }
}

impl Curve for Reinhard {
    const WHITE: f32 = 4.0;
    type Space = Srgb;
    fn apply(x: f32) -> f32 {
        x * (1.0 + x / (Self::WHITE * Self::WHITE)) / (1.0 + x)
    }
}

fn tonemap<C: Curve>(color: Vec3) -> Vec3 {
    <C::Space as ColorSpace>::TO_SRGB * (C::Space::FROM_SRGB * color).map(C::normalized)
}

struct Histogram([f32; 16]);

impl Index<usize> for Histogram {
    type Output = f32;
    fn index(&self, i: usize) -> &f32 {
        &self.0[i]
    }
}

impl IndexMut<usize> for Histogram {
    fn index_mut(&mut self, i: usize) -> &mut f32 {
        &mut self.0[i]
    }
}

fn ev100(histogram: &Histogram, low: f32, high: f32) -> f32 {
    let total: f32 = histogram.0.iter().sum();
    let (mut below, mut sum, mut weight) = (0.0, 0.0, 0.0);
    for (bin, &count) in histogram.0.iter().enumerate() {
        let from = (below / total).max(low);
        below += count;
        let to = (below / total).min(high);
        let part = (to - from).max(0.0);
        sum += part * (bin as f32 - 8.0);
        weight += part;
    }
    sum / weight.max(f32::MIN_POSITIVE)
}

pub fn tone_curves(color: &Frame<Vec4>, weights: &Buffer<f32>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut histogram = Histogram([0.0; 16]);
    for i in 0..16 {
        histogram[(i + 3) / 2 % 16] += weights.load(i);
    }
    let exposure = 1.0 / (1.2 * ev100(&histogram, 0.1, 0.9).exp2());
    let hdr = color.load(pixel).xyz() * exposure;
    let mapped = match taps + pixel.x % 3 {
        0 => tonemap::<Hable>(hdr),
        1 => tonemap::<Aces>(hdr),
        _ => tonemap::<Reinhard>(hdr),
    };
    let srgb = mapped.map(|c| if c <= 0.0031308 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 });
    srgb.clamp(Vec3::ZERO, Vec3::ONE).extend(1.0)
}

//// Structures with methods
struct Ray {
    from: Vec3,
    direction: Vec3,
}

impl Ray {
    const STEP: f32 = 0.25;

    fn new(from: Vec3, to: Vec3) -> Self {
        Ray { from, direction: (to - from).normalize() }
    }

    fn at(&self, t: f32) -> Vec3 {
        self.from + self.direction * t
    }
}

pub fn methods(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let ray = Ray::new(Vec3::ZERO, color.load(pixel).truncate() + 0.5);
    ray.at(4.0 * Ray::STEP).extend(1.0)
}

//// Structures with some fields of another
#[derive(Clone, Copy)]
struct Light {
    power: f32,
    tint: Vec3,
}

pub fn structure_update(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    let white = Light { power: 1.0, tint: Vec3::ONE };
    let light = Light { power: strength, ..white };
    (color.load(pixel).truncate() * light.tint * light.power).extend(1.0)
}

//// Enums without data
#[derive(Clone, Copy, PartialEq)]
enum Channel {
    Red,
    Green,
}

fn pick(v: Vec4, channel: Channel) -> f32 {
    match channel {
        Channel::Red => v.x,
        Channel::Green => v.y,
    }
}

pub fn enums(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let channel = if here.x > here.y { Channel::Red } else { Channel::Green };
    Vec4::splat(pick(here, channel))
}

//// Enums with data
#[derive(Clone, Copy)]
enum Shape {
    Ball(f32),
    Block { size: Vec2 },
}

impl Shape {
    fn distance(self, at: Vec2) -> f32 {
        match self {
            Shape::Ball(radius) => at.length() - radius,
            Shape::Block { size } => (at.abs() - size).max_element(),
        }
    }
}

pub fn enums_with_data(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let shape = if here.x > 0.5 { Shape::Ball(here.y) } else { Shape::Block { size: here.zw() } };
    Vec4::splat(shape.distance(pixel.as_vec2() * 0.25))
}

//// `Option` of a runtime value
fn hit(color: &Frame<Vec4>, from: IVec2) -> Option<i32> {
    for k in 0..6 {
        if color.load(from + ivec2(k, 0)).x > 0.5 {
            return Some(k);
        }
    }
    None
}

pub fn options_of_values(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let far = hit(color, pixel).map_or(1.0, |k| k as f32 / 6.0);
    match hit(color, pixel + ivec2(0, 1)) {
        Some(k) => Vec4::splat(k as f32 * far),
        None => Vec4::splat(far),
    }
}

//// `?` in functions that give an `Option`
fn root(x: f32) -> Option<f32> {
    if x < 0.25 { None } else { Some(x.sqrt()) }
}

fn sum_of_roots(v: Vec4) -> Option<f32> {
    Some(root(v.x)? + root(v.y)?)
}

pub fn question_marks(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(sum_of_roots(color.load(pixel)).unwrap_or(-1.0))
}

//// Traits and `impl Trait for`
trait Surface {
    const SHARPNESS: f32;

    fn distance(&self, at: Vec2) -> f32;

    fn shade(&self, at: Vec2) -> f32 {
        (1.0 - self.distance(at) * Self::SHARPNESS).clamp(0.0, 1.0)
    }
}

struct Disc(f32);

impl Surface for Disc {
    const SHARPNESS: f32 = 0.5;

    fn distance(&self, at: Vec2) -> f32 {
        at.length() - self.0
    }
}

fn lit<S: Surface>(surface: &S, at: Vec2) -> f32 {
    surface.shade(at) + surface.distance(at)
}

pub fn traits(strength: f32, pixel: IVec2) -> Vec4 {
    Vec4::splat(lit(&Disc(strength), pixel.as_vec2()))
}

//// Traits for numbers and vectors
trait Luma {
    fn luma(self) -> f32;
}

impl Luma for Vec4 {
    fn luma(self) -> f32 {
        self.truncate().dot(vec3(0.2126, 0.7152, 0.0722))
    }
}

pub fn extension_traits(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(color.load(pixel).luma())
}

//// Operators of the kernel's own types
#[derive(Clone, Copy)]
struct Complex {
    re: f32,
    im: f32,
}

impl std::ops::Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Complex { re: self.re + other.re, im: self.im + other.im }
    }
}

impl std::ops::Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Complex { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl std::ops::Mul<f32> for Complex {
    type Output = Self;
    fn mul(self, by: f32) -> Self {
        Complex { re: self.re * by, im: self.im * by }
    }
}

pub fn operators(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let z = Complex { re: here.x, im: here.y };
    let w = z * z + z * 0.5;
    vec4(w.re, w.im, 0.0, 1.0)
}

//// Generic functions
fn mean<T: std::ops::Add<Output = T> + std::ops::Mul<f32, Output = T>>(a: T, b: T) -> T {
    (a + b) * 0.5
}

pub fn generic_functions(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    mean(here, here.zyxw()) * mean(here.x, here.y)
}

//// Generic structures
#[derive(Clone, Copy)]
struct Pair<T> {
    first: T,
    second: T,
}

pub fn generic_structures(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let pair = Pair { first: here, second: here.zyxw() };
    let small = Pair { first: 1.0f32, second: 2.0 };
    pair.first * small.second + pair.second * small.first
}

//// Generics over constants
fn sum_of<const N: usize>(values: [f32; N]) -> f32 {
    let mut sum = 0.0;
    for k in 0..N {
        sum += values[k];
    }
    sum
}

pub fn constant_generics(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(sum_of(color.load(pixel).to_array()) + sum_of([1.0, 2.0]))
}

//// `const fn`, constants of it, and tables
const fn square(x: i32) -> i32 {
    x * x
}

const SIDE: i32 = square(2);
const WEIGHTS: [f32; 3] = [0.25, 0.5, 0.25];

pub fn constant_functions(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for (k, weight) in WEIGHTS.iter().enumerate() {
        sum += color.load(pixel + ivec2(k as i32 * SIDE, 0)) * *weight;
    }
    sum
}

//// `static` that does not change
static GAIN: f32 = 0.75;

pub fn statics(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * GAIN
}

//// Other names for types
type Rgb = Vec3;

fn grey(color: Rgb) -> Rgb {
    Rgb::splat(color.dot(Rgb::ONE) / 3.0)
}

pub fn aliases(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    grey(color.load(pixel).truncate()).extend(1.0)
}

//// Functions, constants and structures in functions
pub fn items_in_functions(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    const GAIN: f32 = 0.5;
    struct Gained(Vec4);
    fn gained(v: Vec4) -> Gained {
        Gained(v * GAIN)
    }
    gained(color.load(pixel)).0
}

//// Modules
mod curves {
    pub fn ease(x: f32) -> f32 {
        x * x * (3.0 - 2.0 * x)
    }
}

pub fn modules(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(curves::ease(color.load(pixel).x))
}

//// `From` and `into`
struct Polar {
    radius: f32,
    angle: f32,
}

impl From<Vec2> for Polar {
    fn from(v: Vec2) -> Self {
        Polar { radius: v.length(), angle: v.y.atan2(v.x) }
    }
}

pub fn conversions_of_ones_own(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let polar: Polar = color.load(pixel).xy().into();
    vec4(polar.radius, polar.angle, 0.0, 1.0)
}

//// `Default`, derived
#[derive(Clone, Copy, Default)]
struct Sum {
    color: Vec3,
    weight: f32,
}

pub fn defaults(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Sum::default();
    sum.color += color.load(pixel).truncate();
    sum.weight += 1.0;
    (sum.color / sum.weight).extend(1.0)
}

//// `#[cfg]` and `assert!`
pub fn configured_items(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    const TAPS: usize = 3;
    assert!(TAPS % 2 == 1, "taps have a middle one");
    #[cfg(not(any()))]
    let gain = 1.0 / TAPS as f32;
    color.load(pixel) * gain
}

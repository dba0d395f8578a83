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

//// `&dyn Trait` by a runtime condition
trait S { fn f(&self, x: f32) -> f32; }
struct A(f32);
struct B;
impl S for A { fn f(&self, x: f32) -> f32 { x * self.0 } }
impl S for B { fn f(&self, x: f32) -> f32 { x + 1.0 } }
pub fn objects(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let s: &dyn S = if c.x > 0.5 { &A(2.0) } else { &B };
    c * s.f(c.y)
}

//// `&dyn Trait` in arrays, structures, tuples and loops
trait Shape { 
    fn distance(&self, p: Vec2) -> f32; 
    fn shade(&self, p: Vec2) -> Vec3 { Vec3::splat(self.distance(p)) }
}
struct Circle { at: Vec2, r: f32 }
struct Rect { at: Vec2, half: Vec2 }
#[derive(Clone, Copy)]
enum Kind { Line(f32), Point }
impl Shape for Circle { fn distance(&self, p: Vec2) -> f32 { p.distance(self.at) - self.r } }
impl Shape for Rect {
    fn distance(&self, p: Vec2) -> f32 { let d = (p - self.at).abs() - self.half; d.max(Vec2::ZERO).length() + d.max_element().min(0.0) }
    fn shade(&self, p: Vec2) -> Vec3 { vec3(p.x, 1.0, self.half.y) }
}
impl Shape for Kind {
    fn distance(&self, p: Vec2) -> f32 { match self { Kind::Line(y) => p.y - y, Kind::Point => p.length() } }
}
struct Scene<'a> { near: &'a dyn Shape, far: &'a dyn Shape, gain: f32 }
fn pick<'a>(k: i32, a: &'a dyn Shape, b: &'a dyn Shape) -> &'a dyn Shape { if k > 2 { a } else { b } }
fn measured(s: &dyn Shape, p: Vec2) -> f32 { s.distance(p) * 0.5 }
fn generic<T: Shape + ?Sized>(s: &T, p: Vec2) -> f32 { s.distance(p) + 1.0 }
pub fn objects_everywhere(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let p = pixel.as_vec2() * 0.25;
    let circle = Circle { at: c.xy(), r: c.z };
    let rect = Rect { at: c.zw(), half: vec2(0.5, c.x) };
    let kind = if c.w > 0.5 { Kind::Line(c.x) } else { Kind::Point };
    let all: [&dyn Shape; 3] = [&circle, &rect, &kind];
    let mut least = 1.0e9;
    let mut best: &dyn Shape = &circle;
    for shape in all {
        let d = shape.distance(p);
        if d < least { least = d; best = shape; }
    }
    let one = all[(pixel.x % 3) as usize];
    let scene = Scene { near: best, far: pick(pixel.y, &rect, one), gain: 0.5 };
    let mut sum = Vec3::ZERO;
    let mut last: &dyn Shape = &rect;
    for k in 0..taps {
        sum += last.shade(p + k as f32);
        if sum.x > 1.0 { last = &circle; } else if k == 2 { last = scene.near; }
    }
    let m: &dyn Shape = match pixel.x & 3 { 0 => &circle, 1 => &Rect { at: p, half: p }, 2 => scene.far, _ => &Kind::Point };
    let (q, w): (&dyn Shape, f32) = if c.y > 0.3 { (&circle, 1.0) } else { (m, 2.0) };
    vec4(measured(m, p) + generic(m, p), scene.near.distance(p) + scene.far.distance(p) * scene.gain, sum.x + last.distance(p), sum.y + q.shade(p).z * w)
}

//// Structures with constant parameters
struct Box1<const R: usize> { w: f32 }
impl<const R: usize> Box1<R> {
    fn new(w: f32) -> Self { Self { w } }
    fn run(&self, color: &Frame<Vec4>, p: IVec2) -> Vec4 {
        let mut s = Vec4::ZERO;
        for k in 0..R { s += color.load(p + ivec2(k as i32, 0)) * self.w; }
        s
    }
    fn wider<const N: usize>(&self, p: f32) -> f32 { let mut x = p; for _ in 0..N * R { x *= 0.5; } x }
}
fn used<const R: usize>(b: &Box1<R>) -> f32 { R as f32 * b.w }
fn zeros<const N: usize>() -> [f32; N] { [0.0; N] }
pub fn constants_of_types(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a: Box1<3> = Box1 { w: 0.5 };
    let b = Box1::<5> { w: 0.25 };
    let c: Box1<2> = Box1::new(0.125);
    let z: [f32; 4] = zeros();
    a.run(color, pixel) + b.run(color, pixel) + c.run(color, pixel) * b.wider::<2>(1.0) + used(&a) + used(&b) + z.len() as f32
}

//// Constant parameters that arrays and other types tell
#[derive(Clone, Copy, PartialEq)]
struct Grid<const W: usize, const H: usize> { v: [[f32; W]; H] }
impl<const W: usize, const H: usize> Grid<W, H> {
    fn sum(&self) -> f32 { let mut s = 0.0; for y in 0..H { for x in 0..W { s += self.v[y][x]; } } s }
    fn flipped(self) -> Grid<H, W> { let mut g = Grid { v: [[0.0; H]; W] }; for y in 0..H { for x in 0..W { g.v[x][y] = self.v[y][x]; } } g }
    fn width(&self) -> usize { W }
}
struct Fir<const N: usize, const MIRROR: bool>([f32; N]);
impl<const N: usize, const MIRROR: bool> Fir<N, MIRROR> {
    fn tap(&self, k: usize) -> f32 { if MIRROR { self.0[N - 1 - k] } else { self.0[k] } }
}
trait Filter { fn go(&self, color: &Frame<Vec4>, p: IVec2) -> f32; }
impl<const N: usize, const M: bool> Filter for Fir<N, M> {
    fn go(&self, color: &Frame<Vec4>, p: IVec2) -> f32 { let mut s = 0.0; for k in 0..N { s += self.tap(k) * color.load(p + ivec2(k as i32, 0)).x; } s }
}
fn apply<F: Filter>(f: &F, color: &Frame<Vec4>, p: IVec2) -> f32 { f.go(color, p) }
pub fn constants_told(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut g = Grid { v: [[c.x, c.y, c.z], [c.w, 1.0, 2.0]] };
    for k in 0..taps { g.v[(k & 1) as usize][(k & 1) as usize + 1] += c.x; }
    let f = g.flipped();
    let same = if f.flipped() == g { 1.0 } else { 0.0 };
    let a = Fir::<3, true>([0.1, 0.2, 0.7]);
    let b: Fir<2, false> = Fir([0.3, 0.4]);
    vec4(g.sum() + f.sum(), f.width() as f32 + same, apply(&a, color, pixel), b.go(color, pixel) + a.tap(0))
}

//// Generic arguments of methods and of types before functions
struct Win<const N: usize> { w: [f32; N] }
impl<const N: usize> Win<N> {
    const LEN: usize = 3;
    fn flat() -> Self { Win { w: [1.0 / N as f32; N] } }
    fn radius() -> i32 { N as i32 / 2 }
    fn three(&self) -> usize { Self::LEN }
    fn at<const K: usize>(x: f32) -> f32 { x * K as f32 + N as f32 }
    fn sum(&self) -> f32 { self.w.iter().sum() }
}
struct Pair<T, const N: usize> { v: [T; N] }
impl<T: Copy, const N: usize> Pair<T, N> {
    fn splat(x: T) -> Self { Pair { v: [x; N] } }
    fn first(&self) -> T { self.v[0] }
}
trait Twice { fn twice(self) -> Self; }
impl Twice for f32 { fn twice(self) -> f32 { self * 2.0 } }
impl Twice for Vec2 { fn twice(self) -> Vec2 { self + self } }
struct Conv { k: f32 }
impl Conv {
    fn to<T: Twice>(&self, x: T) -> T { x.twice() }
    fn many<const A: usize, const B: usize>(&mut self, x: f32) -> f32 { self.k += 1.0; x * A as f32 + B as f32 * self.k }
}
pub fn arguments_of_types(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let a = Win::<5>::flat();
    let r = Win::<7>::radius();
    let k = Win::<2>::at::<3>(c.x);
    let p = Pair::<Vec2, 3>::splat(c.xy());
    let q: Pair<f32, 2> = Pair::splat(c.z);
    let mut v = Conv { k: 0.5 };
    let m = v.many::<2, 3>(c.w);
    vec4(a.sum() + r as f32, k + a.three() as f32, p.first().x + q.first() + p.v.len() as f32, v.to::<f32>(c.x) + v.to::<Vec2>(c.xy()).y + m)
}

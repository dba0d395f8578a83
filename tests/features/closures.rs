//// Closures that read and write what is around them
pub fn closures(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    let mut add = |x, y| sum += color.load(pixel + ivec2(x, y));
    add(0, 0);
    add(1, 0);
    sum
}

//// Closures as parameters: `impl Fn`, `&dyn Fn`, `F: FnMut`
fn once(f: impl Fn(f32) -> f32, x: f32) -> f32 {
    f(x)
}

fn twice<F: FnMut(f32)>(mut f: F, x: f32) {
    f(x);
    f(x);
}

pub fn closures_as_parameters(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut sum = 0.0;
    twice(|x| sum += x, here.x);
    Vec4::splat(once(|x| x * x, sum))
}

//// Closures that functions return
fn scaled(by: f32) -> impl Fn(f32) -> f32 {
    move |x| x * by
}

pub fn closures_returned(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    Vec4::splat(scaled(strength)(color.load(pixel).x))
}

//// Functions as values
fn blend(curve: fn(f32) -> f32, x: f32) -> f32 {
    curve(x)
}

pub fn functions_as_values(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let curve = if pixel.x < 0 { f32::sqrt } else { f32::abs };
    Vec4::splat(blend(f32::floor, here.x * 4.0) + blend(curve, here.y))
}

//// `map`, `zip`, `sum`, `fold` of iterators
pub fn iterators(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let weights = [0.25, 0.5, 0.25];
    let taps = (-1..=1).map(|k| color.load(pixel + ivec2(k, 0)));
    taps.zip(weights).map(|(tap, weight)| tap * weight).sum()
}

//// `filter` of iterators
pub fn filtered(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps = (0..6).map(|k| color.load(pixel + ivec2(k, 0)).x);
    Vec4::splat(taps.filter(|x| *x > 0.5).sum())
}

//// `filter_map`, `take_while`, `skip_while`, and `count`, `fold`, `any` behind them
pub fn filtered_otherwise(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps = [0, 1, 2, 3, 4].map(|k| color.load(pixel + ivec2(k, 0)));
    let bright: Vec4 = taps
        .iter()
        .filter_map(|tap| if tap.x > 0.4 { Some(*tap * tap.y) } else { None })
        .map(|tap| tap + 0.25)
        .sum();
    let before = taps.iter().take_while(|tap| tap.z < 0.8).count();
    let behind = taps.iter().skip_while(|tap| tap.z < 0.5).filter(|tap| tap.w > 0.2);
    let mixed = behind.fold(0.5, |sum, tap| sum * 0.5 + tap.y);
    let any = taps.iter().filter(|tap| tap.x < 0.5).any(|tap| tap.y > 0.7);
    bright + vec4(before as f32, mixed, f32::from(any), 0.0)
}

//// `min`, `max` and `reduce` of iterators
pub fn extremes(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps = [0, 1, 2, 3].map(|k| color.load(pixel + ivec2(k, 0)));
    let levels = taps.map(|tap| (tap.x * 16.0) as i32);
    let least = levels.iter().min().unwrap_or(&0);
    let largest = levels.into_iter().max().unwrap_or(0);
    let widest = taps.iter().map(|tap| tap.length()).reduce(f32::max).unwrap_or(0.0);
    vec4(*least as f32, largest as f32, widest, 1.0)
}

//// `any`, `all` and `position` of iterators
pub fn searched_iterators(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps = [0, 1, 2, 3].map(|k| color.load(pixel + ivec2(k, 0)).x);
    let any = taps.iter().any(|x| *x > 0.9);
    let at = taps.iter().position(|x| *x > 0.5).unwrap_or(4);
    vec4(f32::from(any), at as f32, 0.0, 1.0)
}

//// `map` of arrays and vectors
pub fn mapped(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let reds = [-1, 0, 1].map(|k| color.load(pixel + ivec2(k, 0)).x);
    vec4(reds[0], reds[1], reds[2], 1.0).map(f32::sqrt)
}

//// `array::from_fn`
pub fn arrays_from_functions(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps: [f32; 4] = std::array::from_fn(|k| color.load(pixel + ivec2(k as i32, 0)).x);
    Vec4::from_array(taps)
}

//// `flat_map` and `flatten` of iterators
pub fn flattened(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut s = Vec4::ZERO;
    for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) { s += color.load(pixel + ivec2(i, j)) * 0.1; }
    let rows = [[1.0, 2.0], [3.0, 4.0]];
    let t: f32 = rows.iter().flatten().sum();
    let u: f32 = rows.iter().flat_map(|r| r.iter().map(|x| x * 2.0)).sum();
    let n = (0..3).flat_map(|y| (0..y).map(move |x| x * y)).filter(|v| v % 2 == 0).count();
    s + vec4(t, u, n as f32, 0.0)
}

//// Iterators over ranges with runtime bounds: `filter`, `map`, `enumerate`, and what consumes them
pub fn lazy_iterators(color: &Frame<Vec4>, weights: &Buffer<f32>, taps: i32, pixel: IVec2) -> Vec4 {
    let n = weights.len().min((taps + (pixel.x & 3)).max(0) as usize);
    let mut odd = Vec2::ZERO;
    for k in (0..n).filter(|k| k % 2 == 1) {
        if odd.y > 3.0 {
            break;
        }
        odd += vec2(weights.load(k), 1.0);
    }
    for (k, x) in (0..n).map(|k| weights.load(k)).enumerate() {
        if x < 0.25 {
            continue;
        }
        odd.x += x * k as f32;
    }
    let sum: f32 = (0..n).map(|k| weights.load(k) * 2.0).sum();
    let colors: Vec4 = (-taps..=taps).map(|k| color.load(pixel + ivec2(k, 0))).sum();
    let best = (0..n).map(|k| weights.load(k)).fold(f32::NEG_INFINITY, f32::max);
    let count = (0..n).filter(|&k| weights.load(k) > 0.5).count();
    let first = (0..n).find(|&k| weights.load(k) > 0.7).unwrap_or(99);
    let any = (0..taps).rev().any(|k| color.load(pixel - ivec2(0, k)).y > 0.9);
    let bright = (0..n).filter_map(|k| if weights.load(k) > 0.3 { Some(weights.load(k) * 3.0) } else { None });
    let total = bright.fold(0.0, |sum, x| sum + x);
    vec4(odd.x + sum, best.max(-1.0) + total, (count.min(99) + 10 * first.min(99)) as f32, colors.x + if any { 1.0 } else { 0.0 })
}

//// `for` over an array that is filtered
pub fn filtered_loop(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps = [ivec2(0, 1), ivec2(1, 0), ivec2(2, 2)].map(|at| color.load(pixel + at));
    let mut sum = Vec4::ZERO;
    for tap in taps.iter().filter(|tap| tap.x > 0.4) {
        if tap.y > 0.8 {
            continue;
        }
        sum += *tap;
    }
    for k in (0..6).filter(|k| k % 3 == 0) {
        sum.w += k as f32;
    }
    sum
}

//// Constructors, variants and operators as values: `.map(Wrap)`, `.map(Shape::Disc)`, `.fold(0.0, f32::add)`
use std::ops::{Add, Mul};
#[derive(Clone, Copy)]
struct Wrap(f32);
#[derive(Clone, Copy)]
struct Pair(f32, f32);
#[derive(Clone, Copy)]
enum Shape {
    Disc(f32),
    Slab(f32, f32),
    Empty,
}

impl Wrap {
    fn doubled(self) -> f32 {
        self.0 * 2.0
    }

    fn all(v: [f32; 2]) -> [Wrap; 2] {
        v.map(Self)
    }
}

impl Shape {
    fn area(&self) -> f32 {
        match self {
            Shape::Disc(r) => r * r,
            Shape::Slab(a, b) => a * b,
            Shape::Empty => 0.0,
        }
    }
}

impl Add for Wrap {
    type Output = Wrap;
    fn add(self, other: Wrap) -> Wrap {
        Wrap(self.0 + other.0 * 0.5)
    }
}

fn square<T: Mul<Output = T> + Copy>(x: T) -> T {
    x * x
}

const CURVES: [fn(f32) -> f32; 2] = [f32::abs, square];
pub fn constructors_as_values(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let parts = here.to_array();
    let wrapped: f32 = parts.into_iter().map(Wrap).map(Wrap::doubled).sum();
    let (make, pair) = (Wrap, Pair);
    let shapes = [here.y, here.z].map(Shape::Disc);
    let slab = Shape::Slab;
    let areas =
        shapes.iter().map(Shape::area).sum::<f32>() + slab(here.x, 2.0).area() + make(here.w).0 + pair(1.0, here.x).1;
    let rows: Vec3 = [(1.0, 0.0, 0.5), (0.0, here.y, 0.25)].into_iter().map(Vec3::from).sum();
    let splats = [0.25, here.x].map(Vec4::splat)[1] + [[here.x, 2.0]].map(Vec2::from_array)[0].y;
    let bytes: f32 = [1u8, 2, 3].iter().copied().map(f32::from).sum();
    let sums = parts.into_iter().fold(0.0, f32::add) + parts.into_iter().reduce(Mul::mul).unwrap_or(1.0);
    let wraps = parts.map(Wrap).into_iter().reduce(Add::add).map_or(0.0, Wrap::doubled) + Wrap::all([here.x, 1.0])[1].0;
    let most = parts.into_iter().reduce(f32::max).unwrap_or_default() + CURVES[(pixel.x & 1) as usize](here.y - 0.5);
    let some = [here.z].map(Some)[0].map_or(Vec2::ZERO, Vec2::splat).x + [ivec2(pixel.x, 2)].map(IVec2::as_vec2)[0].y;
    vec4(wrapped + areas, rows.y + bytes, sums + wraps, most + some) + splats
}

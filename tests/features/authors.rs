//// Traits for arrays and tuples: `impl Stats for [f32; 3]`, `impl<T, const N: usize> Turn for [[T; N]; N]`
trait Stats {
    const SCALE: f32;
    type Out;

    fn total(&self) -> f32;
    fn twice(self) -> Self::Out;
    fn halve(&mut self);

    fn doubled(&self) -> f32 {
        self.total() * 2.0 * Self::SCALE
    }
}

impl Stats for [f32; 3] {
    const SCALE: f32 = 0.5;
    type Out = [f32; 3];

    fn total(&self) -> f32 {
        self.iter().sum()
    }

    fn twice(self) -> [f32; 3] {
        self.map(|x| x * 2.0)
    }

    fn halve(&mut self) {
        for x in self.iter_mut() {
            *x *= 0.5;
        }
    }
}

impl Stats for (f32, Vec2) {
    const SCALE: f32 = 3.0;
    type Out = f32;

    fn total(&self) -> f32 {
        self.0 + self.1.x
    }

    fn twice(self) -> f32 {
        self.0 * 2.0
    }

    fn halve(&mut self) {
        self.0 *= 0.5;
    }
}

trait Turn {
    fn turned(&self) -> Self;
    fn size() -> usize;
}

impl<T: Copy, const N: usize> Turn for [[T; N]; N] {
    fn turned(&self) -> Self {
        std::array::from_fn(|y| std::array::from_fn(|x| self[x][y]))
    }

    fn size() -> usize {
        N
    }
}

fn scaled<S: Stats>(values: &S) -> f32 {
    values.total() * S::SCALE + values.doubled()
}

fn sizes<T: Turn>(_: &T) -> f32 {
    T::size() as f32
}

pub fn traits_for_arrays(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut row = [here.x, here.y, here.z];
    row.halve();
    let mut pair = (here.w, here.yz());
    pair.halve();
    let turned = [[here.x, here.y], [here.z, here.w]].turned();
    let totals = Stats::total(&pair) + <[f32; 3]>::SCALE + <(f32, Vec2) as Stats>::SCALE;
    vec4(scaled(&row), scaled(&pair) + pair.twice(), turned[0][1] * 2.0 + turned[1][0] + sizes(&turned), totals + row.twice().total())
}

//// Implementations for arrays of unlike elements and lengths, and for tuples of unlike parts
trait Dims {
    fn dims(&self) -> f32;
}

impl Dims for [i32; 2] {
    fn dims(&self) -> f32 {
        2.5
    }
}

impl Dims for [i32; 3] {
    fn dims(&self) -> f32 {
        self[2] as f32
    }
}

impl Dims for [Vec2; 2] {
    fn dims(&self) -> f32 {
        self[1].y
    }
}

impl Dims for (f32, f32) {
    fn dims(&self) -> f32 {
        self.0 * self.1
    }
}

impl Dims for (f32, u32) {
    fn dims(&self) -> f32 {
        self.0 + self.1 as f32
    }
}

fn of(values: impl Dims) -> f32 {
    values.dims()
}

pub fn traits_for_lengths(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let lists = [1, 2].dims() + [pixel.x, 5, 6].dims() + [here.xy(), here.zw()].dims();
    let passed = of([1, 2]) + of([1, pixel.y, 3]) + of([here.xy(), here.yx()]);
    vec4(lists, passed, (here.x, here.y).dims() + (here.x, 3_u32).dims(), of((here.z, 2.0)) + of((here.z, 2_u32)))
}

//// `From` for arrays and tuples
#[derive(Clone, Copy)]
struct Rgb {
    r: f32,
    g: f32,
    b: f32,
}

impl From<Rgb> for [f32; 3] {
    fn from(c: Rgb) -> Self {
        [c.r, c.g, c.b]
    }
}

impl From<Rgb> for (f32, f32) {
    fn from(c: Rgb) -> Self {
        (c.r, c.g)
    }
}

pub fn from_for_arrays(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let Vec4 { x: r, y: g, z: b, w } = color.load(pixel);
    let rgb = Rgb { r, g, b };
    let list: [f32; 3] = rgb.into();
    let (first, second) = rgb.into();
    let again = <[f32; 3]>::from(Rgb { r: 0.5, ..rgb });
    vec4(list[2] + list[0], first * second, again[0] + again[1], w)
}

//// `unreachable!()`, in a `match`, after `else`, and in a function
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    fn of(k: i32) -> Self {
        match k & 3 {
            0 => Axis::X,
            1 => Axis::Y,
            2 | 3 => Axis::Z,
            _ => unreachable!(),
        }
    }

    fn near(k: i32) -> Option<Axis> {
        if k > 1000 { None } else { Some(Self::of(k)) }
    }
}

fn component(v: Vec4, k: u32) -> f32 {
    match k % 4 {
        0 => v.x,
        1 => v.y,
        2 => v.z,
        3 => v.w,
        n => unreachable!("no component {n}"),
    }
}

fn guarded(x: f32) -> f32 {
    if x < -1000.0 {
        unreachable!()
    }
    if x > 0.5 {
        return x * 2.0;
    }
    let mut sum = 0.0;
    for k in 0..4 {
        if x > k as f32 * 0.1 {
            sum += 1.0;
            continue;
        }
        if x < -50.0 {
            unreachable!();
        }
        sum += x;
    }
    if x > 0.25 {
        if x > 0.2 {
            return sum;
        }
        unreachable!("x is {}", x);
    }
    sum - 1.0
}

fn early(x: f32) -> i32 {
    let k = if x > 0.5 {
        if x > 0.0 {
            return 5;
        }
        unreachable!()
    } else {
        3
    };
    k + 1
}

fn walked(v: Vec4, taps: i32) -> f32 {
    let mut sum = 0.0;
    let mut k = 0;
    loop {
        match k % 3 {
            0 => sum += v.x,
            1 => sum += v.y,
            2 => {
                sum += v.z;
                if sum > 2.0 {
                    break sum;
                }
            }
            _ => unreachable!(),
        }
        k += 1;
        if k > taps + 6 {
            return sum * 0.5;
        }
    }
}

pub fn unreached(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let Some(axis) = Axis::near(pixel.x) else { unreachable!() };
    let along = match axis {
        Axis::X => here.x,
        Axis::Y => here.y,
        Axis::Z => here.z,
    };
    let row = |k: i32| match k {
        ..3 => 1.0,
        3..=1000 => 2.0,
        _ => unreachable!(),
    };
    let walk = walked(here, taps);
    vec4(along + row(pixel.y), component(here, pixel.y as u32), guarded(here.x) + guarded(here.y), early(here.z) as f32 + walk)
}

//// Ranges without an end: `(-1..).zip(taps)`, `(1..).step_by(2).take(3)`, `(2..).contains(&x)`
pub fn open_ranges(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let shares = [1.0, 2.0, 3.0, 4.0_f32];
    let mut sum = Vec4::ZERO;
    for (x, share) in (-1..).zip(shares) {
        sum += color.load(pixel + ivec2(x, 0)) * share;
    }
    for (share, k) in shares.iter().zip(1_u32..) {
        sum *= 1.0 + *share / k as f32;
    }
    let odd: i32 = (1..).step_by(2).take(3).sum();
    let squares = (0..).skip(3).map(|k| k * k).take_while(|k| *k < 50).sum::<i32>();
    let run: f32 = (pixel.x..).zip(shares).map(|(k, share)| k as f32 * share).sum();
    sum + vec4(odd as f32, squares as f32, run, if (2..).contains(&pixel.y) { 1.0 } else { 0.0 })
}

//// `Default`, derived for types with parameters
#[derive(Clone, Copy, Default)]
struct Weighted<T> {
    sum: T,
    weight: f32,
}

#[derive(Clone, Copy, Default)]
struct Pair<A, B>(A, B);

#[derive(Clone, Copy, Default)]
struct Nested<T: Copy>
where
    T: PartialEq,
{
    best: Option<T>,
    counts: [u32; 2],
    mean: Weighted<T>,
}

pub fn derived_with_parameters(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut mean = Weighted::<Vec3>::default();
    mean.sum += color.load(pixel).xyz();
    mean.weight += 2.0;
    let pair: Pair<f32, Vec2> = Pair::default();
    let nested: Nested<f32> = Default::default();
    let rest = nested.best.unwrap_or(2.0) + nested.mean.sum + nested.counts[1] as f32;
    (mean.sum / mean.weight).extend(pair.0 + pair.1.x + rest)
}

//// Conversions of type parameters: `T: Into<Complex>`, `impl Into<Option<f32>>`
#[derive(Clone, Copy)]
struct Complex {
    re: f32,
    im: f32,
}

impl From<f32> for Complex {
    fn from(re: f32) -> Self {
        Complex { re, im: 0.0 }
    }
}

impl From<Vec2> for Complex {
    fn from(v: Vec2) -> Self {
        Complex { re: v.x, im: v.y }
    }
}

impl<T: Into<Complex>> std::ops::Add<T> for Complex {
    type Output = Complex;

    fn add(self, other: T) -> Complex {
        let other = other.into();
        Complex { re: self.re + other.re, im: self.im + other.im }
    }
}

fn norm(z: impl Into<Complex>) -> f32 {
    let z = z.into();
    z.re * z.re + z.im * z.im
}

fn turned<T>(z: T) -> Complex
where
    T: Into<Complex>,
{
    let Complex { re, im } = z.into();
    Complex { re: -im, im: re }
}

fn vignetted(x: f32, amount: impl Into<Option<f32>>) -> f32 {
    amount.into().map_or(x, |amount| x * amount)
}

fn long(v: impl Into<Vec3>) -> f32 {
    v.into().length_squared()
}

pub fn into_of_parameters(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let z = turned(here.xy()) + 0.5 + here.zw() + turned(here.x);
    let dimmed = vignetted(here.x, None) + vignetted(here.y, 0.5) + vignetted(here.z, Some(0.25));
    vec4(z.re, z.im, norm(here.x) + norm(z) + norm(here.yz()), dimmed + long([here.x, 1.0, 2.0]) + long((1.0, here.y, 0.5)) + long(here.xyz()))
}

//// `scan` of iterators
pub fn scanned(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let row = [0, 1, 2, 3].map(|k| color.load(pixel + ivec2(k, 0)).x);
    let smooth: f32 = row
        .iter()
        .scan(0.0, |state, x| {
            *state = *state * 0.5 + x;
            Some(*state)
        })
        .sum();
    let powers = (1..10).scan(1, |power, k| {
        *power *= 2;
        if k < 5 { Some(*power + k) } else { None }
    });
    let mut last = 0;
    for power in powers {
        last += power;
    }
    let most = row.iter().scan(f32::MIN, |most, x| { *most = most.max(*x); Some(*most) }).map(|x| x * 0.5).fold(0.0, |a, b| a + b);
    vec4(smooth, last as f32, most, 1.0)
}

//// Closures of `map` of arrays and of `from_fn` that change variables
#[derive(Clone, Copy, Default)]
struct Filter {
    state: f32,
}

impl Filter {
    fn tick(&mut self, x: f32) -> f32 {
        self.state = self.state * 0.5 + x;
        self.state
    }
}

pub fn maps_that_change(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let row: [f32; 4] = std::array::from_fn(|k| color.load(pixel + ivec2(k as i32, 0)).x);
    let mut filter = Filter::default();
    let smooth = row.map(|x| filter.tick(x));
    let mut seed = 1_u32;
    let noise: [f32; 3] = std::array::from_fn(|_| {
        seed = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (seed >> 8) as f32 / 16_777_216.0
    });
    vec4(smooth[0] + smooth[3], noise[0], noise[1] - noise[2], filter.state)
}

//// Functions of traits, and functions with constants, as values: `.map(Luma::luma)`, `power::<3>`
trait Luma {
    fn luma(&self) -> f32;
}

impl Luma for Vec4 {
    fn luma(&self) -> f32 {
        self.x * 0.25 + self.y * 0.75
    }
}

impl Luma for f32 {
    fn luma(&self) -> f32 {
        self * 0.5
    }
}

fn power<const N: i32>(x: f32) -> f32 {
    x.powi(N)
}

struct Tone {
    curve: fn(f32) -> f32,
}

const TONES: [Tone; 2] = [Tone { curve: power::<2> }, Tone { curve: power::<3> }];

pub fn functions_of_traits(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let taps = [here, here.zyxw()];
    let lumas: f32 = taps.iter().map(Luma::luma).sum();
    let halves = [here.x, here.y].iter().map(Luma::luma).fold(0.0, f32::max);
    let cube = power::<3>;
    let squares = [here.x, here.y].map(power::<2>);
    vec4(lumas, halves, (TONES[0].curve)(here.x) + (TONES[1].curve)(here.y), cube(here.z) + squares[1])
}

//// Other names of types with arguments: `type Polygon = List<Vec2, 4>`, `Polygon::from(..)`, `resample::<Cubic>(x)`
#[derive(Clone, Copy)]
struct List<T, const N: usize> {
    items: [T; N],
    len: usize,
}

impl<T: Copy + Default, const N: usize> List<T, N> {
    fn new() -> Self {
        Self { items: [T::default(); N], len: 0 }
    }

    fn push(&mut self, item: T) {
        if self.len < N {
            self.items[self.len] = item;
            self.len += 1;
        }
    }
}

impl<T: Copy + Default, const N: usize, const M: usize> From<[T; M]> for List<T, N> {
    fn from(items: [T; M]) -> Self {
        let mut list = Self::new();
        for item in items {
            list.push(item);
        }
        list
    }
}

type Polygon = List<Vec2, 4>;

trait Weigh {
    const REACH: f32;
    fn weigh(x: f32) -> f32;
}

struct Spline<const B: i32>;

impl<const B: i32> Weigh for Spline<B> {
    const REACH: f32 = B as f32 * 0.5;

    fn weigh(x: f32) -> f32 {
        x * B as f32 + 1.0
    }
}

type Cubic = Spline<3>;

fn resample<F: Weigh>(x: f32) -> f32 {
    F::weigh(x) * F::REACH
}

pub fn names_with_arguments(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut list = Polygon::from([here.xy(), here.zw()]);
    list.push(here.yx());
    let short = List::<f32, 2>::from([here.x, here.y, here.z]);
    let none = Polygon::new();
    vec4(list.items[2].x + list.items[1].y, (list.len + short.len * 10 + none.len) as f32, resample::<Cubic>(here.x), Cubic::weigh(here.y) + Cubic::REACH)
}

//// `use` in the value of a constant, and `Vec2::from_slice`
#[derive(Clone, Copy, PartialEq)]
enum Edge {
    Left,
    Right,
}

impl Edge {
    const ALL: [Edge; 2] = {
        use Edge::*;
        [Left, Right]
    };
}

const FIRST: Edge = {
    use Edge::Left;
    Left
};

pub fn uses_in_constants(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let row = color.load(pixel).to_array();
    let pair = Vec2::from_slice(&row[1..3]) + Vec2::from_slice(&row);
    let edge = Edge::ALL[(pixel.x & 1) as usize];
    vec4(pair.x, pair.y, if edge == FIRST { 1.0 } else { 0.0 }, row[3])
}

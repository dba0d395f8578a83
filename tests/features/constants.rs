//// Constants and functions of a trait for a type with parameters: `T::RADIUS` of `Lanczos<3>`
trait Kernel {
    const RADIUS: i32;
    const TAPS: i32 = 2 * Self::RADIUS + 1;
    fn weigh(x: i32) -> f32;
}

#[derive(Clone, Copy)]
struct Tent<const R: i32>;
#[derive(Clone, Copy)]
struct Both<A, B> {
    first: A,
    second: B,
}

struct Flat;
struct Filter<K> {
    kernel: K,
    gain: f32,
}

impl<const R: i32> Kernel for Tent<R> {
    const RADIUS: i32 = R;
    fn weigh(x: i32) -> f32 {
        (R + 1 - x.abs()) as f32 / (R + 1) as f32
    }
}

impl Kernel for Flat {
    const RADIUS: i32 = 2;
    fn weigh(_: i32) -> f32 {
        0.2
    }
}

impl<A: Kernel, B: Kernel> Kernel for Both<A, B> {
    const RADIUS: i32 = A::RADIUS + B::RADIUS;
    fn weigh(x: i32) -> f32 {
        A::weigh(x) * B::weigh(x)
    }
}

impl<const R: i32> Tent<R> {
    const SHARE: f32 = 1.0 / R as f32;
}

impl<K: Kernel> Filter<K> {
    fn row(&self, color: &Frame<Vec4>, at: IVec2) -> f32 {
        let mut sum = 0.0;
        for x in -K::RADIUS..=K::RADIUS {
            sum += color.load(at + ivec2(x, 0)).x * K::weigh(x);
        }
        sum * self.gain
    }
}

fn taps_of<K: Kernel>() -> f32 {
    K::TAPS as f32 + K::weigh(1)
}

fn radius_of<K: Kernel>(_: &K) -> f32 {
    K::RADIUS as f32
}

pub fn constants_of_parameters(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let narrow = Filter {
        kernel: Tent::<1>,
        gain: 0.5,
    };
    let wide = Filter {
        kernel: Both {
            first: Tent::<2>,
            second: Flat,
        },
        gain: 2.0,
    };
    let taps = taps_of::<Tent<3>>() + taps_of::<Flat>() * 16.0 + taps_of::<Both<Tent<1>, Tent<2>>>() * 64.0;
    vec4(
        narrow.row(color, pixel),
        wide.row(color, pixel),
        taps,
        radius_of(&wide.kernel) + Tent::<4>::SHARE,
    )
}

//// Constants of two traits, and of a trait beside those of glam
trait Zero {
    const ZERO: Self;
    const SCALE: f32 = 2.0;
    fn zero() -> Self;
}

trait Other {
    const SCALE: f32;
}

trait Nothing: Zero + Sized {
    const HALF: f32 = Self::SCALE * 0.5;
    fn nothing() -> Self {
        Self::ZERO
    }
}

struct Pair;
impl Zero for Vec3 {
    const ZERO: Self = Vec3::ONE;
    fn zero() -> Self {
        Self::ZERO + Vec3::X
    }
}

impl Zero for f32 {
    const ZERO: Self = 0.25;
    fn zero() -> Self {
        Self::ZERO
    }
}

impl Nothing for Vec3 {}
impl Nothing for f32 {}
impl Zero for Pair {
    const ZERO: Self = Pair;
    const SCALE: f32 = 3.0;
    fn zero() -> Self {
        Pair
    }
}

impl Other for Pair {
    const SCALE: f32 = 5.0;
}

fn zero_of<T: Zero>() -> T {
    T::ZERO
}

fn named<T: Zero>() -> T {
    <T as Zero>::ZERO
}

fn scale_of<T: Other>() -> f32 {
    T::SCALE
}

trait Bounded {
    const LOW: Self;
    const HIGH: Self;
}

impl Bounded for f32 {
    const LOW: f32 = -1.0;
    const HIGH: f32 = 3.0;
}

impl Bounded for Vec2 {
    const LOW: Vec2 = Vec2::NEG_ONE;
    const HIGH: Vec2 = Vec2::ONE;
}

struct Limits<T> {
    low: T,
    high: T,
}

impl<T: Bounded> Limits<T> {
    const ALL: Limits<T> = Limits {
        low: T::LOW,
        high: T::HIGH,
    };
}

pub fn constants_of_traits(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let vectors = Vec3::ZERO
        + <Vec3 as Zero>::ZERO * 2.0
        + zero_of::<Vec3>() * 4.0
        + <Vec3 as Zero>::zero() * 8.0
        + <Vec3 as Nothing>::nothing() * 16.0;
    let numbers =
        f32::ZERO + <f32 as Zero>::ZERO + zero_of::<f32>() + named::<f32>() + f32::zero() + f32::nothing() + f32::SCALE;
    let pairs =
        <Pair as Zero>::SCALE + <Pair as Other>::SCALE * 10.0 + scale_of::<Pair>() * 100.0 + <Vec3 as Nothing>::HALF;
    let limits = Limits::<f32>::ALL.high + Limits::<Vec2>::ALL.low.x;
    vec4(vectors.x, vectors.y, numbers, pairs + limits) + here
}

//// Defaults of constant and type parameters, and `Default::default()` of a type parameter
#[derive(Clone, Copy)]
struct Window<const N: usize = 3> {
    share: f32,
}

impl<const N: usize> Window<N> {
    const UNIT: f32 = 1.0 / N as f32;
    fn new(share: f32) -> Self {
        Window { share }
    }

    fn sum(&self) -> f32 {
        self.share * N as f32 + Self::UNIT
    }
}

struct Point<T = f32> {
    x: T,
    y: T,
}

impl Point {
    fn area(&self) -> f32 {
        self.x * self.y
    }
}

impl<T: Default> Default for Point<T> {
    fn default() -> Self {
        Point {
            x: T::default(),
            y: Default::default(),
        }
    }
}

fn nothing<T: Default>() -> T {
    Default::default()
}

pub fn defaults_of_parameters(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let three: Window = Window { share: here.x };
    let five: Window<5> = Window::new(here.y);
    let point: Point = Point { x: here.z, y: 2.0 };
    let made: Point<Vec2> = Point::default();
    let zero: Vec3 = nothing();
    vec4(
        three.sum(),
        five.sum() + Window::<4>::UNIT,
        point.area() + made.x.y,
        zero.x + nothing::<f32>() + here.w,
    )
}

//// Lengths that the type of the result tells, where the caller has parameters of the same names
#[derive(Clone, Copy)]
struct Tag<const N: usize>;
impl<const N: usize> Tag<N> {
    fn count(&self) -> f32 {
        N as f32
    }
}

struct Grid<const R: usize, const C: usize>([[f32; C]; R]);
impl<const R: usize, const C: usize> Grid<R, C> {
    fn turned(self) -> Grid<C, R> {
        Grid(std::array::from_fn(|c| std::array::from_fn(|r| self.0[r][c])))
    }
}

struct Taps<const N: usize> {
    weights: [f32; N],
    tag: Tag<N>,
}

impl<const N: usize> Taps<N> {
    fn new(x: f32) -> Self {
        Taps {
            weights: std::array::from_fn(|k| k as f32 + x),
            tag: Tag,
        }
    }

    fn halved<const K: usize>(&self) -> Taps<K> {
        Taps {
            weights: std::array::from_fn(|k| self.weights[k] * 0.5),
            tag: Tag,
        }
    }
}

struct Held<const N: usize> {
    tag: Tag<N>,
    pair: [f32; 2],
}

fn held<const N: usize>() -> Held<5> {
    let held: Held<5> = Held {
        tag: Tag,
        pair: [N as f32; 2],
    };
    held
}

pub fn lengths_of_results(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let grid = Grid([[here.x, here.y, 0.5], [here.z, here.w, 0.25]]).turned();
    let taps = Taps::<4>::new(here.x);
    let half: Taps<2> = taps.halved();
    let vector = Vec4::from(std::array::from_fn(|k| taps.weights[k] * here[k]));
    let stated = std::array::from_fn::<f32, 3, _>(|k| k as f32 * here.y);
    vec4(
        grid.0[2][1] + grid.0[1][0],
        held::<2>().tag.count() + held::<3>().pair[1],
        half.weights[1] + half.tag.count() + taps.tag.count() * 8.0,
        vector.z + stated[2],
    )
}

//// Functions and constants of type parameters in closures
trait Activation {
    const GAIN: f32;
    fn apply(x: f32) -> f32;
}

struct Square;
impl Activation for Square {
    const GAIN: f32 = 2.0;
    fn apply(x: f32) -> f32 {
        x * x
    }
}

struct Times<const N: i32>;
impl<const N: i32> Activation for Times<N> {
    const GAIN: f32 = N as f32;
    fn apply(x: f32) -> f32 {
        x * N as f32
    }
}

struct Layer<const N: usize> {
    bias: f32,
}

impl<const N: usize> Layer<N> {
    const SHARE: f32 = 1.0 / N as f32;
    fn scaled(x: f32) -> f32 {
        x * N as f32
    }

    fn all(&self, v: [f32; 3]) -> [f32; 3] {
        v.map(|x| Self::scaled(x) * Self::SHARE + self.bias + N as f32)
    }
}

fn sum<A: Activation>(v: [f32; 3]) -> f32 {
    v.map(|x| A::apply(x) + A::GAIN).iter().sum()
}

pub fn parameters_in_closures(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let v = [here.x, here.y, here.z];
    vec4(
        sum::<Square>(v),
        sum::<Times<3>>(v),
        Layer::<4> { bias: 0.5 }.all(v)[1],
        here.w,
    )
}

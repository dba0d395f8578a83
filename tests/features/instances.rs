//// Several `impl`s of one type, told apart by constants: `impl Matrix<2>`, `impl Matrix<3>`
#[derive(Clone, Copy)]
struct Square<const N: usize>([[f32; N]; N]);
trait Size {
    const SIZE: f32;
    const TWICE: f32 = Self::SIZE * 2.0;
    fn trace(&self) -> f32;
}

impl<const N: usize> Square<N> {
    fn flipped(self) -> Square<N> {
        Square(std::array::from_fn(|y| std::array::from_fn(|x| self.0[x][y])))
    }

    fn scaled(self, by: f32) -> f32 {
        self.trace_of(0) * by
    }

    fn trace_of(&self, k: usize) -> f32 {
        self.0[k][k]
    }
}

impl Square<2> {
    const SHARE: f32 = 0.5;
    fn det(self) -> f32 {
        let [[a, b], [c, d]] = self.0;
        a * d - b * c
    }

    fn diagonal(&self) -> Vec2 {
        vec2(self.0[0][0], self.0[1][1])
    }

    fn unit() -> Self {
        Square([[1.0, 0.25], [0.0, 1.0]])
    }
}

impl Square<3> {
    const SHARE: f32 = 0.25;
    fn det(self) -> f32 {
        let m = self.0;
        m[0][0] * m[1][1] - m[2][2] + self.scaled(0.5)
    }

    fn diagonal(&self) -> Vec3 {
        vec3(self.0[0][0], self.0[1][1], self.0[2][2])
    }

    fn unit() -> Self {
        Square([[2.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    }
}

impl Size for Square<2> {
    const SIZE: f32 = 2.0;
    fn trace(&self) -> f32 {
        self.0[0][0] + self.0[1][1]
    }
}

impl Size for Square<3> {
    const SIZE: f32 = 3.0;
    fn trace(&self) -> f32 {
        self.0[0][0] + self.0[1][1] * 2.0 + self.0[2][2]
    }
}

impl std::ops::Neg for Square<2> {
    type Output = Self;
    fn neg(self) -> Self {
        Square([[-self.0[0][0], 0.5], [0.0, -self.0[1][1]]])
    }
}

impl std::ops::Neg for Square<3> {
    type Output = Self;
    fn neg(self) -> Self {
        Square([[self.0[0][0] * -2.0, 0.0, 0.0]; 3])
    }
}

impl From<[f32; 2]> for Square<2> {
    fn from(d: [f32; 2]) -> Self {
        Square([[d[0], 0.0], [0.0, d[1]]])
    }
}

impl From<[f32; 3]> for Square<3> {
    fn from(d: [f32; 3]) -> Self {
        Square([[d[0], 0.0, 0.0], [0.0, d[1], 0.0], [0.0, 0.0, d[2] * 2.0]])
    }
}

fn traced<T: Size>(m: &T) -> f32 {
    m.trace() * T::SIZE
}

fn size_of<T: Size>() -> f32 {
    T::TWICE
}

pub fn impls_by_constants(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let two = Square([[here.x, here.y], [0.5, here.w]]);
    let three = Square::<3>::from([here.y, here.z, 0.25]);
    let made: Square<2> = [here.z, 2.0].into();
    let wide: Vec3 = three.flipped().diagonal();
    let units = Square::<2>::unit().det() + Square::<3>::unit().flipped().det();
    let sizes = Square::<2>::SHARE
        + <Square<3> as Size>::SIZE
        + size_of::<Square<2>>()
        + Square::<3>::TWICE * Square::<3>::SHARE;
    vec4(
        two.det() + three.det() + units,
        traced(&two) + traced(&three),
        made.diagonal().x + wide.z + sizes,
        (-two).diagonal().y + (-three).det(),
    )
}

//// Several `impl`s of one type, told apart by types: `impl Rgb<Linear>`, `impl Rgb<Srgb>`
use std::marker::PhantomData;
#[derive(Clone, Copy, PartialEq)]
struct Linear;
#[derive(Clone, Copy, PartialEq)]
struct Coded;
trait Space {
    const GAIN: f32;
    fn lifted(x: f32) -> f32;
}

impl Space for Linear {
    const GAIN: f32 = 1.0;
    fn lifted(x: f32) -> f32 {
        x + 0.125
    }
}

impl Space for Coded {
    const GAIN: f32 = 0.5;
    fn lifted(x: f32) -> f32 {
        x * 2.0
    }
}

#[derive(Clone, Copy, PartialEq)]
struct Rgb<S> {
    v: Vec3,
    space: PhantomData<S>,
}

impl<S: Space> Rgb<S> {
    fn new(v: Vec3) -> Self {
        Rgb { v, space: PhantomData }
    }

    fn gain(&self) -> f32 {
        S::GAIN + S::lifted(self.v.x)
    }

    fn mixed(self, other: Self, t: f32) -> Self {
        Self::new(self.v.lerp(other.v, t))
    }
}

impl Rgb<Linear> {
    fn turned(self) -> Rgb<Coded> {
        Rgb::new(self.v * self.v)
    }

    fn luma(self) -> f32 {
        self.v.x
    }
}

impl Rgb<Coded> {
    fn turned(self) -> Rgb<Linear> {
        Rgb::new(self.v * 0.25)
    }

    fn luma(self) -> f32 {
        self.v.y * 3.0
    }
}

impl From<Rgb<Coded>> for Rgb<Linear> {
    fn from(c: Rgb<Coded>) -> Self {
        c.turned()
    }
}

#[derive(Clone, Copy)]
struct Cell<T>(T);
impl Cell<f32> {
    fn get(self) -> f32 {
        self.0
    }
}

impl Cell<i32> {
    fn get(self) -> i32 {
        self.0 * 2
    }
}

impl Cell<(f32, f32)> {
    fn get(self) -> f32 {
        self.0.0 - self.0.1
    }
}

impl Cell<Cell<f32>> {
    fn get(self) -> f32 {
        self.0.0 * 0.5
    }
}

impl Cell<Option<f32>> {
    fn get(self) -> f32 {
        self.0.unwrap_or(0.75)
    }
}

fn both<S: Space + Copy>(a: Rgb<S>, b: Rgb<S>) -> f32 {
    a.mixed(b, 0.5).gain()
}

pub fn impls_by_types(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let linear = Rgb::<Linear>::new(here.truncate());
    let coded: Rgb<Coded> = Rgb::new(here.yzw());
    let one = if here.x > 0.5 { linear } else { coded.turned() };
    let other: Rgb<Linear> = coded.into();
    let mut sum = linear;
    for _ in 0..taps {
        sum = sum.mixed(linear.turned().turned(), 0.25);
    }
    let any = [linear, other, one][(pixel.x % 3) as usize];
    let cells = Cell(here.x).get()
        + Cell(pixel.y).get() as f32
        + Cell((here.y, 0.5)).get()
        + Cell(Cell(here.z)).get()
        + Cell(Some(here.w)).get();
    vec4(
        one.turned().v.x + other.v.y,
        sum.luma() + any.turned().luma(),
        both(linear, other) + both(coded, linear.turned()),
        cells + (linear == other) as i32 as f32,
    )
}

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

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

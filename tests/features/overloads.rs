//// One method of several traits: the trait of a bound, a path or a default function chooses
trait Encode {
    fn go(self) -> f32;
}

trait Decode {
    fn go(self) -> f32;

    fn twice(self) -> f32
    where
        Self: Copy,
    {
        self.go() + self.go()
    }
}

impl Encode for f32 {
    fn go(self) -> f32 {
        self * self
    }
}

impl Decode for f32 {
    fn go(self) -> f32 {
        self.sqrt()
    }
}

fn encode<T: Encode>(value: T) -> f32 {
    value.go()
}

fn decode<T: Decode>(value: T) -> f32 {
    value.go()
}

trait First {
    const SHARE: f32 = 0.5;

    fn value(&self) -> f32 {
        0.25
    }

    fn both(&self) -> f32 {
        self.value() * 3.0
    }
}

trait Second {
    fn value(&self) -> f32 {
        0.5
    }

    fn both(&self) -> f32 {
        self.value() * 5.0
    }
}

#[derive(Clone, Copy)]
struct Plain;

impl First for Plain {}
impl Second for Plain {}

pub fn methods_of_two_traits(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel).abs();
    let coded = vec4(encode(here.x), decode(here.x), Encode::go(here.y), <f32 as Decode>::go(here.y));
    let defaults = vec4(First::value(&Plain), Second::value(&Plain), First::both(&Plain), Second::both(&Plain));
    coded + defaults + Decode::twice(here.z) * Plain::SHARE
}

//// A method of the type itself and one of a trait
trait Metric {
    fn distance(self, other: Self) -> f32;
    fn length(&self) -> f32;
    fn fract(self) -> Self;
}

impl Metric for Vec2 {
    fn distance(self, other: Vec2) -> f32 {
        (self - other).abs().element_sum()
    }

    fn length(&self) -> f32 {
        self.abs().max_element()
    }

    fn fract(self) -> Vec2 {
        self * 0.125
    }
}

impl Metric for f32 {
    fn distance(self, other: f32) -> f32 {
        other - self
    }

    fn length(&self) -> f32 {
        *self
    }

    fn fract(self) -> f32 {
        self * 0.25
    }
}

/// Methods that numbers have, and vectors have not.
trait Slope {
    fn tan(self) -> Self;
}

impl Slope for Vec2 {
    fn tan(self) -> Vec2 {
        self * 0.5
    }
}

fn between<T: Metric>(a: T, b: T) -> f32 {
    a.distance(b)
}

fn part<T: Metric + Copy>(value: T) -> f32 {
    value.fract().length()
}

trait Shape {
    fn new(side: f32) -> Self
    where
        Self: Sized;
    fn area(&self) -> f32;
}

struct Square(f32);

impl Square {
    fn new(side: f32) -> Square {
        Square(side)
    }

    fn area(&self) -> f32 {
        self.0
    }
}

impl Shape for Square {
    fn new(side: f32) -> Square {
        Square(side * 2.0)
    }

    fn area(&self) -> f32 {
        self.0 * self.0
    }
}

fn dynamic(shape: &dyn Shape) -> f32 {
    shape.area()
}

fn opaque(shape: &impl Shape) -> f32 {
    shape.area()
}

fn made<T: Shape>(side: f32) -> T {
    T::new(side)
}

pub fn methods_of_a_type_and_a_trait(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let own = vec4(here.xy().distance(here.zw()), here.xy().length(), here.x.fract(), here.xy().fract().y);
    let generic = vec4(between(here.xy(), here.zw()), between(here.x, here.y), part(here.xy()), part(here.z));
    let generic = generic + here.xy().tan().extend(0.0).extend(1.0);
    let square = Square::new(here.x);
    let shapes = vec4(square.area(), dynamic(&square), opaque(&square), Shape::area(&square));
    let doubled: Square = made(here.y);
    own + generic + shapes + <Square as Shape>::area(&doubled) + <Square as Shape>::new(here.z).0
}

//// Functions of a type with constant parameters, called by `Self`
struct Window<const N: usize>;

impl<const N: usize> Window<N> {
    fn weight(k: usize) -> f32 {
        (k + 1) as f32 / N as f32
    }

    fn sum(&self, x: f32) -> f32 {
        let mut sum = 0.0;
        for k in 0..N {
            sum += Self::weight(k) * x;
        }
        sum
    }
}

pub fn functions_by_self(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let [three, five]: [f32; 2] = {
        let three: Window<3> = Window;
        let five: Window<5> = Window;
        let here = color.load(pixel);
        [three.sum(here.x), five.sum(here.y)]
    };
    vec4(three, five, Window::<4>::weight(1), 1.0)
}

//// `partial_cmp(..).unwrap()`, where nothing is NaN
pub fn sorted_by_partial_cmp(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut all = color.load(pixel).to_array();
    all.sort_by(|a, b| a.partial_cmp(b).unwrap());
    let least = all.iter().copied().min_by(|a, b| a.partial_cmp(b).expect("numbers")).unwrap_or(0.0);
    vec4(all[0], all[1], all[3], least)
}

//// `assert_eq!`, `assert_ne!` and `debug_assert!`
pub fn assertions(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    const SIDE: usize = 4;
    assert!(SIDE > 2);
    assert_eq!(SIDE % 2, 0);
    assert_ne!(SIDE, 3, "three has no middle");
    debug_assert!(taps > -1000);
    debug_assert_eq!(SIDE, 4);
    color.load(pixel) * SIDE as f32
}

//// Logarithms and powers of two of `usize`
const SIDE: usize = 24;
const BITS: u32 = SIDE.ilog2();
pub fn sizes_by_bits(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let wide: usize = 1 << 40;
    let known = SIDE.next_power_of_two() + SIDE.next_multiple_of(7) + wide.ilog2() as usize;
    let zeros = SIDE.leading_zeros() + wide.leading_zeros() + SIDE.trailing_zeros() + wide.trailing_zeros();
    let place = (pixel.x.unsigned_abs() & 63) as usize;
    let found = place.checked_ilog2().unwrap_or(9) + (place + 1).next_multiple_of(5) as u32;
    color.load(pixel) + vec4(known as f32, zeros as f32, found as f32, BITS as f32)
}

//// Searches after `filter`
pub fn searches_after_filter(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel).to_array();
    let bright = || here.into_iter().filter(|x| *x > 0.4);
    let found = bright().find(|x| *x < 0.7).unwrap_or(0.0) + bright().reduce(f32::min).unwrap_or(2.0);
    let place = bright().position(|x| x > 0.6).unwrap_or(7) as f32;
    let signs = [pixel.x - 3, pixel.y, pixel.x - pixel.y].into_iter().filter(|k| k % 2 == 0);
    let ends = [pixel.x - 3, pixel.y, pixel.x - pixel.y].into_iter().filter(|k| k % 2 == 0);
    let near = bright().min_by(|a, b| (a - 0.5).abs().total_cmp(&(b - 0.5).abs())).unwrap_or(3.0);
    vec4(found + near, place, signs.min().unwrap_or(99) as f32, ends.max_by_key(|k| k * k).unwrap_or(99) as f32)
}

//// Constants of a type with constant parameters
struct Layer<const I: usize, const O: usize> {
    gain: f32,
}

impl<const I: usize, const O: usize> Layer<I, O> {
    const COUNT: usize = (I + 1) * O;
    const FITS: () = assert!(I > 0);

    fn sum(&self) -> f32 {
        let () = Self::FITS;
        self.gain * Self::COUNT as f32
    }
}

pub fn constants_by_parameters(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let gain = color.load(pixel).x;
    vec4(Layer::<2, 3> { gain }.sum(), Layer::<4, 1> { gain }.sum(), gain, 1.0)
}

//// A structure without fields and with constant parameters as a value, and `PhantomData`
use std::marker::PhantomData;

trait Kernel {
    fn weight(&self, x: f32) -> f32;
}

struct Box3<const R: i32>;

impl<const R: i32> Kernel for Box3<R> {
    fn weight(&self, x: f32) -> f32 {
        x * R as f32
    }
}

fn weigh<T: Kernel>(kernel: &T, x: f32) -> f32 {
    kernel.weight(x)
}

trait Activation {
    fn apply(x: f32) -> f32;
}

struct Relu;

impl Activation for Relu {
    fn apply(x: f32) -> f32 {
        x.max(0.5)
    }
}

struct Dense<A> {
    gain: f32,
    activation: PhantomData<A>,
}

impl<A: Activation> Dense<A> {
    fn new(gain: f32) -> Self {
        Dense { gain, activation: PhantomData }
    }

    fn apply(&self, x: f32) -> f32 {
        A::apply(x) * self.gain
    }
}

pub fn empty_structures(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    vec4(weigh(&Box3::<3>, here.x), Box3::<2>.weight(here.y), Dense::<Relu>::new(0.5).apply(here.z), 1.0)
}

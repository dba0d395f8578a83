//// Arrays indexed at run time, read and written
pub fn array_at_run_time(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut bins = [0.0; 4];
    for k in 0..8 {
        let bin = (color.load(pixel + ivec2(k, 0)).x * 3.99) as usize;
        bins[bin.min(3)] += 0.125;
    }
    Vec4::from_array(bins)
}

//// Arrays of arrays indexed at run time
pub fn arrays_of_arrays(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let bayer = [[0.0, 0.5], [0.75, 0.25]];
    let threshold = bayer[(pixel.y & 1) as usize][(pixel.x & 1) as usize];
    if color.load(pixel).x > threshold { Vec4::ONE } else { Vec4::ZERO }
}

//// Arrays of structures indexed at run time
#[derive(Clone, Copy)]
struct Ball {
    at: Vec2,
    radius: f32,
}

pub fn arrays_of_structures(taps: i32, pixel: IVec2) -> Vec4 {
    let balls = [
        Ball { at: vec2(2.0, 3.0), radius: 2.0 },
        Ball { at: vec2(8.0, 4.0), radius: 3.0 },
    ];
    let ball = balls[(taps & 1) as usize];
    Vec4::splat(pixel.as_vec2().distance(ball.at) - ball.radius)
}

//// Slices as parameters
fn total(values: &[f32]) -> f32 {
    let mut sum = 0.0;
    for value in values {
        sum += value;
    }
    sum / values.len() as f32
}

pub fn slices(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    Vec4::splat(total(&[here.x, here.y]) + total(&here.to_array()))
}

//// Tuples
fn extremes(v: Vec4) -> (f32, f32) {
    (v.min_element(), v.max_element())
}

pub fn tuples(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (low, high) = extremes(color.load(pixel));
    Vec4::splat(high - low)
}

//// Tuples, arrays and structures compared by `==`
#[derive(Clone, Copy, PartialEq)]
struct Cell {
    x: i32,
    y: i32,
}

pub fn compared(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let cell = Cell { x: pixel.x >> 2, y: pixel.y >> 2 };
    let corner = (pixel.x, pixel.y) == (0, 0) || [pixel.x, pixel.y] == [1, 1];
    if corner || cell == (Cell { x: 1, y: 1 }) { Vec4::ONE } else { color.load(pixel) }
}

//// `&mut` parameters
fn accumulate(sum: &mut Vec4, texel: Vec4) {
    *sum += texel;
    sum.w = 1.0;
}

pub fn mutable_references(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    accumulate(&mut sum, color.load(pixel));
    accumulate(&mut sum, color.load(pixel + ivec2(1, 0)));
    sum
}

//// Components by index, read and written
pub fn components(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut here = color.load(pixel);
    for k in 0..3 {
        here[k] = here[2 - k] * 0.5;
    }
    here
}

//// Swizzles, and `with_x`
pub fn swizzles(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    here.zyxw().with_w(here.xy().with_x(0.5).length())
}

//// Matrices
pub fn matrices(color: &Frame<Vec4>, grade: Mat3, pixel: IVec2) -> Vec4 {
    let turned = Mat2::from_angle(0.5) * color.load(pixel).xy();
    (grade.transpose() * turned.extend(1.0)).extend(grade.determinant())
}

//// Masks: `cmplt`, `select`, `any`, `all`
pub fn masks(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let dark = here.cmplt(Vec4::splat(0.5));
    if dark.all() { Vec4::ONE } else { Vec4::select(dark, here * 2.0, here) }
}

//// Wrapping arithmetic and bits of integers
pub fn hashed(pixel: IVec2) -> Vec4 {
    let mut h = (pixel.x as u32).wrapping_mul(747_796_405).wrapping_add(pixel.y as u32);
    h = (h ^ (h >> 15)).wrapping_mul(277_803_737).rotate_left(7);
    Vec4::splat((h >> 8) as f32 / 16_777_216.0 + h.count_ones() as f32)
}

//// Bits of floats
pub fn bits_of_floats(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let guess = f32::from_bits(0x5f37_59df - (color.load(pixel).x.to_bits() >> 1));
    Vec4::splat(guess)
}

//// `mem::swap` and `mem::replace`
pub fn swapped(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let (mut a, mut b) = (here.x, here.y);
    if a > b {
        std::mem::swap(&mut a, &mut b);
    }
    let old = std::mem::replace(&mut a, 0.5);
    vec4(a, b, old, 1.0)
}

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

//// `sort` and its like of arrays, `copy_from_slice`, `is_empty`
pub fn arrays_sorted(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut luma: [f32; 5] = std::array::from_fn(|k| color.load(pixel + ivec2(k as i32, 0)).x);
    let mut levels = luma.map(|x| (x * 16.0) as i32);
    let mut pairs = luma.map(|x| ((x * 4.0) as u32, x));
    luma.sort_by(|a, b| b.total_cmp(a));
    levels.sort();
    pairs.sort_by_key(|pair| pair.0);
    let mut copy = [0; 5];
    copy.copy_from_slice(&levels);
    copy.sort_unstable_by(|a, b| b.cmp(a));
    let empty = if copy.is_empty() { 1.0 } else { 0.0 };
    vec4(luma[2] + empty, levels[1] as f32 + copy[0] as f32, pairs[2].1, pairs[4].0 as f32)
}

//// `min_by`, `max_by`, `min_by_key`, `max_by_key`, `last` and `nth` of iterators
pub fn iterators_by_keys(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps = [0, 1, 2, 3].map(|k| color.load(pixel + ivec2(k, 1)));
    let least = taps.iter().min_by(|a, b| a.x.total_cmp(&b.x)).map_or(0.0, |tap| tap.y);
    let most = taps.iter().map(|tap| tap.z).max_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal)).unwrap_or(0.0);
    let first = [5, 2, 7, 2].into_iter().min_by_key(|k| (k - pixel.x).abs()).unwrap_or(0);
    let other = [5, 2, 7, 2].into_iter().max_by_key(|k| k * pixel.y % 5).unwrap_or(0);
    let last = taps.iter().map(|tap| tap.w).last().unwrap_or(9.0);
    let second = taps.iter().nth(1).map_or(8.0, |tap| tap.x);
    vec4(least + last, most + second, first as f32, other as f32)
}

//// `ilog2`, `isqrt`, `next_power_of_two`, `swap_bytes`, `cmp`
pub fn integers_of_bits(ids: &Frame<u32>, pixel: IVec2) -> Vec4 {
    let h = ids.load(pixel).wrapping_mul(0x9e37_79b9);
    let order = match (h & 7).cmp(&(h >> 29)) {
        std::cmp::Ordering::Less => 1.0,
        std::cmp::Ordering::Equal => 2.0,
        std::cmp::Ordering::Greater => 3.0,
    };
    let roots = (h.isqrt() & 0xfff) as f32 + (h >> 12).isqrt() as f32;
    let logs = (h | 1).ilog2() + (pixel.x + 1).ilog2() + (h >> 5).next_power_of_two().ilog2();
    vec4(roots, logs as f32, (h.swap_bytes() >> 12) as f32, order + (pixel.y - 4).wrapping_abs() as f32)
}

//// `bitmask`, `with_xy`, `try_normalize`, `from_axis_angle`
pub fn vectors_more(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mask = here.cmplt(Vec4::splat(0.5)).bitmask();
    let turn = Mat3::from_axis_angle(Vec3::Y, here.x) * Mat3::from_scale(here.yz()) * Mat3::from_translation(here.zw());
    let v = turn * here.with_xy(here.zw()).with_zw(here.xy()).truncate();
    let unit = (v - strength * 0.25).try_normalize().unwrap_or(Vec3::X);
    vec4(v.x, v.y + unit.z, unit.x, mask as f32)
}

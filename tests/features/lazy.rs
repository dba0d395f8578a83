//// `skip`, `take`, `step_by`, `rev` and `enumerate` of ranges with runtime bounds
pub fn lazy_parts(weights: &Buffer<f32>, taps: i32, pixel: IVec2) -> Vec4 {
    let n = weights.len().min((taps + (pixel.x & 3)).max(0) as usize);
    let tail: f32 = (0..n).skip(1).map(|k| weights.load(k)).sum();
    let head: f32 = (0..n).take(2).map(|k| weights.load(k) * 0.5).sum();
    let inner = (-taps..=taps).skip(1).take(3).fold(1, |a, k| a * 3 + k);
    let back = (0..n).map(|k| weights.load(k)).rev().skip(1).fold(0.25, |a, x| a * 0.5 + x);
    let mut sum = 0.0;
    for (k, x) in (0..n).rev().enumerate() {
        sum += weights.load(x) * k as f32;
    }
    for (k, x) in (pixel.x..pixel.x + taps).step_by(2).map(|x| x * 2).enumerate().skip(1) {
        sum += (k as i32 * x) as f32;
    }
    let few = (0..20).take((pixel.y & 7) as usize).map(|k| k * k).sum::<i32>() + (2..9).skip((pixel.x & 3) as usize).count() as i32;
    let listed = [1, 5, 2, 4].iter().take((pixel.x & 3) as usize).rev().fold(0, |a, k| a * 2 + k);
    vec4(tail + head, inner as f32 + back, sum, (few + listed) as f32)
}

//// `zip` of ranges with runtime bounds, and of arrays
pub fn lazy_pairs(color: &Frame<Vec4>, weights: &Buffer<f32>, taps: i32, pixel: IVec2) -> Vec4 {
    let n = weights.len().min((taps + (pixel.x & 3)).max(0) as usize);
    let shares = [0.5, 0.25, 0.125, 2.0, 1.0];
    let mut sum = Vec4::ZERO;
    for (x, share) in (-taps..=taps).zip(shares) {
        sum += color.load(pixel + ivec2(x, 0)) * share;
    }
    let both: f32 = shares.iter().zip(0..n).map(|(share, k)| share * weights.load(k)).sum();
    let turned = (0..n).rev().zip((0..taps).step_by(2)).fold(1.0, |a, (k, x)| a * 0.5 + weights.load(k) * x as f32);
    let three = (0..n).zip(shares.iter().zip(3..9)).enumerate().find(|(_, (k, (_, x)))| k * x > 7);
    sum + vec4(both, turned, three.map_or(-1.0, |(k, (_, (share, _)))| k as f32 + share), 0.0)
}

//// Sequences of `std::iter`: `once`, `repeat`, `repeat_n`, `successors`, `zip`, `empty` and `cycle`
use std::iter;
pub fn sequences(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut taps = Vec4::ZERO;
    for x in iter::once(-2).chain(0..3) {
        taps += color.load(pixel + ivec2(x, 0));
    }
    for (k, x) in iter::successors(Some(1), |x| Some(x * 2)).take(4).enumerate() {
        taps += color.load(pixel + ivec2(x, k as i32)) * 0.5;
    }
    let mut sum: f32 =
        iter::repeat(here.y).take(3).sum::<f32>() + iter::repeat_n(here.z, 2).map(|x| x * 2.0).sum::<f32>();
    for step in iter::successors(Some(64), |&x| if x > 1 { Some(x / 2) } else { None }) {
        sum += step as f32 * here.x;
    }
    for step in iter::successors(Some(1), |x| Some(x * 3)).take_while(|&x| x < 40) {
        sum += step as f32;
    }
    for (share, x) in iter::repeat(0.5).zip([here.x, here.y]) {
        sum += share * x;
    }
    let powers: f32 = iter::successors(Some(1.0_f32), |x| Some(x * here.x)).take(4).sum();
    let grown: f32 = iter::successors(Some(here.x), |x| (*x < 4.0).then_some(x * 1.5 + 0.25))
        .take(8)
        .sum();
    let pairs: f32 = iter::zip([1.0, 2.0], [here.x, here.y]).map(|(a, b)| a * b).sum();
    let scaled: f32 = [here.x, here.y]
        .into_iter()
        .zip(iter::repeat(0.25).map(|x| x * 2.0))
        .map(|(a, b)| a * b)
        .sum();
    let turns: f32 = [0.5, 0.25, 0.125]
        .into_iter()
        .zip([here.x, here.y].into_iter().cycle())
        .map(|(a, b)| a * b)
        .sum();
    let plain: f32 = iter::empty().chain([1.0, here.w]).sum();
    taps + vec4(sum, powers + grown, pairs + scaled, turns + plain)
}

//// Ranges as parameters, fields and results: `Range<i32>`, `RangeInclusive<i32>`
use std::ops::{Range, RangeInclusive};
fn squares(range: Range<i32>) -> i32 {
    range.map(|k| k * k).sum()
}

fn counted(range: RangeInclusive<i32>, by: i32) -> i32 {
    let mut sum = 0;
    for k in range {
        sum += k * by;
    }
    sum
}

fn around(centre: i32) -> Range<i32> {
    centre - 1..centre + 2
}

fn within(range: &Range<f32>, x: f32) -> f32 {
    (x - range.start) / (range.end - range.start)
}

struct Band {
    rows: Range<usize>,
    gain: f32,
}

impl Band {
    fn has(&self, y: usize) -> bool {
        self.rows.contains(&y)
    }

    fn len(&self) -> usize {
        self.rows.end - self.rows.start
    }
}

pub fn ranges_as_types(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let band = Band {
        rows: 1..4,
        gain: here.x,
    };
    let mut sum = 0.0;
    for k in band.rows.clone() {
        sum += k as f32 * band.gain;
    }
    for x in around(pixel.x) {
        sum += color.load(ivec2(x, pixel.y)).y;
    }
    let many = squares(0..4) + squares(0..taps) + counted(-1..=3, 2) + counted(0..=taps, 1);
    let inside = band.has(2) as i32 + (0.0..0.5).contains(&here.y) as i32;
    vec4(
        sum,
        many as f32,
        band.len() as f32 + inside as f32,
        within(&(0.25..2.0), here.z),
    )
}

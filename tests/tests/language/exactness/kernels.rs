//! Kernels whose sums hang on the order of their operations, and others in which none does.

/// Name and text of a kernel.
pub type Named = (&'static str, &'static str);

/// Kernels that fast mathematics would change.
pub const FAST: &[&str] = &["kahan", "split by 4097 and multiplied", "rounded by 12582912"];

/// Kernels that are run by strict mathematics, too.
pub const STRICT: &[&str] = &["kahan", "neumaier", "mean of products", "dot and cross", "polynomial"];

/// Kernels of which something is found to hang on an order.
pub const ORDERED: &[Named] = &[
    (
        "kahan",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = a.load(pixel).x;
    let mut sum = 16777216.0 + x;
    let mut lost = 0.0;
    for _ in 0..10 {
        let y = 1.0 - lost;
        let t = sum + y;
        lost = (t - sum) - y;
        sum = t;
    }
    vec4(sum - 16777216.0, lost, sum, 1.0)
}
",
    ),
    (
        "kahan of constants",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 16777216.0;
    let mut lost = 0.0;
    for _ in 0..10 {
        let y = 1.0 - lost;
        let t = sum + y;
        lost = (t - sum) - y;
        sum = t;
    }
    vec4(sum - 16777216.0, lost, a.load(pixel).y, 1.0)
}
",
    ),
    (
        "kahan in a while",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (mut sum, mut lost, mut k) = (1.0e7, 0.0, 0);
    #[cfg_attr(false, bound(16))]
    while k < 5 + pixel.x {
        let y = a.load(ivec2(k, pixel.y)).x * 0.37 - lost;
        let t = sum + y;
        lost = (t - sum) - y;
        sum = t;
        k += 1;
    }
    vec4(sum - 1.0e7, lost, sum, 1.0)
}
",
    ),
    (
        "kahan whose error is taken in the next iteration",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (mut sum, mut before, mut y) = (3.0e7, 3.0e7, 0.0);
    for k in 0..10 {
        let lost = (sum - before) - y;
        y = a.load(ivec2(k, pixel.y)).x - lost;
        before = sum;
        sum += y;
    }
    vec4(sum - 3.0e7, (sum - before) - y, sum, 1.0)
}
",
    ),
    (
        "kahan of vectors",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (mut sum, mut lost) = (Vec4::splat(2.0e7), Vec4::ZERO);
    for k in 0..7 {
        let y = a.load(ivec2(k, pixel.y)) * 0.71 - lost;
        let t = sum + y;
        lost = (t - sum) - y;
        sum = t;
    }
    sum - 2.0e7 - lost
}
",
    ),
    (
        "kahan of a structure, in a method and a closure",
        "#[derive(Clone, Copy)]
struct Sum {
    sum: Vec2,
    lost: Vec2,
}

impl Sum {
    fn add(&mut self, x: Vec2) {
        let y = x - self.lost;
        let t = self.sum + y;
        self.lost = (t - self.sum) - y;
        self.sum = t;
    }
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut total = Sum { sum: vec2(2.5e7, -1.9e7), lost: Vec2::ZERO };
    let taken = |k: i32| a.load(ivec2(k, pixel.y)).truncate().truncate() * 1.3;
    for k in 0..9 {
        total.add(taken(k));
    }
    vec4(total.sum.x - 2.5e7, total.sum.y + 1.9e7, total.lost.x, total.lost.y)
}
",
    ),
    (
        "sums in an array",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sums = [1.7e7, 3.4e7, 6.8e7];
    let mut lost = [0.0; 3];
    for k in 0..12 {
        let i = (k % 3) as usize;
        let y = a.load(ivec2(k, pixel.y)).y - lost[i];
        let t = sums[i] + y;
        lost[i] = (t - sums[i]) - y;
        sums[i] = t;
    }
    vec4(sums[0] - 1.7e7, sums[1] - 3.4e7, sums[2] - 6.8e7, lost[0] + lost[1] + lost[2])
}
",
    ),
    (
        "neumaier",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let values = [16777216.0 + v.x, 1.0, -16777216.0, v.y, 1.0e7, v.z * 0.3, -1.0e7];
    let (mut sum, mut lost) = (0.0_f32, 0.0_f32);
    for x in values {
        let t = sum + x;
        if sum.abs() >= x.abs() {
            lost += (sum - t) + x;
        } else {
            lost += (x - t) + sum;
        }
        sum = t;
    }
    vec4(sum + lost, sum, lost, 0.0)
}
",
    ),
    (
        "two-sum",
        "fn two_sum(a: f32, b: f32) -> (f32, f32) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let (s, e) = two_sum(v.x * 1.0e6, v.y * 0.333);
    let (t, f) = two_sum(s, v.z);
    vec4(s, e, t, f)
}
",
    ),
    (
        "fast two-sum by size",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let (x, y) = (v.x * 7.1e5, v.y * 1.7);
    let (large, small) = if x.abs() > y.abs() { (x, y) } else { (y, x) };
    let s = large + small;
    let e = small - (s - large);
    vec4(s, e, s - large, large)
}
",
    ),
    (
        "one side of a selection",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let moved = if v.y > 0.5 { v.x + 4.0e6 } else { 4.0e6 };
    vec4(moved - 4.0e6, moved, 0.0, 1.0)
}
",
    ),
    (
        "rounded by 12582912",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel) * 0.7;
    let moved = (v + 12582912.0) - 12582912.0;
    vec4((v.x + 12582912.0) - 12582912.0, moved.y, moved.z, (v.w + 12582912.0) - 12582911.0)
}
",
    ),
    (
        "rounded by 8388608, with the sign kept",
        "const WHOLE: f32 = 8388608.0;

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let round = |x: f32| if x < 0.0 { (x - WHOLE) + WHOLE } else { (x + WHOLE) - WHOLE };
    vec4(round(v.x), round(v.y * 0.3), v.z - round(v.z), round(v.w * 100.0) * 0.01)
}
",
    ),
    (
        "split by 4097 and multiplied",
        "fn split(x: f32) -> (f32, f32) {
    let c = 4097.0 * x;
    let high = c - (c - x);
    (high, x - high)
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel) * 1.234567;
    let (x, y) = (split(v.x), split(v.y));
    let p = v.x * v.y;
    let e = ((x.0 * y.0 - p) + x.0 * y.1 + x.1 * y.0) + x.1 * y.1;
    vec4(p, e, x.0, x.1)
}
",
    ),
    (
        "double floats",
        "fn two_sum(a: f32, b: f32) -> Vec2 {
    let s = a + b;
    let bb = s - a;
    vec2(s, (a - (s - bb)) + (b - bb))
}

fn quick(a: f32, b: f32) -> Vec2 {
    let s = a + b;
    vec2(s, b - (s - a))
}

fn split(x: f32) -> Vec2 {
    let c = 4097.0 * x;
    let high = c - (c - x);
    vec2(high, x - high)
}

fn two_product(a: f32, b: f32) -> Vec2 {
    let p = a * b;
    let (x, y) = (split(a), split(b));
    vec2(p, ((x.x * y.x - p) + x.x * y.y + x.y * y.x) + x.y * y.y)
}

fn add(a: Vec2, b: Vec2) -> Vec2 {
    let s = two_sum(a.x, b.x);
    let t = two_sum(a.y, b.y);
    let r = quick(s.x, s.y + t.x);
    quick(r.x, r.y + t.y)
}

fn mul(a: Vec2, b: Vec2) -> Vec2 {
    let p = two_product(a.x, b.x);
    quick(p.x, p.y + (a.x * b.y + a.y * b.x))
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel) * 0.1234567;
    let mut z = vec2(v.x, v.y * 1.0e-8);
    let c = vec2(0.3, 1.1e-9);
    for _ in 0..3 {
        z = add(mul(z, vec2(0.37, 2.0e-9)), c);
    }
    let s = add(vec2(v.z, v.w * 1.0e-9), c);
    vec4(z.x, z.y, s.x, s.y)
}
",
    ),
    (
        "compensated horner",
        "const COEFFICIENTS: [f32; 6] = [1.0, -5.0, 10.0, -10.0, 5.0, -1.0];

fn split(x: f32) -> (f32, f32) {
    let c = 4097.0 * x;
    let high = c - (c - x);
    (high, x - high)
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = 1.0 + a.load(pixel).x * 0.01;
    let (mut s, mut c) = (COEFFICIENTS[0], 0.0);
    for k in 1..6 {
        let p = s * x;
        let (h, l) = split(s);
        let (g, m) = split(x);
        let pi = l * m - (((p - h * g) - l * g) - h * m);
        let t = p + COEFFICIENTS[k];
        let z = t - p;
        let sigma = (p - (t - z)) + (COEFFICIENTS[k] - z);
        c = c * x + (pi + sigma);
        s = t;
    }
    vec4(s + c, s, c, x)
}
",
    ),
    (
        "what a quotient and a root leave",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel).abs() + 0.5;
    let sum = (v.x + v.y) * v.z - v.x * v.z;
    let third = (v.x + v.w) * 3.0 - v.x * 3.0;
    vec4(sum, third, 1.0 - (1.0 - v.y * 1.0e-4), (v.x - v.y) + v.y)
}
",
    ),
    (
        "by a dot product",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let moved = vec2(v.x + 5.0e6, 5.0e6);
    vec4(moved.dot(vec2(1.0, -1.0)), v.y, 0.0, 1.0)
}
",
    ),
    (
        "an addition that changes nothing",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel).abs() + 1.0;
    let mut small = 1.0;
    let mut halvings = 0.0;
    for _ in 0..40 {
        if v.x + small > v.x {
            small *= 0.5;
            halvings += 1.0;
        }
    }
    vec4(small, halvings, if v.y + 1.0e-8 == v.y { 1.0 } else { 0.0 }, 1.0)
}
",
    ),
    (
        "in a fold over pairs",
        "fn joined(x: (f32, f32), y: (f32, f32)) -> (f32, f32) {
    let s = x.0 + y.0;
    let z = s - x.0;
    (s, (x.0 - (s - z)) + (y.0 - z) + (x.1 + y.1))
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v: [f32; 4] = (a.load(pixel) * 3.3e5).to_array();
    let parts = v.map(|x| (x, 0.0));
    let left = joined(parts[0], parts[1]);
    let right = joined(parts[2], parts[3]);
    let all = joined(left, right);
    vec4(all.0, all.1, left.1, right.1)
}
",
    ),
];

/// Kernels in which an order is asked for by an attribute.
pub const ASKED: &[Named] = &[
    (
        "a function",
        "#[cfg_attr(false, exact)]
fn weighed(x: Vec4, y: Vec4) -> f32 {
    helper(x.x * y.x, x.y * y.y) + x.z * y.z
}

fn helper(x: f32, y: f32) -> f32 {
    x * 0.3 + y * 0.7
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let w = a.load(pixel + ivec2(1, 0));
    vec4(weighed(v, w), weighed(w, v.wzyx()), v.x, 1.0)
}
",
    ),
    (
        "a let and a block",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    #[cfg_attr(false, exact)]
    let first = v.x * v.y + v.z * v.w;
    let mut second = 0.1;
    #[cfg_attr(false, exact)]
    {
        second += v.x * 0.1 + (v.y * 0.2 + v.z);
    }
    vec4(first, second, 0.0, 1.0)
}
",
    ),
    (
        "a loop and a condition",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = a.load(pixel);
    let mut sum = v.x * 0.1;
    #[cfg_attr(false, exact)]
    for k in 0..6 {
        sum = sum * 0.9 + a.load(ivec2(k, pixel.y)).y * 0.1;
    }
    #[cfg_attr(false, exact)]
    if v.z > 0.0 {
        sum = sum * v.z + v.w;
    }
    vec4(sum, v.y, 0.0, 1.0)
}
",
    ),
];

/// Kernels in which nothing hangs on an order.
pub const ORDINARY: &[Named] = &[
    (
        "mean of products",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (mut sum, mut weights) = (Vec4::ZERO, 0.0);
    for y in -1..=1 {
        for x in -1..=1 {
            let w = 1.0 - 0.25 * (x * x + y * y) as f32;
            sum += a.load(pixel + ivec2(x, y)) * w;
            weights += w;
        }
    }
    sum / weights
}
",
    ),
    (
        "gradient and unsharp mask",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let l = |x: i32, y: i32| a.load(pixel + ivec2(x, y)).x;
    let gx = l(1, -1) + 2.0 * l(1, 0) + l(1, 1) - (l(-1, -1) + 2.0 * l(-1, 0) + l(-1, 1));
    let gy = l(-1, 1) + 2.0 * l(0, 1) + l(1, 1) - (l(-1, -1) + 2.0 * l(0, -1) + l(1, -1));
    let blurred = (l(-1, 0) + l(1, 0) + l(0, -1) + l(0, 1) + 4.0 * l(0, 0)) * 0.125;
    let sharp = l(0, 0) + (l(0, 0) - blurred) * 1.5;
    vec4(gx, gy, sharp, l(1, 0) - 2.0 * l(0, 0) + l(-1, 0))
}
",
    ),
    (
        "mixes, moments and colours",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (v, w) = (a.load(pixel), a.load(pixel + ivec2(1, 0)));
    let history = v + (w - v) * 0.05;
    let mixed = v * (1.0 - w.x) + w * w.x;
    let mean = (v.x + v.y + v.z) * (1.0 / 3.0);
    let variance = (v.x * v.x + v.y * v.y + v.z * v.z) * (1.0 / 3.0) - mean * mean;
    let luma = 0.299 * v.x + 0.587 * v.y + 0.114 * v.z;
    let chroma = vec4((v.z - luma) * 0.565, (v.x - luma) * 0.713, variance, v.w * 2.0 - 1.0);
    history + mixed + chroma
}
",
    ),
    (
        "dot and cross",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (v, w) = (a.load(pixel).truncate(), a.load(pixel + ivec2(0, 1)).truncate());
    let normal = v.cross(w);
    let reflected = v - normal * (2.0 * v.dot(normal));
    reflected.extend(v.dot(w) - w.dot(w) + normal.x * v.y - normal.y * v.x)
}
",
    ),
    (
        "polynomial",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let t = a.load(pixel).x - a.load(pixel).x.floor();
    let cubic = vec4(
        ((-0.5 * t + 1.0) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((-1.5 * t + 2.0) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    );
    let mut z = 0.0;
    for k in 0..5 {
        z = z * t + 0.3 * k as f32;
    }
    cubic + z
}
",
    ),
    (
        "running differences and extremes",
        "pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut before = a.load(pixel);
    let (mut change, mut most) = (Vec4::ZERO, Vec4::splat(-1.0e9));
    for k in 1..5 {
        let now = a.load(pixel + ivec2(k, 0));
        change += (now - before).abs();
        most = most.max(now);
        before = now;
    }
    let range = most - most.min(change);
    let place = (vec2(pixel.x as f32, pixel.y as f32) + 0.5) * vec2(0.25, 0.5);
    change + range + vec4(place.x * 2.0, place.y - place.y.floor(), 0.0, 0.0)
}
",
    ),
];

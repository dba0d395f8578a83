//! Kernels of loops that are left in the shader, or cannot be: compiled by rustc, and read as text by the generator.

use straightline_kernels::prelude::*;

const WEIGHTS: [f32; 4] = [0.1, 0.2, 0.4, 0.3];

#[derive(Clone, Copy)]
pub struct Tap {
    at: IVec2,
    weight: f32,
}

const TAPS: [Tap; 3] = [
    Tap {
        at: ivec2(0, 1),
        weight: 0.5,
    },
    Tap {
        at: ivec2(1, 1),
        weight: 0.25,
    },
    Tap {
        at: ivec2(1, 0),
        weight: 0.125,
    },
];

pub fn elements(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut s = 0.0;
    for w in WEIGHTS {
        s = s * 1.5 + w;
    }
    for w in WEIGHTS.iter().rev() {
        s = s * 1.5 + w;
    }
    let mut v = [c.x, c.y, 1.0];
    v[n.rem_euclid(3) as usize] = 7.0;
    for x in v {
        s = s * 1.5 + x;
    }
    for x in v.iter().rev() {
        s = s * 1.5 + x;
    }
    for i in [3usize, 1, 2] {
        s = s * 1.5 + WEIGHTS[i];
    }
    vec4(s, c.z, c.w, 1.0)
}

pub fn enumerated(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).x * n as f32;
    for (i, w) in WEIGHTS.iter().enumerate() {
        s = s * 1.5 + w * i as f32;
    }
    for (i, w) in WEIGHTS.iter().enumerate().rev() {
        s = s * 1.5 + w * i as f32;
    }
    for (i, w) in WEIGHTS.iter().rev().enumerate() {
        s = s * 1.5 + w * i as f32;
    }
    vec4(s, 0.0, 0.0, 1.0)
}

pub fn structures(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = n as f32;
    for tap in TAPS {
        s += color.load(pixel + tap.at).x * tap.weight;
    }
    for (at, weight) in [(ivec2(1, 0), 0.5), (ivec2(0, 1), 0.25)] {
        s += color.load(pixel + at).x * weight;
    }
    for i in 0..3 {
        s = s * 1.1 + TAPS[i].weight;
    }
    vec4(s, 0.0, 0.0, 1.0)
}

pub fn grid(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let t = [[1.0, 2.0], [3.0, 4.0], [5.0, color.load(pixel).x]];
    let mut s = 0.0;
    for i in 0..3 {
        for j in 0..2 {
            s = s * 1.1 + t[i][j];
        }
    }
    for row in t {
        for x in row {
            s = s * 1.1 + x;
        }
    }
    vec4(s, t[n.rem_euclid(3) as usize][n.rem_euclid(2) as usize], 0.0, 1.0)
}

pub fn whiles(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut s = n as f32;
    let mut i = 0;
    while i < 7 {
        s = s * 1.5 + c.x * i as f32;
        i += 2;
    }
    let mut q = 0;
    while q < i {
        s = s * 0.9 + c.y;
        q += 1;
    }
    vec4(s, i as f32, q as f32, 1.0)
}

pub fn bounded(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut left = n + pixel.x;
    let mut s = c.x;
    #[cfg_attr(false, bound(9))]
    while left > 0 {
        left -= 1;
        if left == 2 {
            continue;
        }
        s = s * 0.75 + left as f32;
    }
    let mut steps = 0;
    #[cfg_attr(false, bound(12))]
    loop {
        if s < 0.5 || steps > 10 {
            break;
        }
        s *= 0.5;
        steps += 1;
    }
    let mut next = Some(n);
    let mut sum = 0;
    #[cfg_attr(false, bound(6))]
    while let Some(k) = next {
        sum += k;
        next = if k > pixel.y { Some(k - 1) } else { None };
    }
    vec4(s, steps as f32, sum as f32, left as f32)
}

pub fn unsigned(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let m = n as u32;
    let mut h = color.load(pixel).x as u32;
    for i in 0u32..9u32 {
        h = h.wrapping_mul(31u32).wrapping_add(turned(i));
    }
    for i in m..m + 5u32 {
        h = h.wrapping_mul(31u32).wrapping_add(turned(i));
    }
    vec4((h & 0xffffu32) as f32, (h >> 16u32) as f32, 0.0, 1.0)
}

fn turned(x: u32) -> u32 {
    x ^ (x << 3u32)
}

pub fn left(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut s = n as f32;
    for i in 0..6 {
        if i == 3 {
            continue;
        }
        s = s * 1.5 + c.x;
    }
    for j in 0..6 {
        s += match j {
            0 => 1.0,
            1 => c.y,
            _ => 0.5,
        };
    }
    let mut m = 0;
    for k in 0..4 {
        m += k;
    }
    s += 0.5_f32.powi(m);
    vec4(s, 0.0, 0.0, 1.0)
}

/// The first loop decides what the power is, the second and the third do not; a power is a compile-time constant.
pub fn culprit(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut power = 0;
    for i in 0..3 {
        power += i;
    }
    let mut s = n as f32;
    for j in 0..4 {
        s = s * 0.5 + color.load(pixel + ivec2(j, 0)).x;
    }
    for k in 0..3 {
        s += (s * 0.25).powi(power) * k as f32;
    }
    vec4(s, raised(s, power), 0.0, 1.0)
}

fn raised(x: f32, power: i32) -> f32 {
    let mut sum = 0.0;
    for j in 0..3 {
        sum += x.powi(power + 1) * j as f32;
    }
    sum
}

/// The value that must be constant comes from a loop in a function, and is in no variable.
pub fn called_culprit(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = n as f32;
    for j in 0..4 {
        s = s * 0.5 + color.load(pixel + ivec2(j, 0)).x;
    }
    vec4((0.25 * s).powi(power_of([1, 0, 2])), s, 0.0, 1.0)
}

fn power_of(list: [i32; 3]) -> i32 {
    let mut power = 0;
    for k in 0..3 {
        power += list[k];
    }
    power
}

/// The loop inside looks at the counter of the loop outside, through a closure and a condition.
pub fn outer_culprit(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).y + n as f32;
    for i in 1..3 {
        let power = |x: f32| x.powi(if i == 2 { 3 } else { 2 });
        for j in 0..3 {
            s += power(s * 0.25) * j as f32;
        }
    }
    vec4(s, 0.0, 0.0, 1.0)
}

pub fn bounds(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).x;
    for i in 0..n & 5 {
        s = s * 1.5 + i as f32;
    }
    for i in (n ^ 2)..(n | 8) {
        s = s * 1.5 + i as f32;
    }
    vec4(s, 0.0, 0.0, 1.0)
}

pub fn swapped(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut v = [c.x, c.y, 1.0];
    let mut w = [c.z, c.w, 2.0];
    for i in 0..5 {
        let t = v;
        v = w;
        w = t;
        v[i % 3] += n as f32;
    }
    vec4(v[0] + 0.5 * v[2], v[1], w[0] + 10.0 * w[2], w[1])
}

pub fn rotated(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut a = [c.x, c.y];
    let mut b = [c.z, c.w];
    let mut d = [1.0, n as f32];
    for i in 0..5 {
        let t = a;
        a = b;
        b = d;
        d = t;
        a[i & 1] *= 2.0;
        if c.x > 0.1 {
            let u = a;
            a = d;
            d = u;
        }
    }
    vec4(a[0], b[1], d[0] + 10.0 * d[1], a[1] + 10.0 * b[0])
}

pub fn old_versions(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut v = [c.x, c.y, 1.0];
    let mut w = [0.0, 1.0, 2.0];
    v[n.rem_euclid(3) as usize] = 7.0;
    let mut s = 0.0;
    for i in 0..6 {
        let old = v;
        v[i % 3] += w[0] + 1.0;
        w = v;
        v = old;
        w[(i + 1) % 3] += v[0];
        let mut t = v;
        t[i % 3] += 1.0;
        s += t[0] + 3.0 * t[1] + 5.0 * t[(i + 1) % 3];
    }
    if c.x > 0.1 {
        let mut t = v;
        t[n.rem_euclid(2) as usize] = 100.0;
        s += t[n.rem_euclid(3) as usize] + t[(n + 1).rem_euclid(3) as usize];
    }
    vec4(v[0] + v[1] + v[2], w[0] + 2.0 * w[1], w[2], s)
}

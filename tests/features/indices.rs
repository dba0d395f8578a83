//// `usize`: a table indexed by a hash
const SHADES: [f32; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];

pub fn usize_of_a_hash(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let hash = (pixel.x as u32 ^ (pixel.y as u32) << 7).wrapping_mul(0x9e37_79b9);
    let (three, five) = (hash as usize % 3, hash as usize % SHADES.len());
    let bits = hash as usize >> 29;
    color.load(pixel) * SHADES[five] + vec4(three as f32, bits as f32, (hash as usize / 1000) as f32, (hash as usize & 7) as f32)
}

//// `usize`: a test of a range by one comparison
pub fn usize_of_a_border(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (x, y) = (pixel.x - 3, pixel.y - 2);
    let size = color.size();
    let inside = (x as usize) < size.x as usize && (y as usize) < size.y as usize;
    let outside = x as usize >= 6;
    let first = (x as usize).min(y as usize) == x as usize;
    let held = (x as usize).clamp(1, 4);
    let here = if inside { color.load(ivec2(x, y)) } else { Vec4::ZERO };
    here + vec4(outside as u32 as f32, first as u32 as f32, held as f32, (x as usize != y as usize) as u32 as f32)
}

//// `usize`: indices below 0 and beyond the end
pub fn usize_beyond(weights: &Buffer<f32>, pixel: IVec2) -> Vec4 {
    let before = (pixel.x - 4) as usize;
    let far = (pixel.y as u32).wrapping_mul(0x4000_0001) as usize;
    let table = [0.5, 0.25, 0.125];
    let (found, none) = (table.get(before).copied().unwrap_or(2.0), table.get(far).copied().unwrap_or(3.0));
    vec4(weights.load(before), weights.load(far), found, none)
}

//// `usize`: sums and products of indices
pub fn usize_of_sums(weights: &Buffer<f32>, ids: &Frame<u32>, pixel: IVec2) -> Vec4 {
    let (x, y) = (pixel.x as usize, pixel.y as usize);
    let base = ids.load(pixel) as usize;
    let sum = weights.load(base + x) + weights.load(base * 3 + 1) + weights.load(y * 13 + x);
    let signed = weights.load(((pixel.x - 6) as usize).wrapping_mul(2));
    vec4(sum, signed, (x * y + 1) as f32, ((x + 7) % 3) as f32)
}

//// `usize`: arithmetic that wraps
pub fn usize_wrapping(pixel: IVec2) -> Vec4 {
    let mut h = pixel.x as usize;
    for k in 0..4 {
        h = h.wrapping_mul(0x0100_0193).wrapping_add(pixel.y as usize ^ k);
    }
    let back = (pixel.x as usize).wrapping_sub(3);
    let turned = !(pixel.y as usize);
    let negative = (pixel.x as usize).wrapping_neg();
    vec4(
        (h % 16) as f32 + (h as u32 >> 8) as f32,
        (back < 5) as u32 as f32 + (back & 0xff) as f32,
        (turned as u32 >> 4) as f32,
        (negative as i32) as f32,
    )
}

//// `usize::MAX` as what no index is
pub fn usize_none(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut best = usize::MAX;
    for k in 0..4 {
        if color.load(pixel + ivec2(k as i32, 0)).x > 0.5 && k < best {
            best = k;
        }
    }
    let sentinel = (-1_i32) as usize;
    let none = best == sentinel;
    let index = if none { 7 } else { best };
    vec4(none as u32 as f32, index as f32, (best > 3) as u32 as f32, best.min(9) as f32)
}

//// `usize`: floats as indices
pub fn usize_of_floats(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let table = [0.0, 0.25, 0.5, 0.75, 1.0];
    let here = color.load(pixel);
    let k = (here.x * 3.99) as usize;
    let mixed = table[k] + (table[k + 1] - table[k]) * 0.5;
    let large = (here.y * 1.0e12) as usize;
    let below = ((here.z - 0.5) * 8.0) as usize;
    let (rest, even) = (large % 36, large % 8);
    let bin = (here.w * 9.0) as usize % 7 + ((here.z - 0.75) * 1.0e20) as usize % 1000;
    let bits = ((here.y * 7.0e9) as usize as u32 & 0xff) + ((here.x * 6.0e9) as usize & 0x7f) as u32;
    vec4(mixed + bits as f32, large as f32 * 1.0e-6 + rest as f32, below as f32 + even as f32, large.min(40) as f32 + bin as f32)
}

//// `usize`: a ring of values
pub fn usize_of_a_ring(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    const N: usize = 5;
    let mut ring = [0.0; N];
    let mut head = 0_usize;
    for k in 0..taps + 6 {
        ring[head] = color.load(pixel + ivec2(k, 0)).x;
        head = (head + 1) % N;
    }
    let last = (head + N - 1) % N;
    let before = (head + N - 3) % N;
    vec4(ring[last], ring[before], head as f32, ((head + 2) % 3) as f32)
}

//// `usize`: what is counted
pub fn usize_counted(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let (mut bright, mut steps) = (0_usize, 0);
    for k in 0..taps as usize + 2 {
        if color.load(pixel + ivec2(k as i32, 0)).y > 0.25 {
            bright += 1;
        }
        steps += k * 2 % 3;
    }
    vec4(bright as f32, (bright % 3) as f32, (steps / 2) as f32, (bright.is_multiple_of(2)) as u32 as f32)
}

//// `usize`: ranges with runtime ends
pub fn usize_ranges(taps: i32, pixel: IVec2) -> Vec4 {
    let (n, first) = (taps as usize, pixel.x as usize % 3);
    let mut sums = [0.0; 4];
    for k in (0..n).rev() {
        sums[0] = sums[0] * 0.5 + k as f32;
    }
    for k in (first..n + 4).step_by(2) {
        sums[1] += (k % 3) as f32;
    }
    for k in first..=n {
        sums[2] += (k / 2) as f32;
    }
    for k in (0..pixel.y as usize).rev().step_by(3) {
        sums[3] += k as f32;
    }
    Vec4::from_array(sums)
}

//// Methods of `usize`
pub fn usize_methods(ids: &Frame<u32>, pixel: IVec2) -> Vec4 {
    let (a, b) = (pixel.x as usize, pixel.y as usize + 1);
    let h = ids.load(pixel) as usize;
    let less = a.checked_sub(b).map_or(9, |d| d + 1);
    let more = h.checked_add(a).is_some() as usize;
    let differ = a.abs_diff(b) + a.saturating_sub(b) + a.saturating_add(b);
    let whole = h.div_ceil(7) % 11 + h.rem_euclid(5) + h.div_euclid(1000) % 3 + a.midpoint(b);
    let bits = h.count_ones() as usize + b.is_power_of_two() as usize;
    vec4(less as f32 + more as f32, differ as f32, whole as f32, bits as f32 + a.pow(2) as f32)
}

//// `swap`, `reverse` and `fill` of arrays and slices
fn sorted(list: &mut [f32; 4]) {
    for j in 0..3 {
        for k in 0..3 - j {
            if list[k] > list[k + 1] {
                list.swap(k, k + 1);
            }
        }
    }
}

pub fn array_swaps(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut list = color.load(pixel).to_array();
    sorted(&mut list);
    let mut turned = [list[0], list[1], list[2]];
    turned.reverse();
    let (a, b) = ((pixel.x & 3) as usize, (pixel.y & 3) as usize);
    list.swap(a, b);
    let mut same = [0.0; 3];
    same.fill(turned[0]);
    same.swap(0, 2);
    vec4(list[0] + same[2], list[1] + turned[1], list[2] * 2.0, list[3])
}

//// `rem_euclid` and `div_euclid` of vectors
pub fn euclidean_vectors(pixel: IVec2) -> Vec4 {
    let moved = pixel - ivec2(6, 5);
    let (rest, whole) = (moved.rem_euclid(IVec2::splat(5)), moved.div_euclid(ivec2(3, -4)));
    let other = moved.rem_euclid(ivec2(-3, 2));
    vec4(rest.x as f32, rest.y as f32, (whole.x * 10 + whole.y) as f32, (other.x * 10 + other.y) as f32)
}

//// Vectors of integers: `dot`, `length_squared`, `distance_squared`
pub fn integer_products(pixel: IVec2) -> Vec4 {
    let a = pixel - ivec2(4, 3);
    let unsigned = (pixel + 2).as_uvec2();
    let [x, y]: [i32; 2] = a.into();
    let (u, v): (u32, u32) = unsigned.into();
    vec4(
        a.dot(ivec2(3, -2)) as f32,
        a.length_squared() as f32 + unsigned.dot(unsigned) as f32,
        a.distance_squared(pixel.yx()) as f32,
        (x * 7 + y) as f32 + (u * 3 + v) as f32,
    )
}

//// `f32::midpoint`
pub fn midpoints(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let large = f32::MAX * (1.0 - here.x * 0.5);
    vec4(here.x.midpoint(here.y), (large.midpoint(f32::MAX) / 1.0e30).floor(), here.z.midpoint(-here.z), 3_u32.midpoint(8) as f32)
}

//// Arrays of functions indexed at run time
fn doubled(x: f32) -> f32 {
    x * 2.0
}

fn negated(x: f32) -> f32 {
    -x
}

pub fn functions_at_run_time(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let two: [fn(f32) -> f32; 2] = [doubled, negated];
    let three: [fn(f32) -> f32; 3] = [negated, |x| x + 1.0, doubled];
    let here = color.load(pixel);
    vec4(two[(pixel.x & 1) as usize](here.x), three[(pixel.y % 3) as usize](here.y), here.z, here.w)
}

//// Assignments that leave parts out, and variables declared together
struct Pair(f32, f32);

struct Named {
    near: f32,
    far: f32,
}

pub fn parts_left_out(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let (mut a, b): (f32, f32);
    (a, b) = (here.x, here.y);
    let (c, d, e);
    (c, .., d) = (here.z, 1.0, 2.0, here.w);
    (a, ..) = (a + 1.0, 3.0);
    Pair(e, _) = Pair(a * 2.0, b);
    let f;
    Named { far: f, near: _ } = Named { near: b, far: e + d };
    vec4(a, b + c, e, f)
}

//// Functions by other names, `_` among generic arguments, `None::<T>`
mod inside {
    pub fn turned(x: u32) -> u32 {
        x ^ 5
    }
}

fn scaled<const N: usize, const BY: u32>(v: [u32; N]) -> u32 {
    v[N - 1] * BY
}

fn first<T: Copy, const N: usize>(v: [T; N], other: T) -> T {
    if N > 1 { v[0] } else { other }
}

pub fn other_names(ids: &Frame<u32>, pixel: IVec2) -> Vec4 {
    use inside::turned as renamed;
    let id = ids.load(pixel) >> 4;
    let none = None::<u32>.unwrap_or(id & 7) + Option::<u32>::None.unwrap_or(2);
    let scaled = scaled::<_, 3>([id & 3, 1, id & 15]);
    vec4((renamed(id) & 0xff) as f32, none as f32, scaled as f32, first::<_, 2>([id & 1, 4], 9) as f32)
}

//// Functions of the kernel's that are named as those of Rust and glam
fn min(a: f32, _: f32) -> f32 {
    a * 8.0
}

fn from_fn(x: f32) -> f32 {
    x + 2.0
}

fn halved<const N: usize>(v: [f32; N]) -> [f32; N] {
    std::array::from_fn(|k| v[k] * 0.5)
}

pub fn names_of_rust(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let [a, b, ..] = halved(here.to_array());
    vec4(f32::min(here.x, here.y), min(here.x, here.y), from_fn(a), Vec4::min(here, Vec4::splat(b)).z)
}

//// `Mat3::from_cols_array` and its like, `IVec2::NEG_X`, `Vec2::INFINITY`
pub fn matrices_of_arrays(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    const TURN: Mat3 = Mat3::from_cols_array(&[0.5, 0.25, 0.0, -1.0, 2.0, 0.75, 0.125, 0.0, 1.0]);
    let small = Mat2::from_cols_array_2d(&[[1.0, 2.0], [3.0, 4.0]]);
    let here = color.load(pixel);
    let turned = TURN * here.truncate();
    let back = small.to_cols_array();
    let beside = pixel + IVec2::NEG_X + IVec2::NEG_ONE * 2;
    let least = Vec2::INFINITY.min(here.xy()) + Vec2::NEG_INFINITY.max(here.zw()) + Vec2::NEG_Y;
    vec4(turned.x + turned.y, turned.z + back[1], (beside.x * 3 + beside.y) as f32, least.x - least.y)
}

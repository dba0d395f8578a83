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

//// Arrays of structures changed in loops with runtime bounds
struct G { sum: f32, n: f32 }
pub fn structures_in_loops(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut g = [G { sum: 0.0, n: 0.0 }, G { sum: 1.0, n: 0.0 }];
    for x in 0..taps {
        g[0].sum += color.load(pixel + ivec2(x, 0)).x;
        g[1].n += 1.0;
    }
    vec4(g[0].sum, g[1].n, g[1].sum, 1.0)
}

//// Arrays of structures changed at run time
#[derive(Clone, Copy, Default)]
struct Bin { count: u32, sum: Vec3, best: Best }
#[derive(Clone, Copy, Default)]
struct Best { value: f32, at: IVec2 }
pub fn structures_by_bins(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut bins = [Bin::default(); 6];
    for y in 0..taps {
        for x in -taps..=taps {
            let c = color.load(pixel + ivec2(x, y));
            let k = (c.x * 5.99) as usize;
            let bin = &mut bins[k];
            bin.count += 1;
            bin.sum += c.truncate();
            if c.y > bin.best.value {
                bin.best = Best { value: c.y, at: ivec2(x, y) };
            }
        }
    }
    let mut top = bins[0];
    for bin in bins.iter().skip(1) {
        if bin.count > top.count { top = *bin; }
    }
    let m = top.sum / top.count.max(1) as f32;
    vec4(m.x, m.y, top.best.value, (top.best.at.x * 10 + top.best.at.y) as f32)
}

//// Structures in an array: whole, by `&mut`, by components, and with some fields of another
#[derive(Clone, Copy)]
struct S { x: f32, at: Vec3, n: i32 }
pub fn structures_written(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut a = [S { x: 0.5, at: Vec3::ONE, n: 1 }; 4];
    a[(pixel.x & 3) as usize].x = 3.0;
    a[(pixel.y & 3) as usize].at.y += 2.0;
    let k = ((pixel.x + pixel.y) & 3) as usize;
    a[k].n -= 3;
    a[k].at[(pixel.x & 1) as usize] *= 0.25;
    let b = a[(pixel.x & 1) as usize];
    a[3] = b;
    a[k] = S { x: 9.0, ..a[0] };
    vec4(a[0].x + a[3].x, a[1].at.y + a[2].at.x, a[k].n as f32 + b.x, a[2].x)
}

//// Structures in an array: swapped and sorted
#[derive(Clone, Copy, PartialEq)]
struct Hit { t: f32, id: u32 }
pub fn structures_sorted(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut hits = [Hit { t: 9.0, id: 99 }; 5];
    let mut n = 0;
    for k in 0..taps {
        let c = color.load(pixel + ivec2(k, k));
        if c.x > 0.3 {
            hits[n] = Hit { t: c.x, id: k as u32 };
            n += 1;
        }
    }
    for i in 1..n {
        let mut j = i;
        while j > 0 && hits[j - 1].t > hits[j].t {
            hits.swap(j - 1, j);
            j -= 1;
        }
    }
    let mut out = Vec4::ZERO;
    for (k, hit) in hits.iter().enumerate() {
        if *hit == hits[0] { out.w += 1.0; }
        out.x += hit.t * (k + 1) as f32;
    }
    out.y = hits[0].id as f32;
    out.z = hits[1].t;
    out
}

//// Arrays of arrays changed at run time
pub fn rows_changed(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut m = [[0.0f32; 4]; 3];
    for k in 0..taps {
        let c = color.load(pixel + ivec2(k, 0));
        let (i, j) = (k as u32 as usize % 3, (k & 3) as usize);
        m[i][j] += c.x;
        m[(i + 1) % 3][2] -= c.y;
        m[1][j] *= 0.5;
        let row = m[j % 3];
        m[i] = row;
        m[2] = [c.z, row[0], row[1] + row[i], 1.0];
        for r in m.iter_mut() { r[j] += 0.125; }
    }
    let s: f32 = m.iter().map(|r| r.iter().sum::<f32>()).sum();
    vec4(m[0][1], m[1][(pixel.x & 3) as usize], m[(pixel.y & 1) as usize][3], s)
}

//// Arrays of tuples changed at run time
pub fn tuples_stacked(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut stack = [(0u32, 0.0f32, ivec2(0, 0)); 8];
    let mut top = 1i32;
    stack[0] = (3, 1.0, pixel);
    let mut sum = 0.0;
    let mut steps = 0;
    while top > 0 && steps < 20 {
        top -= 1;
        steps += 1;
        let (depth, w, at) = stack[top as usize];
        let c = color.load(at);
        sum += c.x * w;
        if depth > 0 && top + 2 <= 8 {
            stack[top as usize] = (depth - 1, w * 0.5, at + ivec2(1, 0));
            top += 1;
            if c.y > 0.4 {
                stack[top as usize] = (depth - 1, w * 0.25, at + ivec2(0, taps));
                top += 1;
            }
        }
    }
    vec4(sum, steps as f32, stack[1].1, stack[2].0 as f32)
}

//// Arrays of enums changed at run time
#[derive(Clone, Copy)]
enum Cell { Empty, Wall(f32), Light { c: Vec3, id: i32 } }
pub fn cells_changed(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut cells = [Cell::Empty; 4];
    for k in 0..taps {
        let c = color.load(pixel + ivec2(k, 1));
        let at = (c.z * 3.99) as usize;
        cells[at] = if c.x > 0.5 { Cell::Wall(c.y) } else { Cell::Light { c: c.truncate(), id: k } };
        if let Cell::Wall(h) = &mut cells[(k & 3) as usize] { *h += 0.5; }
    }
    let mut out = Vec4::ZERO;
    for cell in cells {
        match cell {
            Cell::Empty => out.w += 1.0,
            Cell::Wall(h) => out.x += h,
            Cell::Light { c, id } => { out.y += c.x; out.z += id as f32; }
        }
    }
    out
}

//// Arrays of matrices and of options changed at run time
pub fn matrices_changed(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut ms = [Mat2::IDENTITY; 3];
    let mut best: [Option<f32>; 3] = [None; 3];
    for k in 0..taps {
        let c = color.load(pixel + ivec2(0, k));
        let i = k as u32 as usize % 3;
        ms[i] = ms[i] * Mat2::from_cols(c.xy(), c.zw());
        ms[(i + 1) % 3].x_axis.y += 0.25;
        if c.x > 0.25 { best[(c.y * 2.99) as usize] = Some(c.x); }
    }
    let v = ms[(pixel.x % 3) as usize] * vec2(1.0, 2.0);
    vec4(v.x, v.y, best[0].unwrap_or(-1.0), best[(pixel.y % 3) as usize].map_or(7.0, |x| x * 2.0))
}

//// Arrays in structures in arrays
#[derive(Clone, Copy)]
struct P { w: [[f32; 2]; 2], t: (f32, [Vec2; 2]) }
pub fn structures_of_arrays(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut ps = [P { w: [[0.0; 2]; 2], t: (1.0, [Vec2::ZERO; 2]) }; 3];
    for k in 0..taps {
        let c = color.load(pixel + ivec2(k, -k));
        let (i, j, l) = (k as u32 as usize % 3, (k & 1) as usize, (c.x * 1.99) as usize);
        ps[i].w[j][l] += c.y;
        ps[i].t.1[l].y = c.z;
        ps[l].t.0 *= 0.5;
        let copy = ps[i].w[l];
        ps[(i + 1) % 3].w[j] = copy;
        ps[2].w = ps[i].w;
    }
    let p = &ps[(pixel.x % 3) as usize];
    vec4(p.w[0][1] + p.w[1][0], p.t.0, p.t.1[(pixel.y & 1) as usize].y, ps[2].w[1][1])
}

//// Arrays of structures behind methods and `&mut`
#[derive(Clone, Copy)]
struct Node { value: f32, kids: [f32; 3] }
struct Tree { nodes: [Node; 5], used: usize }
impl Tree {
    fn push(&mut self, value: f32) -> &mut Node {
        let k = self.used % 5;
        self.used += 1;
        self.nodes[k].value = value;
        &mut self.nodes[k]
    }
    fn node(&self, k: usize) -> &Node { &self.nodes[k] }
}
fn bump(x: &mut f32, by: f32) { *x += by; }
pub fn nodes_of_a_tree(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut tree = Tree { nodes: [Node { value: 0.0, kids: [0.0; 3] }; 5], used: 0 };
    for k in 0..taps + 2 {
        let c = color.load(pixel + ivec2(k, 0));
        let n = tree.push(c.x);
        n.kids[(c.y * 2.99) as usize] += c.z;
        bump(&mut tree.nodes[(k % 4) as usize].value, 0.5);
        bump(&mut tree.nodes[(k % 4) as usize].kids[(k % 3) as usize], c.w);
    }
    let n = tree.node((pixel.x % 5) as usize);
    vec4(n.value, n.kids[0] + n.kids[2], tree.nodes[2].kids[1], tree.used as f32)
}

//// Arrays of arrays of booleans: a cellular automaton
pub fn cells_of_a_grid(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut g = [[false; 4]; 4];
    for y in 0..4 { for x in 0..4 { g[y][x] = color.load(pixel + ivec2(x as i32, y as i32)).x > 0.5; } }
    for _ in 0..taps {
        let old = g;
        let mut any = false;
        for y in 0..4usize {
            for x in 0..4usize {
                let mut n = 0;
                for (dy, dx) in [(0usize, 1usize), (1, 0), (1, 1), (3, 0), (0, 3), (3, 3)] {
                    if old[(y + dy) % 4][(x + dx) % 4] { n += 1; }
                }
                g[y][x] = n == 3 || (old[y][x] && n == 2);
                any |= g[y][x];
            }
        }
        if !any { break; }
    }
    let mut s = 0.0;
    for row in &g { for c in row { s = s * 0.5 + if *c { 1.0 } else { 0.0 }; } }
    vec4(s, 0.0, 0.0, 1.0)
}

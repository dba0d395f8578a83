//// Slices of arrays: `&a[1..3]`, `&a[..2]`, `&a[2..]`, `a[..k].iter()`
fn mean_of(list: &[f32]) -> f32 {
    list.iter().sum::<f32>() / list.len() as f32
}

const SLICED: [f32; 6] = [0.1, 0.2, 0.4, 0.8, 0.3, 0.6];

pub fn slices_of_arrays(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let all = [here.x, here.y, here.z, here.w, 0.5];
    let mut sum = 0.0;
    for x in &all[1..4] {
        sum += *x * 0.5;
    }
    for (k, x) in all[..=2].iter().enumerate() {
        sum += x * k as f32;
    }
    for k in 1..3 {
        sum += all[..k].iter().sum::<f32>() - mean_of(&all[k..]);
    }
    let tail = &SLICED[2..];
    let at = tail[(pixel.x & 3) as usize] + (&tail[1..=2])[(pixel.y & 1) as usize] + SLICED[4..][1];
    for x in &tail[1..][..2] {
        sum += x;
    }
    let like = all[..2] == all[1..3] || all[3..] != [0.0, 0.5];
    let whole = &all[..];
    vec4(sum, at, mean_of(&[0.5, 0.25, taps as f32][..2]) + whole[(pixel.x & 1) as usize], like as u32 as f32)
}

//// Slices that change: `&mut a[1..]`, `copy_from_slice` between them
fn halve(list: &mut [f32]) {
    for x in list.iter_mut() {
        *x *= 0.5;
    }
}

fn put(list: &mut [f32], k: usize, x: f32) {
    list[k] += x;
    if list.len() > 2 {
        put(&mut list[1..], k, x * 0.5);
    }
}

pub fn slices_that_change(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut all = [here.x, here.y, here.z, here.w, 0.5, 0.75];
    let mut others = [0.0; 4];
    others[1..3].copy_from_slice(&all[2..4]);
    others[3..].fill(taps as f32);
    halve(&mut all[1..]);
    for x in &mut all[..2] {
        *x += 1.0;
    }
    for (x, y) in all[3..].iter_mut().zip(&others[1..]) {
        *x += *y;
    }
    put(&mut all[2..], (pixel.x & 1) as usize, 0.25);
    let middle = &mut all[1..5];
    middle.swap(0, 3);
    middle[1..].reverse();
    middle[2] += middle[(pixel.y & 3) as usize];
    all[2..].sort_unstable_by(|a, b| a.total_cmp(b));
    let whole: f32 = all.iter().sum();
    vec4(whole + others[2], all[(pixel.x & 3) as usize], others[3], all[5])
}

//// Slices of arrays that loops with runtime bounds change
#[derive(Clone, Copy, Default)]
struct Sliced {
    weight: f32,
    color: Vec3,
}

pub fn slices_in_loops(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut bins = [Sliced::default(); 5];
    let mut sums = [0.0_f32; 5];
    let mut rows = [[0_u32; 3]; 2];
    for k in -taps..=taps {
        let tap = color.load(pixel + ivec2(k, 0));
        for x in &mut sums[1..] {
            *x += tap.x;
        }
        let bin = &mut bins[1..4][(tap.y * 2.99) as usize];
        bin.weight += 1.0;
        bin.color += tap.truncate();
        sums[..2][(k & 1) as usize] += tap.z;
        rows[(k & 1) as usize][1..][(k >> 1 & 1) as usize] += 1;
    }
    let first = &bins[2..];
    let one = &first[(pixel.x & 1) as usize];
    let counted = rows[(pixel.y & 1) as usize][1..].iter().sum::<u32>() + rows[1][..2].iter().max().copied().unwrap_or(0);
    vec4(
        sums[2..].iter().sum::<f32>() + one.color.x,
        first.iter().map(|bin| bin.weight).fold(0.0, f32::max),
        sums[..2][(pixel.y & 1) as usize],
        counted as f32,
    )
}

//// Slices in patterns
pub fn slices_in_patterns(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut all = [here.x, here.y, here.z, here.w];
    let sum = match &all[1..3] {
        [a, b] => a + b * 2.0,
        _ => 0.0,
    };
    if let [first, .., last] = &mut all[1..] {
        *first += 1.0;
        *last *= 0.5;
    }
    let known = match all[..2] {
        [a, b] if a < b => b,
        [a, ..] => a,
        [] => 0.0,
    };
    vec4(sum, all[1], all[3], known)
}

//// Axes of vectors: `IVec3::AXES[1]`
pub fn axes_of_vectors(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for axis in &Vec2::AXES[..] {
        sum += color.load(pixel + axis.as_ivec2()) * (axis.x + 0.5);
    }
    let step = IVec3::AXES[1] + IVec3::AXES[(pixel.x & 1) as usize] + UVec3::AXES[2].as_ivec3();
    sum + step.as_vec3().extend(Vec4::AXES.len() as f32)
}

//// Ranges in variables that take slices
pub fn slices_by_ranges(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel).to_array();
    let (inner, last) = (1..3, 2..=3);
    let sum: f32 = here[inner].iter().sum();
    vec4(sum, here[last][(pixel.x & 1) as usize], 0.0, 1.0)
}

//// Parts of slices: `split_at`, `split_first`, `split_last`
fn weighed(list: &[f32]) -> f32 {
    match list.split_first() {
        Some((first, rest)) => first + 0.5 * weighed(rest),
        None => 0.0,
    }
}

pub fn parts_of_slices(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel).to_array();
    let (head, tail) = here.split_at(1);
    let outer = here.as_slice().split_last().map_or(0.0, |(last, rest)| last - rest.iter().sum::<f32>());
    let known = here.split_at_checked(3).is_some() && here.split_at_checked(5).is_none();
    let (low, high) = tail.split_at(tail.len() / 2);
    vec4(head[0] + tail[(pixel.x & 1) as usize], weighed(&here), outer, low[0] * high[1] + known as u32 as f32)
}

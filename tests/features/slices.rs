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

//// Mutable parts of arrays: `chunks_mut`, `split_at_mut`, `split_first_mut`, `get_mut`
fn halves(list: &mut [f32]) -> (&mut [f32], &mut [f32]) {
    let middle = list.len() / 2;
    list.split_at_mut(middle)
}

fn place(list: &mut [f32; 6], k: usize) -> Option<&mut f32> {
    if k < 6 { Some(&mut list[k]) } else { None }
}

pub fn mutable_parts(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut all = [here.x, here.y, here.z, here.w, 0.5, 0.25];
    for k in 0..taps.clamp(0, 6) as usize {
        all[k] += 0.125 * k as f32;
    }
    for pair in all.chunks_exact_mut(2) {
        pair.swap(0, 1);
        pair[(pixel.x & 1) as usize] += 1.0;
    }
    for (k, part) in all.chunks_mut(4).enumerate() {
        part[0] += k as f32;
        for x in part.iter_mut() {
            *x *= 2.0;
        }
    }
    let (left, right) = halves(&mut all);
    for (x, y) in left.iter_mut().zip(right.iter()) {
        *x += *y;
    }
    for (x, y) in left.iter_mut().rev().zip(right) {
        std::mem::swap(x, y);
    }
    left[(pixel.y % 3) as usize] += 0.5;
    if let Some((first, rest)) = all.split_first_mut() {
        *first = 2.0;
        rest[0] += *first;
    }
    if let Some((last, rest)) = all.split_last_mut() {
        *last *= 2.0;
        rest[1] = *last;
    }
    if let Some(x) = all.first_mut() {
        *x += here.x;
    }
    *all.last_mut().unwrap() -= 0.25;
    if let Some(x) = all.get_mut((pixel.x & 7) as usize) {
        *x += 8.0;
    }
    if let Some(x) = place(&mut all, 2) {
        *x *= 0.5;
    }
    vec4(all[0] + all[1], all[2], all[3] + all[4], all[5])
}

//// Mutable iterators: `rev`, `enumerate`, `zip`, `skip`, `step_by`, `take`, `for_each`, `filter`
pub fn mutable_iterators(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut all = [here.x, here.y, here.z, here.w, 0.5];
    for (k, x) in all.iter_mut().rev().enumerate() {
        *x += k as f32;
    }
    for x in all.iter_mut().skip(1).step_by(2) {
        *x *= 0.5;
    }
    for (x, by) in all.iter_mut().zip([1.0, 2.0, 3.0]) {
        *x *= by;
    }
    for x in all.iter_mut().take(2) {
        *x -= 0.25;
    }
    for (k, x) in all.iter_mut().enumerate().skip(2) {
        *x += k as f32 * 0.5;
    }
    all.iter_mut().enumerate().for_each(|(k, x)| *x += k as f32);
    for x in all.iter_mut().filter(|x| **x > 3.0) {
        *x *= 0.5;
    }
    let mut grid = [[0.0; 3]; 2];
    for (y, row) in grid.iter_mut().enumerate() {
        for (x, cell) in row.iter_mut().enumerate() {
            *cell = (x + y * 3) as f32 * here.x;
        }
    }
    all.rotate_left(2);
    all[1..].rotate_right(1);
    all[..3].swap_with_slice(&mut grid[1]);
    let mut held = here.y;
    let kept = Some(&mut held);
    if let Some(x) = kept {
        *x += 1.0;
    }
    vec4(all[0] + all[1], all[2] + grid[1][2], all[3] + all[4], held)
}

//// Derived `Ord`: `max`, `min`, `clamp` and `cmp` of structures, enums, tuples, arrays and options
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Ranked { level: i32, id: u32 }

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Layer { Sky = 5, Ground = -2, Water = 1 }

fn layer(k: i32) -> Layer {
    [Layer::Sky, Layer::Ground, Layer::Water][k.rem_euclid(3) as usize]
}

pub fn orders_derived(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = Ranked { level: (color.load(pixel).x * 4.0) as i32, id: pixel.x as u32 };
    let next = Ranked { level: (color.load(pixel + ivec2(1, 0)).x * 4.0) as i32, id: 3 };
    let most = here.max(next).min(Ranked { level: taps, id: 7 });
    let held = here.clamp(Ranked { level: 1, id: 0 }, Ranked { level: 2, id: 5 });
    let order = match here.cmp(&next) {
        std::cmp::Ordering::Less => 1.0,
        std::cmp::Ordering::Equal => 2.0,
        std::cmp::Ordering::Greater => 3.0,
    };
    let front = layer(pixel.x).max(layer(pixel.y));
    let (low, high) = ((pixel.x, 3_u32).min((pixel.y, 2)), [pixel.y, 4].max([pixel.x, pixel.y]));
    let some = (pixel.x > 3).then_some(pixel.y).max(Some(2));
    let larger = std::cmp::max(here.level, next.level) + std::cmp::min(here, next).level;
    vec4(
        most.level as f32 + most.id as f32 * 0.25,
        held.level as f32 + held.id as f32 + order,
        front as i32 as f32 + some.unwrap_or(0) as f32,
        (low.0 + low.1 as i32 + high[0] * 2 + high[1] + larger) as f32,
    )
}

//// `PartialOrd` and `Ord` written by hand
use std::cmp::Ordering;

/// Ordered by brightness alone.
#[derive(Clone, Copy, PartialEq)]
struct Bright(Vec3);

impl Bright {
    fn luma(&self) -> f32 {
        self.0.dot(vec3(0.25, 0.5, 0.25))
    }
}

impl PartialOrd for Bright {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.luma().partial_cmp(&other.luma())
    }
}

/// The nearest first.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Depth { far: i32, id: u32 }

impl Ord for Depth {
    fn cmp(&self, other: &Self) -> Ordering {
        other.far.cmp(&self.far)
    }
}

impl PartialOrd for Depth {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The first part decides; of equal ones, the second.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Seen { depth: Depth, light: Bright }

pub fn orders_by_hand(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut depths = [0, 1, 2, 3].map(|k| {
        let tap = color.load(pixel + ivec2(k, 0));
        Depth { far: (tap.y * 6.0) as i32, id: k as u32 }
    });
    let (a, b) = (Bright(color.load(pixel).xyz()), Bright(color.load(pixel + ivec2(0, 1)).xyz()));
    let lit = if a < b { b } else { a };
    let unknown = Bright(Vec3::splat(color.load(pixel).x / 0.0 * 0.0));
    let known = (a >= b) as u32 + 2 * (a <= unknown) as u32 + 4 * unknown.partial_cmp(&a).is_some() as u32;
    let nearest = depths[0].max(depths[1]).max(depths[2]);
    let order = depths[1].cmp(&depths[2]).is_ge() as u32;
    let seen = Seen { depth: depths[0], light: a } > Seen { depth: depths[1], light: b };
    depths.sort();
    let last = depths.iter().max().copied().unwrap_or(nearest);
    vec4(lit.luma(), known as f32 + 8.0 * seen as u32 as f32, nearest.id as f32 + order as f32 * 4.0, (last.far * 4) as f32 + depths[0].id as f32)
}

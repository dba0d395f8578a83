//! Sampling: the arithmetic of [`Filter`], of smaller levels and of cubes.

use super::{Filter, Filterable, Sampler};
use glam::{IVec2, IVec3, UVec2, UVec3, Vec2, Vec3, Vec4};

/// Samples an image of `size` at `uv`. `texel` is called only with coordinates inside the image.
pub(in crate::prelude) fn sample<T: Filterable>(
    size: UVec2,
    sampler: &Sampler,
    uv: Vec2,
    texel: impl Fn(IVec2) -> T,
) -> T {
    filtered(sampler.filter, uv * size.as_vec2(), |coord| {
        texel(sampler.address.inside(coord, size))
    })
}

/// The four texels that a linear filter would weight: lower left, lower right, upper right, upper left.
pub(in crate::prelude) fn gather(size: UVec2, sampler: &Sampler, uv: Vec2, texel: impl Fn(IVec2) -> f32) -> Vec4 {
    let (corner, _) = footprint(uv * size.as_vec2());
    let tap = |x, y| texel(sampler.address.inside(corner + IVec2::new(x, y), size));
    Vec4::new(tap(0, 1), tap(1, 1), tap(1, 0), tap(0, 0))
}

/// Filters the texels around a position.
pub(super) fn filtered<T: Filterable>(filter: Filter, at: Vec2, texel: impl Fn(IVec2) -> T) -> T {
    match filter {
        Filter::Nearest => texel(at.floor().as_ivec2()),
        Filter::Linear => {
            let (corner, t) = footprint(at);
            let tap = |x, y| texel(corner + IVec2::new(x, y));
            let upper = tap(0, 0) * (1.0 - t.x) + tap(1, 0) * t.x;
            let lower = tap(0, 1) * (1.0 - t.x) + tap(1, 1) * t.x;
            upper * (1.0 - t.y) + lower * t.y
        }
    }
}

/// The upper left of the four texels around a position, and the weights of those to the right and below.
fn footprint(at: Vec2) -> (IVec2, Vec2) {
    let from = at - 0.5;
    let corner = from.floor();
    let far = IVec2::splat(FARTHEST);
    (corner.as_ivec2().clamp(-far, far), from - corner)
}

/// Limit of a texel's coordinate, so that its neighbour's coordinate does not overflow. All texels farther out are alike.
const FARTHEST: i32 = 1 << 30;

/// Samples a volume of `size` at `place`. `texel` is called only with coordinates inside the volume.
pub(super) fn sample_volume<T: Filterable>(
    size: UVec3,
    sampler: &Sampler,
    place: Vec3,
    texel: impl Fn(IVec3) -> T,
) -> T {
    let at = place * size.as_vec3();
    let texel = |coord: IVec3| texel(sampler.address.inside_volume(coord, size));
    match sampler.filter {
        Filter::Nearest => texel(at.floor().as_ivec3()),
        Filter::Linear => {
            let from = at.z - 0.5;
            let (slice, t) = (from.floor(), from - from.floor());
            let of = |z: i32| filtered(Filter::Linear, at.truncate(), |coord| texel(coord.extend(z)));
            let z = (slice as i32).clamp(-FARTHEST, FARTHEST);
            of(z) * (1.0 - t) + of(z + 1) * t
        }
    }
}

/// Samples a texture with `levels` levels at `level`; `read` samples one level. A level out of range is clamped to the nearest
/// level.
pub(super) fn between_levels<T: Filterable>(levels: usize, mip: Filter, level: f32, read: impl Fn(usize) -> T) -> T {
    let last = levels - 1;
    let level = level.max(0.0).min(last as f32);
    match mip {
        Filter::Nearest => read(((level + 0.5).ceil() - 1.0) as usize),
        Filter::Linear => {
            let finer = level.floor();
            let t = level - finer;
            let k = finer as usize;
            match t > 0.0 {
                true => read(k) * (1.0 - t) + read((k + 1).min(last)) * t,
                false => read(k),
            }
        }
    }
}

/// The level at which one step of the longer of `ddx` and `ddy` spans one texel of an image whose finest level has
/// `size`.
pub(super) fn level_of(size: UVec2, ddx: Vec2, ddy: Vec2) -> f32 {
    let size = size.as_vec2();
    (ddx * size).length().max((ddy * size).length()).log2()
}

/// The face of a cube that a direction points to, +X, -X, +Y, -Y, +Z, -Z, and the position on it from 0 to 1. On a
/// tie, Z precedes Y, and Y precedes X.
fn face(direction: Vec3) -> (usize, Vec2) {
    let size = direction.abs();
    let (face, s, t, major) = if size.z >= size.x && size.z >= size.y {
        match direction.z < 0.0 {
            true => (5, -direction.x, -direction.y, size.z),
            false => (4, direction.x, -direction.y, size.z),
        }
    } else if size.y >= size.x {
        match direction.y < 0.0 {
            true => (3, direction.x, -direction.z, size.y),
            false => (2, direction.x, direction.z, size.y),
        }
    } else {
        match direction.x < 0.0 {
            true => (1, direction.z, -direction.y, size.x),
            false => (0, -direction.z, -direction.y, size.x),
        }
    };
    (face, Vec2::new(0.5 * (s / major) + 0.5, 0.5 * (t / major) + 0.5))
}

/// The texel of the adjacent face at `coord` just outside `face`, for a cube with `n` texels a side.
fn beyond(face: usize, coord: IVec2, n: i32) -> (usize, IVec2) {
    // Direction of the texel's centre, in half texels.
    let (s, t) = (2 * coord.x + 1 - n, 2 * coord.y + 1 - n);
    let [x, y, z] = match face {
        0 => [n, -t, -s],
        1 => [-n, -t, s],
        2 => [s, n, t],
        3 => [s, -n, -t],
        4 => [s, -t, n],
        _ => [-s, -t, -n],
    };
    let (face, s, t, major) = if z.abs() > n {
        if z < 0 { (5, -x, -y, -z) } else { (4, x, -y, z) }
    } else if y.abs() > n {
        if y < 0 { (3, x, -z, -y) } else { (2, x, z, y) }
    } else if x < 0 {
        (1, z, -y, -x)
    } else {
        (0, -z, -y, x)
    };
    let texel = |v: i32| ((v + major) * n / (2 * major)).clamp(0, n - 1);
    (face, IVec2::new(texel(s), texel(t)))
}

/// Filters a cube of `n` texels a side in a direction. Texels beyond an edge are those of the adjacent face. Where
/// three faces meet there are only three texels, and their mean replaces the fourth.
pub(super) fn sample_cube<T: Filterable>(
    n: u32,
    filter: Filter,
    direction: Vec3,
    texel: impl Fn(usize, IVec2) -> T,
) -> T {
    let n = n as i32;
    let (face, uv) = face(direction);
    let at = uv * n as f32;
    if filter == Filter::Nearest {
        return texel(face, at.floor().as_ivec2().clamp(IVec2::ZERO, IVec2::splat(n - 1)));
    }
    let (corner, t) = footprint(at);
    let outside = |k: i32| k < 0 || k >= n;
    let tap = |x: i32, y: i32| {
        let coord = corner + IVec2::new(x, y);
        match (outside(coord.x), outside(coord.y)) {
            (false, false) => Some(texel(face, coord)),
            (true, true) => None,
            _ => {
                let (face, coord) = beyond(face, coord, n);
                Some(texel(face, coord))
            }
        }
    };
    let taps = [tap(0, 0), tap(1, 0), tap(0, 1), tap(1, 1)];
    // At most one tap lies beyond a corner.
    let mean = |missing: usize| {
        let other = |k: usize| taps[(missing + k) % 4];
        match (other(1), other(2), other(3)) {
            (Some(a), Some(b), Some(c)) => (a + b + c) * (1.0 / 3.0),
            _ => texel(face, corner.clamp(IVec2::ZERO, IVec2::splat(n - 1))),
        }
    };
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| taps[k].unwrap_or_else(|| mean(k)));
    let upper = a * (1.0 - t.x) + b * t.x;
    let lower = c * (1.0 - t.x) + d * t.x;
    upper * (1.0 - t.y) + lower * t.y
}

#[cfg(test)]
mod tests {
    use super::{Filter, filtered};
    use crate::prelude::Address;
    use glam::{UVec2, Vec2};

    #[test]
    fn places_beyond_all_numbers_read_the_border() {
        let size = UVec2::new(4, 2);
        let read = |filter, x: f32, address: Address| {
            filtered(filter, Vec2::new(x, 0.5), |at| address.inside(at, size).x as f32)
        };
        for far in [f32::INFINITY, f32::MAX, 3.0e9] {
            assert_eq!(read(Filter::Nearest, far, Address::Clamp), 3.0);
            assert_eq!(read(Filter::Nearest, -far, Address::Clamp), 0.0);
            for address in [Address::Clamp, Address::Repeat, Address::Mirror] {
                // A weight may be infinity minus infinity; the texels are still inside.
                read(Filter::Linear, far, address);
                read(Filter::Linear, -far, address);
            }
        }
    }
}

//! Cubes, as the prelude reads them natively.

use super::sampling::{apply_unary, floor, lerp_texels, linear_footprint};
use crate::ir::{BinaryOp, Real, UnaryOp};

/// Filters a cube of `n` texels a side in a direction; `texel` returns those inside by column, row and face. Texels beyond an edge are
/// those of the next face; where three faces meet, the missing fourth texel is the mean of the three.
pub fn filter_cube<R: Real>(
    n: u32,
    linear: bool,
    direction: [R; 3],
    texel: impl Fn(u32, u32, u32) -> [R; 4],
) -> [R; 4] {
    let side = i64::from(n);
    let (face, uv) = project_to_face(direction);
    let at = uv.map(|v| v * R::from_f64(n.into()));
    let inside = |at: [i64; 2]| {
        let [x, y] = at.map(|k| k.clamp(0, side - 1) as u32);
        texel(x, y, face)
    };
    if !linear {
        return inside(at.map(|v| floor(v).to_f64() as i64));
    }
    let ([x, y], [tx, ty]) = linear_footprint(at);
    let outside = |k: i64| k < 0 || k >= side;
    let tap = |dx: i64, dy: i64| {
        let (x, y) = (x + dx, y + dy);
        match (outside(x), outside(y)) {
            (false, false) => Some(texel(x as u32, y as u32, face)),
            (true, true) => None,
            _ => {
                let (face, [x, y]) = texel_beyond_edge(face, [x, y], side);
                Some(texel(x, y, face))
            }
        }
    };
    let taps = [tap(0, 0), tap(1, 0), tap(0, 1), tap(1, 1)];
    // At most one lies beyond a corner.
    let mean = |missing: usize| {
        let other = |k: usize| taps[(missing + k) % 4];
        match (other(1), other(2), other(3)) {
            (Some(a), Some(b), Some(c)) => {
                let third = R::from_f64(f64::from(1.0f32 / 3.0));
                [0, 1, 2, 3].map(|k| (a[k] + b[k] + c[k]) * third)
            }
            _ => inside([x, y]),
        }
    };
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| taps[k].unwrap_or_else(|| mean(k)));
    lerp_texels(lerp_texels(a, b, tx), lerp_texels(c, d, tx), ty)
}

/// The face that a direction points to, +X, -X, +Y, -Y, +Z, -Z, and the place on it from 0 to 1.
fn project_to_face<R: Real>([x, y, z]: [R; 3]) -> (u32, [R; 2]) {
    let zero = R::from_f64(0.0);
    let [across, up, along] = [x, y, z].map(|v| apply_unary(UnaryOp::Abs, v));
    let minus = |v: R| apply_unary(UnaryOp::Neg, v);
    let (face, s, t, major) = if along >= across && along >= up {
        if z < zero {
            (5, minus(x), minus(y), along)
        } else {
            (4, x, minus(y), along)
        }
    } else if up >= across {
        if y < zero { (3, x, minus(z), up) } else { (2, x, z, up) }
    } else if x < zero {
        (1, z, minus(y), across)
    } else {
        (0, minus(z), minus(y), across)
    };
    let half = R::from_f64(0.5);
    let over = |v: R| v.binary(BinaryOp::Div, major).unwrap_or(v);
    (face, [s, t].map(|v| half * over(v) + half))
}

/// The texel that lies where a face has one just outside: of the face beyond that edge.
fn texel_beyond_edge(face: u32, [x, y]: [i64; 2], n: i64) -> (u32, [u32; 2]) {
    // The direction of its middle, in halves of a texel.
    let (s, t) = (2 * x + 1 - n, 2 * y + 1 - n);
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
    (
        face,
        [s, t].map(|v| ((v + major) * n / (2 * major)).clamp(0, n - 1) as u32),
    )
}

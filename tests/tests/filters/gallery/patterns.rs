//! Definitions of the patterns.

use super::world::{World, interleaved};
use glam::{DVec2, DVec3, DVec4};

/// z ← z² + c until it is farther than 16 from 0, in f64.
pub fn mandelbrot(w: &World, x: i64, y: i64) -> DVec4 {
    let (centre, scale) = (w.numbers("centre"), w.number("scale"));
    let re = centre[0] + (x as f64 + 0.5 - w.width() / 2.0) / w.height() * scale;
    let im = centre[1] + (y as f64 + 0.5 - w.height() / 2.0) / w.height() * scale;
    let orbit = std::iter::successors(Some((re, im)), |(a, b)| Some((a * a - b * b + re, 2.0 * a * b + im)));
    let mut sizes = orbit.map(|(a, b)| a.hypot(b)).take(200).enumerate();
    let Some((k, size)) = sizes.find(|(_, size)| *size > 16.0) else {
        return DVec4::new(0.0, 0.0, 0.0, 1.0);
    };
    // log2 of the logarithm to the base 16 of the size.
    let count = k as f64 - (size.ln() / 16.0f64.ln()).log2();
    let colour = [3.0, 3.6, 4.0].map(|phase| 0.5 + 0.5 * (phase + 0.15 * count).cos());
    DVec3::from(colour).extend(1.0)
}

/// The rules in words: fewer than two or more than three neighbours kill, three give birth.
pub fn life(w: &World, x: i64, y: i64) -> DVec4 {
    let cells = w.picture("cells");
    let inside = |x: i64, y: i64| (0..cells.width()).contains(&x) && (0..cells.height()).contains(&y);
    let lives = |x: i64, y: i64| inside(x, y) && cells.r(x, y) > 0.5;
    let block = (0..9).map(|k| (x + k % 3 - 1, y + k / 3 - 1));
    let in_block = block.filter(|(x, y)| lives(*x, *y)).count();
    let next = in_block == 3 || (in_block == 4 && lives(x, y));
    DVec3::splat(if next { 1.0 } else { 0.0 }).extend(1.0)
}

/// Bayer's matrix by its recursion: four times the smaller one, and 0 2 / 3 1.
fn bayer(rows: i64, x: i64, y: i64) -> i64 {
    if rows == 1 {
        return 0;
    }
    let half = rows / 2;
    4 * bayer(half, x % half, y % half) + [[0, 2], [3, 1]][(y / half % 2) as usize][(x / half % 2) as usize]
}

pub fn ordered_dither(w: &World, x: i64, y: i64) -> DVec4 {
    let steps = w.number("levels") - 1.0;
    let here = w.picture("color").rgba(x, y);
    let threshold = (bayer(8, x % 8, y % 8) as f64 + 0.5) / 64.0;
    let dithered = here
        .truncate()
        .to_array()
        .map(|v| (v * steps + threshold).floor().min(steps) / steps);
    DVec3::from(dithered).extend(here.w)
}

/// A hash of words, as its paper has it.
fn pcg(state: u32) -> u32 {
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// The sum over all corners of a cell of a ramp times its weight.
pub fn perlin(w: &World, x: i64, y: i64) -> DVec4 {
    // Towards the middles of a cube's edges, four of them twice.
    let directions = [
        [1, 1, 0],
        [-1, 1, 0],
        [1, -1, 0],
        [-1, -1, 0],
        [1, 0, 1],
        [-1, 0, 1],
        [1, 0, -1],
        [-1, 0, -1],
        [0, 1, 1],
        [0, -1, 1],
        [0, 1, -1],
        [0, -1, -1],
        [1, 1, 0],
        [0, -1, 1],
        [-1, 1, 0],
        [0, -1, -1],
    ];
    let ramp = |x: i32, y: i32, z: i32, at: DVec3| {
        let [x, y, z] =
            [(x, 1_664_525u32), (y, 22_695_477), (z, 1_103_515_245)].map(|(v, m)| (v as u32).wrapping_mul(m));
        let hash = pcg(x.wrapping_add(y).wrapping_add(z).wrapping_add(1_013_904_223));
        at.dot(DVec3::from(directions[(hash & 15) as usize].map(f64::from)))
    };
    let fall = |t: f64| 1.0 - (6.0 * t.abs().powi(5) - 15.0 * t.powi(4) + 10.0 * t.abs().powi(3));
    let noise = |at: DVec3| -> f64 {
        let corner = at.floor();
        (0..8)
            .map(|k| {
                let corner = corner + DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
                let from = at - corner;
                let weight = fall(from.x) * fall(from.y) * fall(from.z);
                weight * ramp(corner.x as i32, corner.y as i32, corner.z as i32, from)
            })
            .sum()
    };
    let scale = w.number("scale");
    let at = DVec3::new(x as f64 / scale, y as f64 / scale, w.number("depth"));
    let octaves = w.number("octaves") as i32;
    let sum: f64 = (0..octaves).map(|k| noise(at * 2f64.powi(k)) / 2f64.powi(k + 1)).sum();
    DVec3::splat(0.5 + 0.5 * sum).extend(1.0)
}

/// Distances to all points of nine by nine cells, sorted.
pub fn worley(w: &World, x: i64, y: i64) -> DVec4 {
    let point = |x: i64, y: i64| {
        let [mut a, mut b] = [x, y].map(|v| (v as i32 as u32).wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        for _ in 0..2 {
            a = a.wrapping_add(b.wrapping_mul(1_664_525));
            b = b.wrapping_add(a.wrapping_mul(1_664_525));
            a ^= a >> 16;
            b ^= b >> 16;
        }
        DVec2::new(f64::from(a >> 8), f64::from(b >> 8)) / f64::from(1u32 << 24)
    };
    let at = DVec2::new(x as f64, y as f64) / w.number("size");
    let cells = (0..81).map(|k| (at.x.floor() as i64 + k % 9 - 4, at.y.floor() as i64 + k / 9 - 4));
    let mut distances: Vec<f64> = cells
        .map(|(x, y)| (DVec2::new(x as f64, y as f64) + point(x, y)).distance(at))
        .collect();
    distances.sort_by(f64::total_cmp);
    DVec4::new(distances[0], distances[1], distances[1] - distances[0], 1.0)
}

/// The distances to a ball and a plane, where a ray meets them, solved; none of it marched.
pub fn sphere_tracing(w: &World, x: i64, y: i64) -> DVec4 {
    let ball = DVec3::new(0.0, 1.0, 0.0);
    let ball_at = |from: DVec3, direction: DVec3| {
        let (b, c) = ((from - ball).dot(direction), (from - ball).length_squared() - 1.0);
        let root = b * b - c;
        let t = -b - root.max(0.0).sqrt();
        (root > 0.0 && t > 0.0 && t < 30.0).then_some(t)
    };
    let ground_at = |from: DVec3, direction: DVec3| {
        let t = -from.y / direction.y;
        (t > 0.0 && t < 30.0).then_some(t)
    };
    let angle = w.number("angle");
    let from = DVec3::new(4.0 * angle.cos(), 2.0, 4.0 * angle.sin());
    let ahead = (DVec3::new(0.0, 0.8, 0.0) - from).normalize();
    let right = ahead.cross(DVec3::Y).normalize();
    let up = right.cross(ahead);
    let (u, v) = (
        (x as f64 + 0.5 - w.width() / 2.0) / w.height(),
        (y as f64 + 0.5 - w.height() / 2.0) / w.height(),
    );
    let direction = (ahead * 1.4 + right * u - up * v).normalize();
    let light = DVec3::new(0.6, 0.7, 0.4).normalize();
    let lit = |albedo: DVec3, normal: DVec3, shadowed: bool| {
        let diffuse = if shadowed { 0.0 } else { normal.dot(light).max(0.0) };
        albedo * (0.15 + 0.85 * diffuse)
    };
    let colour = match (ball_at(from, direction), ground_at(from, direction)) {
        (Some(t), _) => {
            let normal = from + direction * t - ball;
            lit(DVec3::new(0.9, 0.4, 0.2), normal, normal.dot(light) < 0.0)
        }
        (None, Some(t)) => {
            let at = from + direction * t;
            lit(DVec3::new(0.4, 0.5, 0.4), DVec3::Y, ball_at(at, light).is_some())
        }
        (None, None) => DVec3::new(0.55, 0.7, 0.9),
    };
    colour.extend(1.0)
}

/// Percentage-closer soft shadows: the mean depth of what is nearer finds how wide the shadow's edge is.
pub fn pcss(w: &World, x: i64, y: i64) -> DVec4 {
    let shadow = w.picture("shadow");
    let light = w.number("light");
    let uv = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / w.size();
    let at = uv * shadow.size();
    let receiver = 0.4 + 0.5 * uv.y;
    let spiral = |count: usize, turn: f64| {
        (0..count).map(move |k| {
            let angle = k as f64 * std::f64::consts::PI * (3.0 - 5.0f64.sqrt()) + turn;
            DVec2::from_angle(angle) * ((k as f64 + 0.5) / count as f64).sqrt()
        })
    };
    let depths = spiral(16, 0.0)
        .map(|p| (at + p * light).floor())
        .map(|p| shadow.r(p.x as i64, p.y as i64));
    let nearer: Vec<f64> = depths.filter(|depth| *depth < receiver).collect();
    if nearer.is_empty() {
        return DVec4::ONE;
    }
    let mean = nearer.iter().sum::<f64>() / nearer.len() as f64;
    let reach = ((receiver / mean - 1.0) * light).max(0.5);
    // Bilinear weights of the four texels that pass.
    let passed = |p: DVec2| {
        let corner = (p - 0.5).floor();
        let part = p - 0.5 - corner;
        let mut sum = 0.0;
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let weight = (if dx == 1 { part.x } else { 1.0 - part.x }) * if dy == 1 { part.y } else { 1.0 - part.y };
            let depth = shadow.r(corner.x as i64 + dx, corner.y as i64 + dy);
            sum += if receiver <= depth { weight } else { 0.0 };
        }
        sum
    };
    let turn = std::f64::consts::TAU * interleaved(x, y);
    let lit: f64 = spiral(24, turn).map(|p| passed(at + p * reach)).sum::<f64>() / 24.0;
    DVec3::splat(lit).extend(1.0)
}

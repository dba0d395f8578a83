//! Light by its integrals, and rays by their intersections.

use super::world::{Picture, World, interleaved, mix};
use glam::{DVec2, DVec3, DVec4};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Turns a vector of view space into the frame of rows and depths: y down, z away from the viewer.
const DOWN_AND_AWAY: DVec3 = DVec3::new(1.0, -1.0, -1.0);

/// Position of a pixel in front of the eye.
fn position(w: &World, depth: &Picture, x: i64, y: i64, beyond: (i64, i64)) -> DVec3 {
    let z = depth.r(x, y);
    // Beyond the border the depth is the border's, the ray is not.
    let centre = DVec2::new(beyond.0 as f64 + 0.5, beyond.1 as f64 + 0.5) - w.size() / 2.0;
    (centre * z / w.number("focal")).extend(z)
}

/// Light from each slice of the sky, summed up in small steps of angle.
pub fn gtao(w: &World, x: i64, y: i64) -> DVec4 {
    let (depth, normals) = (w.picture("depth"), w.picture("normal"));
    let here = position(w, &depth, x, y, (x, y));
    let view = -here.normalize();
    let normal = normals.rgb(x, y) * DOWN_AND_AWAY;
    let reach = (w.number("radius") * w.number("focal") / here.z).clamp(1.0, 64.0);
    let mut visible = 0.0;
    for slice in 0..3 {
        let angle = (f64::from(slice) + interleaved(x, y)) * PI / 3.0;
        let across = DVec2::from_angle(angle);
        let flat = across.extend(0.0);
        let tangent = (flat - view * view.dot(flat)).normalize();
        let (along, up) = (normal.dot(tangent), normal.dot(view));
        let (n, length) = (along.atan2(up), along.hypot(up));
        let horizon = |side: f64| {
            let steps = (1..=6).map(|k| (across * side * reach * f64::from(k) / 6.0 + 0.5).floor());
            let steps = steps
                .map(|step| (x + step.x as i64, y + step.y as i64))
                .filter(|at| *at != (x, y));
            let to = steps.map(|(u, v)| position(w, &depth, u, v, (u, v)) - here);
            let near = to.filter(|to| to.length() <= w.number("radius"));
            let lowest = FRAC_PI_2 + side * n;
            near.map(|to| to.angle_between(view))
                .fold(lowest.clamp(0.0, PI), f64::min)
        };
        let (left, right) = ((-horizon(-1.0)).max(n - FRAC_PI_2), horizon(1.0).min(n + FRAC_PI_2));
        const STEPS: i32 = 400;
        let step = (right - left) / f64::from(STEPS);
        let sum: f64 = (0..STEPS)
            .map(|k| left + (f64::from(k) + 0.5) * step)
            .map(|angle| (angle - n).cos() * angle.sin().abs())
            .sum();
        visible += length * sum * step;
    }
    DVec3::splat((visible / 3.0).clamp(0.0, 1.0)).extend(1.0)
}

/// The mean of the environment over the directions of 64 microfacets, their heights by the inverse of GGX's distribution.
pub fn environment_prefilter(w: &World, x: i64, y: i64) -> DVec4 {
    let image = w.picture("image");
    let uv = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / w.size();
    let (longitude, latitude) = ((uv.x - 0.5) * TAU, (0.5 - uv.y) * PI);
    let normal = DVec3::new(
        latitude.cos() * longitude.cos(),
        latitude.sin(),
        latitude.cos() * longitude.sin(),
    );
    let up = if normal.z.abs() < 0.999 { DVec3::Z } else { DVec3::X };
    let tangent = up.cross(normal).normalize();
    let alpha = w.number("roughness").powi(2);
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for k in 0..64u32 {
        // Van der Corput's sequence: the digits of k, behind the point.
        let share: f64 = (0..6).map(|bit| f64::from(k >> bit & 1) / f64::from(2u32 << bit)).sum();
        let tan = alpha * (share / (1.0 - share)).sqrt();
        let turn = TAU * f64::from(k) / 64.0;
        let half = (tangent * turn.cos() * tan + normal.cross(tangent) * turn.sin() * tan + normal).normalize();
        let light = half * (2.0 * half.dot(normal)) - normal;
        let weight = light.dot(normal);
        if weight > 0.0 {
            let place = DVec2::new(
                light.z.atan2(light.x) / TAU + 0.5,
                0.5 - light.y.clamp(-1.0, 1.0).asin() / PI,
            );
            sum += image.bilinear(place * image.size()).truncate() * weight;
            total += weight;
        }
    }
    (sum / total).extend(1.0)
}

/// The first place where a ray is below the relief, in steps of a 64th of a layer.
pub fn parallax_occlusion(w: &World, x: i64, y: i64) -> DVec4 {
    let (height, albedo) = (w.picture("height"), w.picture("albedo"));
    let view = DVec3::from_slice(w.numbers("view"));
    let uv = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / w.size();
    let slope = DVec2::new(view.x, view.y) / view.z * w.number("depth");
    let fine = 4096;
    let below = |k: i32| {
        let down = f64::from(k) / f64::from(fine);
        let at = uv - slope * down;
        (down >= 1.0 - height.bilinear(at * height.size()).x).then_some(at)
    };
    let found = (0..=fine)
        .find_map(below)
        .expect("the relief is not deeper than its floor");
    if found.min_element() < 0.0 || found.max_element() > 1.0 {
        return DVec4::ZERO;
    }
    albedo.bilinear(found * albedo.size())
}

/// The mirrored ray in space, looked at where it covers another pixel.
pub fn screen_space_reflections(w: &World, x: i64, y: i64) -> DVec4 {
    let (colour, depth, normals) = (w.picture("color"), w.picture("depth"), w.picture("normal"));
    let focal = w.number("focal");
    let from = position(w, &depth, x, y, (x, y));
    let normal = normals.rgb(x, y) * DOWN_AND_AWAY;
    let ray = from.normalize().reflect(normal);
    let start = from + normal * 0.02;
    let length = if start.z + ray.z * 4.0 < 0.2 {
        (0.2 - start.z) / ray.z
    } else {
        4.0
    };
    let end = start + ray * length;
    let project = |at: DVec3| at.truncate() / at.z * focal + w.size() / 2.0;
    let (a, b) = (project(start), project(end));
    let pixels = (b - a).abs().max_element().max(1.0);
    let stride = (pixels / 48.0).max(1.0);
    let mut met = None;
    for k in 1..=48 {
        let part = f64::from(k) * stride / pixels;
        let at = (a + (b - a) * part).floor();
        let inside = at.min_element() >= 0.0 && at.x < w.width() && at.y < w.height();
        if part > 1.0 || !inside {
            break;
        }
        // Fraction of the ray in space at `part` of its length on the screen.
        let along = part * start.z / mix(end.z, start.z, part);
        let behind = start.lerp(end, along).z - depth.r(at.x as i64, at.y as i64);
        if behind > 0.02 && behind < 0.35 {
            met = Some(colour.rgba(at.x as i64, at.y as i64));
            break;
        }
    }
    let here = colour.rgba(x, y);
    let cos = (-from.normalize()).dot(normal).clamp(0.0, 1.0);
    met.map_or(here, |there| here.lerp(there, 0.04 + 0.96 * (1.0 - cos).powi(5)))
}

/// Planes with the depths of `two_planes`, which face the eye with their own normals.
pub fn normal_from_depth(w: &World, x: i64, _y: i64) -> DVec4 {
    plane(2 * x < w.width() as i64).0.normalize().extend(1.0)
}

/// A plane's normal, not of unit length, and its distance.
fn plane(left: bool) -> (DVec3, f64) {
    match left {
        true => (DVec3::new(0.3, -0.2, -1.0), 2.0),
        false => (DVec3::new(-0.4, -0.1, -1.0), 5.0),
    }
}

/// The depth at a place of the picture of two planes that meet nowhere on the screen: n · (ray z) = -distance.
pub fn two_planes(x: f64, y: f64, size: DVec2, focal: f64) -> f64 {
    let (normal, distance) = plane(x < size.x / 2.0);
    let ray = DVec3::new((x - size.x / 2.0) / focal, (y - size.y / 2.0) / focal, 1.0);
    -distance / normal.dot(ray)
}

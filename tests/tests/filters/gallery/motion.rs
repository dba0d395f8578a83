//! Filters of what moves and of what is out of focus, and of edges, each written down once more from its paper, in f64.

use super::world::{World, interleaved, smoothstep};
use glam::{DMat3, DVec2, DVec3, DVec4};

pub fn motion_blur(w: &World, x: i64, y: i64) -> DVec4 {
    let (colour, velocities, most, depth) = (
        w.picture("color"),
        w.picture("velocities"),
        w.picture("most"),
        w.picture("depth"),
    );
    let half = |velocity: DVec4| DVec2::new(velocity.x, velocity.y) / 2.0;
    let fastest = half(most.rgba(x, y));
    if fastest.length() <= 0.5 {
        return colour.rgba(x, y);
    }
    let speed = |x, y| half(velocities.rgba(x, y)).length().max(0.5);
    let own = speed(x, y);
    let cone = |distance: f64, speed: f64| (1.0 - distance / speed).clamp(0.0, 1.0);
    let cylinder = |distance: f64, speed: f64| 1.0 - smoothstep(0.95 * speed, 1.05 * speed, distance);
    let before = |a: f64, b: f64| (1.0 + (b - a) / 0.1).clamp(0.0, 1.0);
    let mut taps = vec![(1.0 / own, colour.rgba(x, y))];
    for k in (0..15).filter(|k| *k != 7) {
        let part = -1.0 + 2.0 * (f64::from(k) + interleaved(x, y) - 0.5 + 1.0) / 16.0;
        let step = (fastest * part + 0.5).floor();
        let (u, v) = (x + step.x as i64, y + step.y as i64);
        let (here, there) = (depth.r(x, y), depth.r(u, v));
        let (distance, its) = (step.length(), speed(u, v));
        let weight = before(there, here) * cone(distance, its)
            + before(here, there) * cone(distance, own)
            + 2.0 * cylinder(distance, its) * cylinder(distance, own);
        taps.push((weight, colour.rgba(u, v)));
    }
    let total: f64 = taps.iter().map(|(weight, _)| weight).sum();
    taps.iter().map(|(weight, colour)| *colour * *weight).sum::<DVec4>() / total
}

pub fn bokeh(w: &World, x: i64, y: i64) -> DVec4 {
    let (colour, depth) = (w.picture("color"), w.picture("depth"));
    let size = |depth: f64| {
        let out = (1.0 / w.number("focus") - 1.0 / depth) * w.number("strength");
        10.0 * out.clamp(-1.0, 1.0).abs()
    };
    let centre = depth.r(x, y);
    let mut mean = colour.rgb(x, y);
    let mut count = 1.0;
    let mut radius: f64 = 1.0;
    while radius < 10.0 {
        // The mean so far moves towards each sample: s + mix(s / n, c, t) over n + 1.
        let at = (DVec2::from_angle((count - 1.0) * 2.399_963_229_728_653) * radius + 0.5).floor();
        let (u, v) = (x + at.x as i64, y + at.y as i64);
        let there = depth.r(u, v);
        let blur = if there > centre {
            size(there).min(2.0 * size(centre))
        } else {
            size(there)
        };
        let taken = mean.lerp(colour.rgb(u, v), smoothstep(radius - 0.5, radius + 0.5, blur));
        mean = (mean * count + taken) / (count + 1.0);
        count += 1.0;
        radius += 1.0 / radius;
    }
    mean.extend(1.0)
}

pub fn taa(w: &World, x: i64, y: i64) -> DVec4 {
    let (colour, history, velocities) = (w.picture("color"), w.picture("history"), w.picture("velocities"));
    // The rows are luma and two differences; the way back is the inverse.
    let to = DMat3::from_cols(
        DVec3::new(0.25, 0.5, -0.25),
        DVec3::new(0.5, 0.0, 0.5),
        DVec3::new(0.25, -0.5, -0.25),
    );
    let velocity = velocities.rgba(x, y);
    let before = (DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - DVec2::new(velocity.x, velocity.y)) / w.size();
    if before.min_element() < 0.0 || before.max_element() > 1.0 {
        return colour.rgba(x, y);
    }
    let around: Vec<DVec3> = (0..9).map(|k| to * colour.rgb(x + k % 3 - 1, y + k / 3 - 1)).collect();
    let mean = around.iter().sum::<DVec3>() / 9.0;
    let deviation = (around.iter().map(|c| (*c - mean) * (*c - mean)).sum::<DVec3>() / 9.0).map(f64::sqrt);
    let old = to * history.bilinear(before * history.size()).truncate();
    // The longest part of the way from the mean that stays in the box.
    let reach = deviation + 1.0e-4;
    let part = (0..3).map(|k| reach[k] / (old[k] - mean[k]).abs()).fold(1.0, f64::min);
    let old = mean + (old - mean) * part;
    let new = to * colour.rgb(x, y);
    let share = w.number("share");
    let (a, b) = ((1.0 - share) / (1.0 + old.x), share / (1.0 + new.x));
    (to.inverse() * ((old * a + new * b) / (a + b))).extend(colour.rgba(x, y).w)
}

/// From Lottes's description: contrast, direction, ends of the edge, offset.
pub fn fxaa(w: &World, x: i64, y: i64) -> DVec4 {
    let colour = w.picture("color");
    let luma = |c: DVec4| 0.299 * c.x + 0.587 * c.y + 0.114 * c.z;
    let l = |dx: i64, dy: i64| luma(colour.rgba(x + dx, y + dy));
    let here = colour.rgba(x, y);
    let cross = [l(0, 0), l(0, -1), l(0, 1), l(-1, 0), l(1, 0)];
    let high = cross.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let low = cross.into_iter().fold(f64::INFINITY, f64::min);
    if high - low < (high * 0.166).max(0.0833) {
        return here;
    }
    let second = |a: f64, b: f64, c: f64| (a - 2.0 * b + c).abs();
    let weigh = |f: &dyn Fn(i64) -> f64| f(-1) + 2.0 * f(0) + f(1);
    let rows = weigh(&|k| second(l(k, -1), l(k, 0), l(k, 1)));
    let columns = weigh(&|k| second(l(-1, k), l(0, k), l(1, k)));
    let horizontal = rows >= columns;
    let turned = |along: f64, across: f64| match horizontal {
        true => DVec2::new(along, across),
        false => DVec2::new(across, along),
    };
    let beside = |side: i64| if horizontal { l(0, side) } else { l(side, 0) };
    let side = if (beside(-1) - cross[0]).abs() >= (beside(1) - cross[0]).abs() {
        -1
    } else {
        1
    };
    let contrast = (beside(-1) - cross[0]).abs().max((beside(1) - cross[0]).abs()) / 4.0;
    let border = (cross[0] + beside(side)) / 2.0;
    let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
    let off = |distance: f64| luma(colour.bilinear(middle + turned(distance, side as f64 / 2.0))) - border;
    let stops: Vec<f64> = [1.0, 1.0, 1.0, 1.0, 1.0, 1.5, 2.0, 2.0, 2.0, 2.0, 4.0, 8.0]
        .iter()
        .scan(0.0, |sum, step| {
            *sum += step;
            Some(*sum)
        })
        .collect();
    let end = |way: f64| {
        *stops
            .iter()
            .find(|s| off(way * **s).abs() >= contrast)
            .unwrap_or(stops.last().expect("12"))
    };
    let (back, ahead) = (end(-1.0), end(1.0));
    let at_end = off(if back < ahead { -back } else { ahead });
    let edge = if (at_end < 0.0) != (cross[0] < border) {
        0.5 - back.min(ahead) / (back + ahead)
    } else {
        0.0
    };
    let ring = 2.0 * (l(0, 1) + l(0, -1) + l(1, 0) + l(-1, 0)) + l(1, 1) + l(1, -1) + l(-1, 1) + l(-1, -1);
    let lone = smoothstep(0.0, 1.0, (ring / 12.0 - cross[0]).abs() / (high - low)).powi(2) * 0.75;
    let moved = middle + turned(0.0, edge.max(lone) * side as f64);
    colour.bilinear(moved).truncate().extend(here.w)
}

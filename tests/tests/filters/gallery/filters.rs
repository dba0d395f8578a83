//! Filters of pictures by their definitions: sums over all texels that count.

use super::world::{World, mix};
use glam::{DVec2, DVec3, DVec4};
use std::f64::consts::PI;

fn luma(colour: DVec3) -> f64 {
    0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z
}

/// The windowed sinc of every texel within a dozen, one axis times the other.
pub fn lanczos(w: &World, x: i64, y: i64) -> DVec4 {
    let image = w.picture("image");
    let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / w.size() * image.size() - 0.5;
    let sinc = |x: f64| if x == 0.0 { 1.0 } else { (PI * x).sin() / (PI * x) };
    let weight = |x: f64| if x.abs() < 3.0 { sinc(x) * sinc(x / 3.0) } else { 0.0 };
    let (mut sum, mut total) = (DVec4::ZERO, 0.0);
    for v in at.y as i64 - 6..at.y as i64 + 6 {
        for u in at.x as i64 - 6..at.x as i64 + 6 {
            let share = weight(at.x - u as f64) * weight(at.y - v as f64);
            sum += image.rgba(u, v) * share;
            total += share;
        }
    }
    sum / total
}

/// The four corners of the pixel's own source texel, painted by the four rules one after the other.
pub fn scale2x(w: &World, x: i64, y: i64) -> DVec4 {
    let image = w.picture("image");
    let (u, v) = (x.div_euclid(2), y.div_euclid(2));
    let [a, b, c, d] = [(0, -1), (1, 0), (-1, 0), (0, 1)].map(|(dx, dy)| image.rgba(u + dx, v + dy));
    let mut corners = [image.rgba(u, v); 4];
    if c == a && c != d && a != b {
        corners[0] = a;
    }
    if a == b && a != c && b != d {
        corners[1] = b;
    }
    if d == c && d != b && c != a {
        corners[2] = c;
    }
    if b == d && b != a && d != c {
        corners[3] = d;
    }
    corners[(2 * y.rem_euclid(2) + x.rem_euclid(2)) as usize]
}

/// The filter's picture in Bjørge's slides: the middle counts four times.
pub fn dual_kawase(w: &World, x: i64, y: i64) -> DVec4 {
    let image = w.picture("image");
    let scale = image.size() / w.size();
    let read = |dx: f64, dy: f64| image.bilinear(DVec2::new(x as f64 + 0.5 + dx, y as f64 + 0.5 + dy) * scale);
    let corners = read(-0.5, -0.5) + read(0.5, -0.5) + read(-0.5, 0.5) + read(0.5, 0.5);
    (corners + 4.0 * read(0.0, 0.0)) / 8.0
}

/// The distorted radius inverted by halving an interval.
pub fn lens(w: &World, x: i64, y: i64) -> DVec4 {
    let image = w.picture("image");
    let (k1, k2) = (w.number("k1"), w.number("k2"));
    let from = (DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - w.size() / 2.0) / (w.height() / 2.0);
    let (mut low, mut high) = (0.0, 8.0);
    for _ in 0..80 {
        let middle: f64 = (low + high) / 2.0;
        let seen = middle + k1 * middle.powi(3) + k2 * middle.powi(5);
        if seen < from.length() {
            low = middle
        } else {
            high = middle
        }
    }
    let uv = from.normalize() * low * (w.height() / 2.0) / w.size() + 0.5;
    if uv.min_element() < 0.0 || uv.max_element() > 1.0 {
        return DVec4::ZERO;
    }
    image.bilinear(uv * image.size())
}

pub fn nlm(w: &World, x: i64, y: i64) -> DVec4 {
    let colour = w.picture("color");
    let around = |radius: i64| (-radius..=radius).flat_map(move |y| (-radius..=radius).map(move |x| (x, y)));
    let patch = |x: i64, y: i64| -> Vec<f64> {
        around(1)
            .flat_map(|(dx, dy)| colour.rgb(x + dx, y + dy).to_array())
            .collect()
    };
    let own = patch(x, y);
    let (mut sum, mut total) = (DVec4::ZERO, 0.0);
    for (dx, dy) in around(3) {
        let other = patch(x + dx, y + dy);
        let square: f64 = own.iter().zip(&other).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / own.len() as f64;
        let weight = (-square / 0.01).exp();
        sum += weight * colour.rgba(x + dx, y + dy);
        total += weight;
    }
    sum / total
}

/// Gradients by the two matrices, compared along the direction nearest to theirs.
pub fn canny(w: &World, x: i64, y: i64) -> DVec4 {
    let colour = w.picture("color");
    let gradient = |x: i64, y: i64| {
        let across = [[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]];
        let mut sum = DVec2::ZERO;
        for (dy, row) in (-1..).zip(across) {
            for (dx, weight) in (-1..).zip(row) {
                sum.x += f64::from(weight) * luma(colour.rgb(x + dx, y + dy));
                sum.y += f64::from(weight) * luma(colour.rgb(x + dy, y + dx));
            }
        }
        sum
    };
    let here = gradient(x, y);
    let octant = (here.y.atan2(here.x).rem_euclid(PI) / (PI / 4.0)).round() as usize % 4;
    let (dx, dy) = [(1, 0), (1, 1), (0, 1), (-1, 1)][octant];
    let crest = [1, -1]
        .iter()
        .all(|s| gradient(x + s * dx, y + s * dy).length() <= here.length());
    let strength = match here.length() {
        l if !crest || l < w.number("low") => 0.0,
        l if l < w.number("high") => 0.5,
        _ => 1.0,
    };
    DVec3::splat(strength).extend(1.0)
}

/// Each channel by itself: the weight is the root of the room left to white or black.
pub fn cas(w: &World, x: i64, y: i64) -> DVec4 {
    let colour = w.picture("color");
    let peak = -1.0 / mix(8.0, 5.0, w.number("sharpness"));
    let channel = |k: usize| {
        let at = |dx: i64, dy: i64| colour.rgb(x + dx, y + dy)[k];
        let cross = [(0, 0), (0, -1), (-1, 0), (1, 0), (0, 1)].map(|(dx, dy)| at(dx, dy));
        let all: Vec<f64> = (0..9).map(|n| at(n % 3 - 1, n / 3 - 1)).collect();
        let least = |v: &[f64]| v.iter().copied().fold(f64::INFINITY, f64::min);
        let most = |v: &[f64]| v.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = (least(&cross) + least(&all), most(&cross) + most(&all));
        let weight = peak * (low.min(2.0 - high) / high).clamp(0.0, 1.0).sqrt();
        let sum: f64 = cross[1..].iter().sum();
        ((sum * weight + cross[0]) / (1.0 + 4.0 * weight)).clamp(0.0, 1.0)
    };
    DVec4::new(channel(0), channel(1), channel(2), 1.0)
}

/// The most negative lobe for which no channel leaves 0 to 1, if the ring counts as its own extremes.
pub fn rcas(w: &World, x: i64, y: i64) -> DVec4 {
    let colour = w.picture("color");
    let ring = [(0, -1), (-1, 0), (1, 0), (0, 1)].map(|(dx, dy)| colour.rgb(x + dx, y + dy));
    let here = colour.rgb(x, y);
    let mut lobe = f64::NEG_INFINITY;
    for k in 0..3 {
        let low = ring.iter().map(|c| c[k]).fold(f64::INFINITY, f64::min);
        let high = ring.iter().map(|c| c[k]).fold(f64::NEG_INFINITY, f64::max);
        // (e + 4 lobe high) = 0, and (e + 4 lobe low) = 1 + 4 lobe.
        let black = -low.min(here[k]) / (4.0 * high);
        let white = (high.max(here[k]) - 1.0) / (4.0 * (1.0 - low));
        lobe = lobe.max(black).max(white);
    }
    let brightness = |c: DVec3| c.y + (c.x + c.z) / 2.0;
    let [a, b, c, d] = ring.map(brightness);
    let e = brightness(here);
    let range = a.max(b).max(c).max(d).max(e) - a.min(b).min(c).min(d).min(e);
    let noise = if range > 0.0 {
        (((a + b + c + d) / 4.0 - e).abs() / range).min(1.0)
    } else {
        0.0
    };
    let lobe = lobe.clamp(-3.0 / 16.0, 0.0) * 0.5f64.powf(w.number("stops")) * (1.0 - noise / 2.0);
    ((here + lobe * ring.iter().sum::<DVec3>()) / (1.0 + 4.0 * lobe)).extend(1.0)
}

/// EASU from its description: gradients of the four middle texels, weighed bilinearly, turn and stretch the kernel.
pub fn easu(w: &World, x: i64, y: i64) -> DVec4 {
    let image = w.picture("image");
    let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) * image.size() / w.size() - 0.5;
    let corner = at.floor();
    let part = at - corner;
    let texel = |dx: i64, dy: i64| image.rgb(corner.x as i64 + dx, corner.y as i64 + dy);
    let bright = |dx: i64, dy: i64| texel(dx, dy).dot(DVec3::new(0.5, 1.0, 0.5));
    let (mut direction, mut length) = (DVec2::ZERO, 0.0);
    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let share = (if dx == 1 { part.x } else { 1.0 - part.x }) * if dy == 1 { part.y } else { 1.0 - part.y };
        let here = bright(dx, dy);
        let pairs = [
            (bright(dx - 1, dy), bright(dx + 1, dy)),
            (bright(dx, dy - 1), bright(dx, dy + 1)),
        ];
        for (axis, (before, after)) in pairs.into_iter().enumerate() {
            direction[axis] += share * (after - before);
            let most = (after - here).abs().max((here - before).abs());
            length += if most > 0.0 {
                share * ((after - before).abs() / most).min(1.0).powi(2)
            } else {
                0.0
            };
        }
    }
    direction = if direction.length_squared() < 1.0 / 32768.0 {
        DVec2::X
    } else {
        direction.normalize()
    };
    let amount = (length / 2.0).powi(2);
    let square = 1.0 / direction.abs().max_element();
    let stretch = DVec2::new(mix(1.0, square, amount), mix(1.0, 0.5, amount));
    let lobe = mix(0.5, 0.21, amount);
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for dy in -1..=2 {
        for dx in -1..=2 {
            if (dx == -1 || dx == 2) && (dy == -1 || dy == 2) {
                continue;
            }
            let offset = DVec2::new(dx as f64, dy as f64) - part;
            let turned = DVec2::new(offset.dot(direction), direction.perp_dot(offset)) * stretch;
            let d = turned.length_squared().min(1.0 / lobe);
            let weight = (25.0 / 16.0 * (0.4 * d - 1.0).powi(2) - 9.0 / 16.0) * (lobe * d - 1.0).powi(2);
            sum += texel(dx, dy) * weight;
            total += weight;
        }
    }
    let middle = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
    let low = middle.into_iter().reduce(DVec3::min).expect("four");
    let high = middle.into_iter().reduce(DVec3::max).expect("four");
    (sum / total).clamp(low, high).extend(1.0)
}

/// Dammertz's step with SVGF's weights, all 25 taps alike.
pub fn atrous(w: &World, x: i64, y: i64) -> DVec4 {
    let (colour, normal, depth) = (w.picture("color"), w.picture("normal"), w.picture("depth"));
    let (spacing, sigma) = (w.number("spacing") as i64, w.number("sigma"));
    let spline = [1.0, 4.0, 6.0, 4.0, 1.0].map(|v| v / 16.0);
    let (mut sum, mut total) = (DVec4::ZERO, 0.0);
    for k in 0..25 {
        let (i, j) = (k % 5, k / 5);
        let (dx, dy) = ((i as i64 - 2) * spacing, (j as i64 - 2) * spacing);
        let mut weight = spline[i] * spline[j];
        if (dx, dy) != (0, 0) {
            let facing = normal.rgb(x, y).dot(normal.rgb(x + dx, y + dy)).max(0.0);
            let deeper = (depth.r(x, y) - depth.r(x + dx, y + dy)).abs() / (dx as f64).hypot(dy as f64);
            let brighter = (luma(colour.rgb(x, y)) - luma(colour.rgb(x + dx, y + dy))).abs();
            weight *= facing.powi(128) * (-deeper / 0.05).exp() * (-brighter / sigma).exp();
        }
        sum += weight * colour.rgba(x + dx, y + dy);
        total += weight;
    }
    sum / total
}

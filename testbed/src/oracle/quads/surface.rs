//! Ambient occlusion.

use super::Picture;

/// How occlusion is estimated; see the kernel's options of the same names.
#[allow(missing_docs)]
pub struct Ao {
    pub taps: usize,
    pub radius: f64,
    pub bias: f64,
    pub strength: f64,
    pub pixel_angle: f64,
    pub depth_sigma: f64,
}

fn position(ao: &Ao, depth: &Picture, size: [i64; 2], x: i64, y: i64) -> [f64; 3] {
    let z = depth.at(x, y)[0];
    let across = (x as f64 + 0.5 - size[0] as f64 / 2.0) * ao.pixel_angle * z;
    let down = (y as f64 + 0.5 - size[1] as f64 / 2.0) * ao.pixel_angle * z;
    [across, down, z]
}

/// The mean occlusion that a pixel finds by some of the taps of its spiral.
fn found(ao: &Ao, depth: &Picture, normal: &Picture, [x, y]: [i64; 2], which: impl Iterator<Item = usize>) -> f64 {
    let from = position(ao, depth, depth.size, x, y);
    let n = normal.at(x, y);
    let reach = (ao.radius / (ao.pixel_angle * from[2])).min(48.0);
    let (mut sum, mut count) = (0.0, 0.0);
    for k in which {
        let distance = (k as f64 + 0.5) / (4 * ao.taps) as f64;
        let angle = k as f64 * 2.399_963_2;
        let i = (distance * angle.cos() * reach + 0.5).floor() as i64;
        let j = (distance * angle.sin() * reach + 0.5).floor() as i64;
        let to = position(ao, depth, depth.size, x + i, y + j);
        let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let squared: f64 = way.iter().map(|v| v * v).sum();
        let cosine = way.iter().zip(n).map(|(a, b)| a * b).sum::<f64>() / squared.max(1.0e-12).sqrt();
        sum += (cosine - ao.bias).max(0.0) * (1.0 - squared / (ao.radius * ao.radius)).max(0.0);
        count += 1.0;
    }
    sum / count
}

/// Light that comes to a pixel: by all of its own taps, or, with `quad`, by a quarter of its own and by what the three
/// pixels of the same 2×2 block found by theirs, at the weight of a Gaussian in depth.
pub fn ssao(ao: &Ao, depth: &Picture, normal: &Picture, quad: bool, [x, y]: [i64; 2]) -> f64 {
    let occluded = if quad {
        let z = depth.at(x, y)[0];
        let (mut sum, mut total) = (0.0, 0.0);
        for number in 0..4 {
            let at = [x / 2 * 2 + number % 2, y / 2 * 2 + number / 2];
            let away = (depth.at(at[0], at[1])[0] - z) / (ao.depth_sigma * ao.radius);
            let weight = (-0.5 * away * away).exp();
            let which = (0..ao.taps).map(|k| 4 * k + number as usize);
            sum += weight * found(ao, depth, normal, at, which);
            total += weight;
        }
        sum / total
    } else {
        found(ao, depth, normal, [x, y], 0..4 * ao.taps)
    };
    (1.0 - ao.strength * occluded).clamp(0.0, 1.0)
}

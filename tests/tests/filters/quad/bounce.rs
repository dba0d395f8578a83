//! The example that gathers a bounce of light.

use super::*;

#[path = "../../../../examples/quads/bounce.rs"]
pub(super) mod kernel;

use kernel::{Bounce, Gives, bounce};

/// The light at a pixel, by definition: what each lane of its quad finds with its own taps, weighted by how near its surface is.
fn light(cfg: &Bounce, [depth, normal, color]: [&Picture; 3], [x, y]: [i64; 2]) -> [f64; 3] {
    let angle = f64::from(cfg.pixel_angle);
    let radius = f64::from(cfg.radius);
    let position = |[x, y]: [i64; 2]| {
        let z = depth.texel_at(x, y)[0];
        let off = |axis: usize, p: i64| (p as f64 + 0.5 - depth.size[axis] as f64 / 2.0) * angle * z;
        [off(0, x), -off(1, y), -z]
    };
    let dot = |a: [f64; 3], b: [f64; 4]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let taps = 4 * i64::from(cfg.taps);
    let mut sum = [0.0; 3];
    let mut total = 0.0;
    for lane in 0..4 {
        let at = [x / 2 * 2 + lane % 2, y / 2 * 2 + lane / 2];
        let here = position(at);
        let reach = (radius / (angle * -here[2])).min(64.0);
        let away = (depth.texel_at(at[0], at[1])[0] - depth.texel_at(x, y)[0]) / (f64::from(cfg.depth_sigma) * radius);
        let weight = (-0.5 * away * away).exp();
        total += weight;
        for k in (lane..taps).step_by(4) {
            let (far, turn) = ((k as f64 + 0.5) / taps as f64, k as f64 * f64::from(2.399_963_2_f32));
            let step = |v: f64| (v * far * reach + 0.5).floor() as i64;
            let tap = [at[0] + step(turn.cos()), at[1] + step(turn.sin())];
            let there = position(tap);
            let to = [0, 1, 2].map(|k| there[k] - here[k]);
            let squared: f64 = to.iter().map(|c| c * c).sum();
            let along = to.map(|c| c / squared.max(1.0e-12).sqrt());
            let arrives = dot(along, normal.texel_at(at[0], at[1])).max(0.0);
            let leaves = (-dot(along, normal.texel_at(tap[0], tap[1]))).max(0.0);
            let near = (1.0 - squared / (radius * radius)).max(0.0);
            for (k, sum) in sum.iter_mut().enumerate() {
                *sum += weight * color.texel_at(tap[0], tap[1])[k] * arrives * leaves * near / f64::from(cfg.taps);
            }
        }
    }
    sum.map(|c| c * f64::from(cfg.strength) / total)
}

#[test]
fn a_bounce_of_light_is_gathered_by_quads() {
    let gpu = bench();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/quads/bounce.rs");
    for size in SIZES {
        let depth = components(&noise(size, 12), |t| Vec4::splat(1.0 + t.x));
        let normal = components(&unit_normals(size, 13), |n| vec4(n.x, -n.y, -n.z, 0.0));
        let color = noise(size, 14);
        let pictures = [&depth, &normal, &color].map(picture);
        let (z, n) = (components(&depth, |t| t.x), components(&normal, Vec4::truncate));
        for (gives, word) in [(Gives::Light, "light"), (Gives::Picture, "picture")] {
            let cfg = Bounce {
                gives,
                pixel_angle: 0.05,
                ..Bounce::default()
            };
            let expected = defined(size, |at| {
                let light = light(&cfg, pictures.each_ref(), at);
                let own = pictures[2].texel_at(at[0], at[1]);
                match gives {
                    Gives::Light => [light[0], light[1], light[2], 1.0],
                    Gives::Picture => [
                        own[0] * (1.0 + light[0]),
                        own[1] * (1.0 + light[1]),
                        own[2] * (1.0 + light[2]),
                        own[3],
                    ],
                }
            });
            assert!(size.x < 30 || expected.iter().any(|texel| texel[0] > 1.0e-3));
            check(
                &gpu,
                [&format!("bounce {word}"), file],
                &[("gives", word), ("pixel-angle", "0.05")],
                &Inputs::new(size)
                    .with_image("depth", depth.clone())
                    .with_image("normal", normal.clone())
                    .with_image("color", color.clone()),
                &native(size, |pixel| bounce(&cfg, &z, &n, &color, size, pixel)),
                &expected,
                [2.0e-4, 2.0e-4],
            );
        }
    }
}

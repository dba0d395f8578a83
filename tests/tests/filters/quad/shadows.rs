//! Shadow maps, filtered in a forward pass.

use super::*;
use straightline_bench::execute::{Corner, Forward};
use straightline_kernels::quad::pcf::{Gradient, Method, Mirroring, Pcf, ShadowWeights, Tap, Width, join, pcf, table};
use straightline_kernels::quad::pcss::{Pcss, SearchSharing, pcss};
use straightline_tests::quads::{self, Shadow};

const WEIGHTS: [(ShadowWeights, &str); 7] = [
    (ShadowWeights::Box, "box"),
    (ShadowWeights::LinearStep, "linear-step"),
    (ShadowWeights::SmoothStep, "smooth-step"),
    (ShadowWeights::Gaussian, "gaussian"),
    (ShadowWeights::Linear, "linear"),
    (ShadowWeights::Quadratic, "quadratic"),
    (ShadowWeights::Cubic, "cubic"),
];

/// A table of the cubic spline.
const LOOKUP: (ShadowWeights, &str) = (ShadowWeights::Lookup, "lookup");

/// That table for a filter that ends at `half`.
fn cubic_table(half: f32) -> Texture<Vec4> {
    let cubic = shadow("cubic", half.into());
    table(half, 513, |away| cubic.weight(away.into()) as f32)
}

pub(super) const MAP: UVec2 = uvec2(48, 40);

/// A plane in the shadow map's space: coordinates at any pixel, inside the frame or not.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) origin: [f64; 3],
    pub(super) right: [f64; 3],
    pub(super) down: [f64; 3],
}

impl Plane {
    pub(super) fn at(self, [x, y]: [i64; 2]) -> [f64; 3] {
        let (x, y) = (x as f64 + 0.5, y as f64 + 0.5);
        std::array::from_fn(|k| self.origin[k] + x * self.right[k] + y * self.down[k])
    }

    /// A triangle that covers the frame.
    fn cover(self, size: UVec2) -> Vec<Corner> {
        let corner = |x: f64, y: f64| {
            let pixel = [(x + 1.0) / 2.0 * f64::from(size.x), (1.0 - y) / 2.0 * f64::from(size.y)];
            let lane = |k: usize| (self.origin[k] + pixel[0] * self.right[k] + pixel[1] * self.down[k]) as f32;
            Corner {
                position: vec4(x as f32, y as f32, 0.5, 1.0),
                varyings: vec![vec4(lane(0), lane(1), lane(2), 0.0)],
            }
        };
        vec![corner(-1.0, -1.0), corner(3.0, -1.0), corner(-1.0, 3.0)]
    }
}

/// Seen from near: a texel is some pixels wide, at a slant.
pub(super) const PLANE: Plane = Plane {
    origin: [0.231, 0.217, 0.402],
    right: [0.0123, 0.0031, 0.0007],
    down: [-0.0029, 0.0149, 0.0011],
};

pub(super) fn map() -> Frame<Vec4> {
    let grain = noise(MAP, 31);
    let texel = |k: u32| {
        let (x, y) = ((k % MAP.x) as f32, (k / MAP.x) as f32);
        let wave = (x * 0.35).sin() * (y * 0.27 + 1.0).cos();
        Vec4::splat(0.43 + 0.1 * wave + 0.03 * grain.texels()[k as usize].x)
    };
    Frame::new(MAP, (0..MAP.x * MAP.y).map(texel).collect())
}

/// Word for the width, and texels on an axis.
fn texels_of(width: Width) -> (&'static str, i64) {
    match width {
        Width::Four => ("four", 4),
        Width::Eight => ("eight", 8),
        Width::Twelve => ("twelve", 12),
        Width::Sixteen => ("sixteen", 16),
    }
}

struct Case {
    method: Method,
    width: Width,
    weights: ShadowWeights,
    gradient: Gradient,
    spread: f32,
    mirroring: Mirroring,
    options: Vec<(String, String)>,
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |method, width, weights: (ShadowWeights, &str), gradient, spread: f32| {
        let words = [
            (
                "method",
                match method {
                    Method::Naive => "naive",
                    Method::Bilinear => "bilinear",
                    Method::Quad => "quad",
                    Method::Gather => "gather",
                },
            ),
            ("width", texels_of(width).0),
            ("weights", weights.1),
            (
                "gradient",
                match gradient {
                    Gradient::None => "none",
                    Gradient::Prewitt => "prewitt",
                    Gradient::Fitted => "fitted",
                },
            ),
        ];
        let mut options: Vec<(String, String)> = words.map(|(k, v)| (k.to_owned(), v.to_owned())).to_vec();
        options.push(("spread".to_owned(), format!("{spread:?}")));
        cases.push(Case {
            method,
            width,
            weights: weights.0,
            gradient,
            spread,
            mirroring: Mirroring::Local,
            options,
        });
    };
    for width in [Width::Twelve, Width::Sixteen] {
        add(Method::Naive, width, WEIGHTS[6], Gradient::None, 1.0);
        add(Method::Bilinear, width, WEIGHTS[5], Gradient::None, 1.0);
        add(Method::Quad, width, WEIGHTS[0], Gradient::Prewitt, 1.0);
        add(Method::Quad, width, WEIGHTS[6], Gradient::None, 1.0);
        add(Method::Quad, width, WEIGHTS[5], Gradient::Fitted, 1.0);
        add(Method::Quad, width, LOOKUP, Gradient::None, 1.0);
    }
    for width in [Width::Four, Width::Eight] {
        add(Method::Naive, width, WEIGHTS[0], Gradient::None, 1.0);
        add(Method::Naive, width, WEIGHTS[6], Gradient::None, 1.0);
        add(Method::Bilinear, width, WEIGHTS[0], Gradient::None, 1.0);
        add(Method::Bilinear, width, WEIGHTS[3], Gradient::None, 1.0);
        for weights in WEIGHTS {
            add(Method::Quad, width, weights, Gradient::None, 1.0);
        }
        add(Method::Quad, width, WEIGHTS[0], Gradient::Prewitt, 1.0);
        add(Method::Quad, width, WEIGHTS[6], Gradient::Prewitt, 1.0);
        add(Method::Quad, width, WEIGHTS[5], Gradient::Fitted, 1.0);
        add(Method::Quad, width, WEIGHTS[0], Gradient::None, 2.5);
        add(Method::Bilinear, width, LOOKUP, Gradient::None, 1.0);
        add(Method::Quad, width, LOOKUP, Gradient::None, 1.0);
        add(Method::Quad, width, LOOKUP, Gradient::Prewitt, 1.0);
    }
    for weights in WEIGHTS {
        add(Method::Gather, Width::Eight, weights, Gradient::None, 1.0);
    }
    let of_several = |case: &&Case| case.method == Method::Quad && case.width != Width::Four;
    let simple = |case: &Case| Case {
        mirroring: Mirroring::Simple,
        options: [&case.options[..], &[("mirroring".to_owned(), "simple".to_owned())]].concat(),
        ..*case
    };
    let mirrored: Vec<Case> = cases.iter().filter(of_several).map(simple).collect();
    cases.extend(mirrored);
    cases
}

pub(super) fn shadow(weights: &str, half: f64) -> Shadow {
    Shadow {
        size: [i64::from(MAP.x), i64::from(MAP.y)],
        depths: map().texels().iter().map(|t| f64::from(t.x)).collect(),
        weights: weights.to_owned(),
        half,
    }
}

/// A pixel's value, of coordinates at any pixel.
fn definition(case: &Case, coord: impl Fn([i64; 2]) -> [f64; 3], [x, y]: [i64; 2]) -> f64 {
    let texels = texels_of(case.width).1;
    let half = texels as f64 / 2.0;
    let word = match case.options[2].1.as_str() {
        "lookup" => "cubic",
        word => word,
    };
    let of = |c: [f64; 3]| [c[0] * f64::from(MAP.x), c[1] * f64::from(MAP.y)];
    let own = coord([x, y]);
    let quad = [0, 1, 2, 3].map(|k| coord([x / 2 * 2 + k % 2, y / 2 * 2 + k / 2]));
    let mean: [f64; 3] = std::array::from_fn(|k| quad.iter().map(|c| c[k]).sum::<f64>() / 4.0);
    let map = shadow(word, half);
    match case.method {
        Method::Naive | Method::Bilinear => quads::pcf_around(&map, texels, of(own), of(own), own[2]),
        Method::Gather => quads::pcf_around(&shadow(word, 3.0), 8, of(mean), of(own), mean[2]),
        Method::Quad if case.spread != 1.0 => quads::pcf_bilinear(&map, texels, of(mean), case.spread.into(), mean[2]),
        Method::Quad => {
            let lit = quads::pcf_around(&map, texels, of(mean), of(mean), mean[2]);
            let slope = match case.gradient {
                Gradient::None => return lit,
                Gradient::Prewitt => quads::slope_prewitt(&map, texels, of(mean), mean[2]),
                Gradient::Fitted => quads::slope_fitted(&map, texels, of(mean), mean[2]),
            };
            let value = lit
                + (0..2)
                    .map(|axis| {
                        let centre = of(mean)[axis];
                        slope[axis] * (of(own)[axis] - centre - quads::weighted_middle(&map, texels, centre))
                    })
                    .sum::<f64>();
            value.clamp(0.0, 1.0)
        }
    }
}

pub(super) fn draw(gpu: &Bench, compiled: &Compiled, inputs: &Inputs, plane: Plane) -> Frame<Vec4> {
    let forward: Forward = gpu
        .prepare_forward(compiled, inputs, &plane.cover(inputs.size))
        .expect("it can be drawn");
    gpu.draw_forward(&forward).expect("it is drawn")
}

/// The coordinates of every pixel, as a compute shader and the interpreter read them.
pub(super) fn coordinates(size: UVec2, plane: Plane) -> Frame<Vec4> {
    let texel = |k: u32| {
        let c = plane.at([i64::from(k % size.x), i64::from(k / size.x)]);
        vec4(c[0] as f32, c[1] as f32, c[2] as f32, 0.0)
    };
    Frame::new(size, (0..size.x * size.y).map(texel).collect())
}

/// Pixels off by more than a step of a hardware filter in each of its weights; where a texel's depth or its place hangs on
/// the last bit, a whole texel may count or not.
pub(super) fn unsure(found: &Frame<Vec4>, expected: &[[f64; 4]], tolerance: f64) -> (f64, f64) {
    let all = texels(found);
    let off: Vec<f64> = all
        .iter()
        .zip(expected)
        .map(|(a, b)| (0..3).map(|k| (f64::from(a[k]) - b[k]).abs()).fold(0.0, f64::max))
        .collect();
    let many = off.iter().filter(|o| **o > tolerance).count();
    let sure = off.iter().filter(|o| **o <= tolerance).copied().fold(0.0, f64::max);
    (many as f64 / off.len() as f64, sure)
}

#[test]
fn every_filter_is_its_definition() {
    let gpu = bench();
    for size in [uvec2(24, 18), uvec2(25, 17)] {
        let coord = coordinates(size, PLANE);
        let inputs = Inputs::new(size)
            .with_image("shadow", map())
            .with_image("coord", coord.clone());
        let texture = DepthTexture::new(MAP, map().texels().iter().map(|t| t.x).collect());
        let coords = components(&coord, Vec4::truncate);
        for case in cases() {
            let options: Vec<(&str, &str)> = case.options.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
            let row = options.iter().map(|(_, v)| *v).collect::<Vec<_>>().join(" ");
            let cfg = Pcf {
                method: case.method,
                width: case.width,
                weights: case.weights,
                gradient: case.gradient,
                spread: case.spread,
                mirroring: case.mirroring,
                ..Pcf::default()
            };
            let lookup = cubic_table(texels_of(case.width).1 as f32 / 2.0);
            let inputs = inputs
                .clone()
                .with_image("lookup", Frame::new(lookup.size(), lookup.texels().to_vec()));
            let sampler = ComparisonSampler::default();
            let found = native(size, |pixel| {
                pcf(
                    &cfg,
                    &texture,
                    &sampler,
                    &lookup,
                    &Sampler::default(),
                    coords.load(pixel),
                )
            });
            let forms = if size.x % 2 == 1 { &FORMS[..] } else { &FORMS[..1] };
            for unroll in forms.iter().copied() {
                let compiled = compile("pcf", &options, unroll, None);
                let interpreted = interpret_kernel::<f32>(&compiled, &inputs, false).expect("it runs");
                same_bits(&found, &interpreted.texels).unwrap_or_else(|e| panic!("{row} {unroll}: {e}"));
            }
            // Beyond the border a compute shader has the border's coordinates, a rasteriser those of the plane.
            let inside = |[x, y]: [i64; 2]| PLANE.at([x.min(size.x as i64 - 1), y.min(size.y as i64 - 1)]);
            let clamped = defined(size, |at| [definition(&case, inside, at); 4]);
            let plane = defined(size, |at| [definition(&case, |p| PLANE.at(p), at); 4]);
            let image = Frame::new(size, found.iter().map(|t| Vec4::from_array(*t)).collect());
            let (share, off) = unsure(&image, &clamped, 2.0e-4);
            assert!(
                share <= 0.02,
                "{row}: natively {:.1} % of the pixels are off",
                share * 100.0
            );
            let mut shown = format!("pcf {row} | {}x{} | {off:.1e}", size.x, size.y);
            for transport in [Transport::Subgroup, Transport::Derivatives] {
                let drawn = draw(
                    &gpu,
                    &compile("pcf", &options, Unroll::Full, Some(transport)),
                    &inputs,
                    PLANE,
                );
                let (share, off) = unsure(&drawn, &plane, 0.02);
                assert!(
                    share <= 0.03,
                    "{row} by {transport}, {size}: {:.1} % of the pixels are off",
                    share * 100.0
                );
                shown += &format!(" | {off:.1e}");
            }
            let block = compile("pcf", &options, Unroll::Full, Some(Transport::Block));
            let computed = gpu.run(&block, Stage::Compute, &inputs).expect("it runs");
            let (share, off) = unsure(&computed, &clamped, 0.02);
            assert!(
                share <= 0.03,
                "{row} by block: {:.1} % of the pixels are off",
                share * 100.0
            );
            println!("{shown} | {off:.1e}");
        }
    }
}

#[test]
fn penumbras_widen_with_distance() {
    let gpu = bench();
    for size in [uvec2(24, 18), uvec2(25, 17)] {
        let coord = coordinates(size, PLANE);
        let inputs = Inputs::new(size)
            .with_image("shadow", map())
            .with_image("coord", coord.clone());
        let texture = DepthTexture::new(MAP, map().texels().iter().map(|t| t.x).collect());
        let coords = components(&coord, Vec4::truncate);
        for (sharing, word) in [(SearchSharing::Quad, "quad"), (SearchSharing::Alone, "alone")] {
            let cfg = Pcss {
                sharing,
                ..Pcss::default()
            };
            let numbers = [cfg.search, cfg.light, cfg.narrowest, cfg.widest].map(f64::from);
            let value = |coord: &dyn Fn([i64; 2]) -> [f64; 3], [x, y]: [i64; 2]| {
                let quad = [0, 1, 2, 3].map(|k| coord([x / 2 * 2 + k % 2, y / 2 * 2 + k / 2]));
                let mean: [f64; 3] = std::array::from_fn(|k| quad.iter().map(|c| c[k]).sum::<f64>() / 4.0);
                let c = if sharing == SearchSharing::Quad {
                    mean
                } else {
                    coord([x, y])
                };
                let at = [c[0] * f64::from(MAP.x), c[1] * f64::from(MAP.y)];
                quads::pcss(&shadow("box", 4.0), at, c[2], numbers)
            };
            let inside = |[x, y]: [i64; 2]| PLANE.at([x.min(size.x as i64 - 1), y.min(size.y as i64 - 1)]);
            let clamped = defined(size, |at| [value(&inside, at); 4]);
            let plane = defined(size, |at| [value(&|p| PLANE.at(p), at); 4]);
            let sampler = ComparisonSampler::default();
            let found = native(size, |pixel| pcss(&cfg, &texture, &sampler, coords.load(pixel)));
            let options = [("sharing", word)];
            for unroll in [Unroll::Full, Unroll::None] {
                let interpreted = interpret_kernel::<f32>(&compile("pcss", &options, unroll, None), &inputs, false);
                let interpreted = interpreted.expect("it runs");
                same_bits(&found, &interpreted.texels).unwrap_or_else(|e| panic!("pcss {word} {unroll}: {e}"));
            }
            let image = Frame::new(size, found.iter().map(|t| Vec4::from_array(*t)).collect());
            let (share, off) = unsure(&image, &clamped, 1.0e-3);
            assert!(share <= 0.02, "pcss {word}: natively {:.1} % are off", share * 100.0);
            let mut shown = format!("pcss {word} | {}x{} | {off:.1e}", size.x, size.y);
            for transport in [Transport::Subgroup, Transport::Derivatives] {
                let drawn = draw(
                    &gpu,
                    &compile("pcss", &options, Unroll::Full, Some(transport)),
                    &inputs,
                    PLANE,
                );
                let (share, off) = unsure(&drawn, &plane, 0.02);
                assert!(
                    share <= 0.04,
                    "pcss {word} by {transport}: {:.1} % are off",
                    share * 100.0
                );
                shown += &format!(" | {off:.1e}");
            }
            let block = compile("pcss", &options, Unroll::Full, Some(Transport::Block));
            let computed = gpu.run(&block, Stage::Compute, &inputs).expect("it runs");
            let (share, off) = unsure(&computed, &clamped, 0.02);
            assert!(share <= 0.04, "pcss {word} by block: {:.1} % are off", share * 100.0);
            println!("{shown} | {off:.1e}");
        }
    }
}

/// Light that grows straight over the map comes back straight: by the Prewitt operator where taps lie in the middle of
/// their texels (a box), by the fitted plane wherever they lie.
#[test]
fn a_ramp_of_light_comes_back_straight() {
    use ShadowWeights::{Box, Cubic, Gaussian};
    ramps::<1>(Width::Four, Box, Gradient::Prewitt);
    ramps::<4>(Width::Eight, Box, Gradient::Prewitt);
    ramps::<9>(Width::Twelve, Box, Gradient::Prewitt);
    ramps::<16>(Width::Sixteen, Box, Gradient::Prewitt);
    ramps::<1>(Width::Four, Box, Gradient::Fitted);
    ramps::<4>(Width::Eight, Cubic, Gradient::Fitted);
    ramps::<4>(Width::Eight, Gaussian, Gradient::Fitted);
    ramps::<16>(Width::Sixteen, Gaussian, Gradient::Fitted);
}

fn ramps<const N: usize>(width: Width, weights: ShadowWeights, gradient: Gradient) {
    let mut random = Random(77);
    let on_axis = N.isqrt();
    // The outermost tap of 2, 4, 6 or 8 on an axis.
    let outermost = 2.0 * on_axis as f32 - 1.0;
    for _ in 0..200 {
        let slope = vec2(random.unit() - 0.5, random.unit() - 0.5) * 0.05;
        let a = vec2(random.unit(), random.unit());
        let ramp = |place: Vec2| 0.5 + slope.dot(place);
        // A weighed tap lies somewhere between its texels, as each row and each column of taps has it.
        let mut between = || match weights {
            ShadowWeights::Box => 0.0,
            _ => random.unit() * 0.8 - 0.4,
        };
        let (columns, rows): ([f32; 8], [f32; 8]) =
            (std::array::from_fn(|_| between()), std::array::from_fn(|_| between()));
        let number = |middle: f32| ((middle + outermost) / 2.0) as usize;
        let taps: [Tap; N] = std::array::from_fn(|k| {
            let of = |k: usize| 4.0 * k as f32 - 2.0 * (on_axis - 1) as f32;
            let middle = quad_vector() + vec2(of(k % on_axis), of(k / on_axis));
            let place = middle.map(|m| m + vec2(columns[number(m.x)], rows[number(m.y)])) + (0.5 - a);
            let weight = middle.map(|m| (1.0 - columns[number(m.x)]) * (1.0 - rows[number(m.y)]));
            Tap {
                lit: place.map(ramp),
                place,
                middle,
                weight,
            }
        });
        let away = Quad::new([0, 1, 2, 3].map(|k| vec2((k % 2) as f32 - 0.5, (k / 2) as f32 - 0.5) * 0.6));
        let cfg = Pcf {
            width,
            weights,
            gradient,
            ..Pcf::default()
        };
        let found = join(&cfg, taps, Quad::splat(a), away).lanes();
        for (found, away) in found.iter().zip(away.lanes()) {
            let off = (found - ramp(away)).abs();
            assert!(off < 2.0e-6, "{width:?} {weights:?} {gradient:?}: off by {off:.2e}");
        }
    }
}

/// Mean square of the steps from pixel to pixel: inside of quads, and from quad to quad.
fn steps(image: &Frame<Vec4>) -> (f64, f64) {
    let (mut inside, mut across) = ((0.0, 0), (0.0, 0));
    for y in 0..image.size().y as i32 {
        for x in 0..image.size().x as i32 - 1 {
            let step = f64::from(image.load(ivec2(x + 1, y)).x - image.load(ivec2(x, y)).x);
            let slot = if x % 2 == 0 { &mut inside } else { &mut across };
            slot.0 += step * step;
            slot.1 += 1;
        }
    }
    (inside.0 / f64::from(inside.1), across.0 / f64::from(across.1))
}

/// Without a gradient all steps lie between quads; with it, a fair share inside.
#[test]
fn gradients_take_the_blocks_away() {
    let gpu = bench();
    let size = uvec2(64, 48);
    let edge = |k: u32| {
        let (x, y) = ((k % MAP.x) as f32, (k / MAP.x) as f32);
        Vec4::splat(if x + 0.4 * y < 30.0 { 0.2 } else { 0.9 })
    };
    let map = Frame::new(MAP, (0..MAP.x * MAP.y).map(edge).collect());
    let plane = Plane {
        origin: [0.2, 0.3, 0.5],
        right: [0.01, 0.0, 0.0],
        down: [0.0, 0.01, 0.0],
    };
    let inputs = Inputs::new(size)
        .with_image("shadow", map)
        .with_image("coord", coordinates(size, plane));
    for (options, blocky) in [
        (&[("weights", "quadratic")][..], true),
        (&[("weights", "quadratic"), ("gradient", "prewitt")], false),
        (&[("weights", "quadratic"), ("gradient", "fitted")], false),
        (&[("weights", "quadratic"), ("method", "gather")], false),
        (&[("weights", "quadratic"), ("method", "bilinear")], false),
    ] {
        let compiled = compile("pcf", options, Unroll::Full, Some(Transport::Subgroup));
        let (inside, across) = steps(&draw(&gpu, &compiled, &inputs, plane));
        let share = inside / (inside + across);
        println!("blockiness {options:?}: inside {inside:.2e}, across {across:.2e}, share inside {share:.2}");
        if blocky {
            assert!(share < 0.001, "{options:?}: {share}");
        } else {
            assert!((0.25..0.75).contains(&share), "{options:?}: {share}");
        }
    }
}

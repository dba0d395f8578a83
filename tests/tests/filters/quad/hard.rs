//! Filters of quads and the examples at inputs that are no numbers, infinite or huge: finite everywhere, by every
//! transport, and what the interpreter gives. `straightline study hard` compares the built-in ones with their definitions.

use super::bounce::kernel::{Bounce, bounce};
use super::scatter::kernel::{Scatter, scatter};
use super::*;
use straightline_kernels::quad::convolution::{QuadConvolution, Weights, quad_convolution};
use straightline_kernels::quad::pcf::{Gradient, Method, Pcf, ShadowWeights, Width, pcf};
use straightline_kernels::quad::pcss::{Pcss, pcss};
use straightline_kernels::quad::ssao::{QuadSsao, quad_ssao};
use straightline_study::hard::{self, Case, Normal};

/// The pictures of the faults that were reported: an odd size, so that quads stick out of it.
const SIZE: UVec2 = uvec2(53, 37);

fn example(name: &str) -> String {
    format!("{}/../examples/quads/{name}.rs", env!("CARGO_MANIFEST_DIR"))
}

fn filled(size: UVec2, texel: impl Fn(UVec2) -> Vec4) -> Frame<Vec4> {
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| uvec2(x, y)));
    Frame::new(size, pixels.map(texel).collect())
}

/// Two walls of depths 3 and 5, and an infinite sky to the right.
fn sky_beside_walls() -> Frame<Vec4> {
    filled(SIZE, |at| {
        Vec4::splat(match (at.x, at.y) {
            (39.., _) => f32::INFINITY,
            (_, 20..) => 5.0,
            _ => 3.0,
        })
    })
}

fn facing(away: f32) -> Frame<Vec4> {
    filled(SIZE, |at| {
        vec3(0.3 * (at.x as f32 * 0.4).sin(), 0.2, away).normalize().extend(0.0)
    })
}

/// Steps in 64×64 texels.
fn step_map() -> Frame<Vec4> {
    filled(uvec2(64, 64), |at| {
        Vec4::splat(if (at.x / 9 + at.y / 7) % 2 == 0 { 0.3 } else { 0.8 })
    })
}

/// Coordinates over the map at a depth between its two, `bad` where `is_bad`.
fn coordinates(bad: Vec3, is_bad: impl Fn(UVec2) -> bool) -> Frame<Vec4> {
    filled(SIZE, |at| {
        let place = (at.as_vec2() + 0.5) / SIZE.as_vec2();
        match is_bad(at) {
            true => bad.extend(1.0),
            false => vec4(place.x, place.y, 0.5, 1.0),
        }
    })
}

/// Largest difference of two pictures; infinite if either has a non-finite number.
fn apart(a: &[[f32; 4]], b: &[[f32; 4]]) -> f32 {
    let off = a
        .iter()
        .flatten()
        .zip(b.iter().flatten())
        .map(|(a, b)| match a.is_finite() && b.is_finite() {
            true => (a - b).abs(),
            false => f32::INFINITY,
        });
    off.fold(0.0, f32::max)
}

/// Runs a kernel in all forms by the interpreter, whose bits are the native ones, and by the transports on a device; gives
/// the native picture.
fn same_everywhere(
    gpu: &Bench,
    [name, words]: [&str; 2],
    options: Options<'_>,
    inputs: &Inputs,
    native: Vec<[f32; 4]>,
    transports: &[Transport],
    tolerance: f32,
) -> Vec<[f32; 4]> {
    for unroll in [Unroll::Full, Unroll::None] {
        let compiled = compile(name, options, unroll, None);
        let found = interpret_kernel::<f32>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{words}: {e}"));
        same_bits(&native, &found.texels).unwrap_or_else(|e| panic!("{words} {unroll}: {e}"));
    }
    for transport in transports {
        let stage = if *transport == Transport::Block {
            Stage::Compute
        } else {
            Stage::Fragment
        };
        let compiled = compile(name, options, Unroll::Full, Some(*transport));
        let shown = gpu
            .run(&compiled, stage, inputs)
            .unwrap_or_else(|e| panic!("{words}: {e}"));
        let off = apart(&texels(&shown), &native);
        assert!(off <= tolerance, "{words} by {transport}: off by {off:e}");
    }
    native
}

const ALL: [Transport; 3] = [Transport::Subgroup, Transport::Derivatives, Transport::Block];

/// Nothing occludes a sky, and a sky occludes nothing.
#[test]
fn occlusion_before_an_infinite_sky_is_finite_and_the_same_everywhere() {
    let gpu = bench();
    let cfg = QuadSsao::default();
    let normal = facing(-1.0);
    for (words, depth) in [
        ("infinite everywhere", filled(SIZE, |_| Vec4::INFINITY)),
        ("infinite in a part", sky_beside_walls()),
        (
            "infinite in one lane",
            filled(SIZE, |at| {
                Vec4::splat(if at.x % 2 == 1 && at.y % 2 == 0 {
                    f32::INFINITY
                } else {
                    3.0 + 0.01 * at.y as f32
                })
            }),
        ),
        (
            "no number in spots",
            filled(SIZE, |at| {
                Vec4::splat(if at.x % 7 == 3 {
                    f32::NAN
                } else {
                    3.0 + 0.01 * at.x as f32
                })
            }),
        ),
    ] {
        let (z, n) = (components(&depth, |t| t.x), components(&normal, Vec4::truncate));
        let inputs = Inputs::new(SIZE)
            .with_image("depth", depth.clone())
            .with_image("normal", normal.clone());
        let found = native(SIZE, |pixel| quad_ssao(&cfg, &z, &n, SIZE, pixel));
        let found = same_everywhere(&gpu, ["quad_ssao", words], &[], &inputs, found, &ALL, 2.0e-4);
        for (light, z) in found.iter().zip(z.texels()) {
            assert!(z.is_finite() || light[0] == 1.0, "{words}: {light:?} in the sky");
        }
    }
}

/// No light comes from a sky or from what has no finite colour, and none is lost beside it.
#[test]
fn a_bounce_of_light_beside_the_sky_is_finite_and_the_same_everywhere() {
    let gpu = bench();
    let cfg = Bounce::default();
    let normal = facing(1.0);
    let depth = sky_beside_walls();
    let bad_color = filled(SIZE, |at| Vec4::splat(if at.x % 11 == 5 { f32::NAN } else { 0.5 }));
    for (words, color) in [("plain", noise(SIZE, 3)), ("colours that are no numbers", bad_color)] {
        let (z, n) = (components(&depth, |t| t.x), components(&normal, Vec4::truncate));
        let inputs = Inputs::new(SIZE)
            .with_image("depth", depth.clone())
            .with_image("normal", normal.clone())
            .with_image("color", color.clone());
        let found = native(SIZE, |pixel| bounce(&cfg, &z, &n, &color, SIZE, pixel));
        same_everywhere(&gpu, [&example("bounce"), words], &[], &inputs, found, &ALL, 2.0e-4);
    }
}

/// A bad lane affects no other: the quad's other pixels have their own mean place.
#[test]
fn bad_coordinates_spoil_no_other_lane() {
    let gpu = bench();
    let map = step_map();
    let texture = DepthTexture::new(map.size(), map.texels().iter().map(|t| t.x).collect());
    let (sampler, lookup) = (ComparisonSampler::default(), Texture::new(UVec2::ONE, vec![Vec4::ZERO]));
    let one = |at: UVec2| at == uvec2(20, 10);
    let some = |at: UVec2| at.y == 14 && at.x.is_multiple_of(5);
    let all = |_: UVec2| true;
    let plain = coordinates(Vec3::ZERO, |_| false);
    for (words, bad, is_bad) in [
        ("one NaN", Vec3::NAN, &one as &dyn Fn(UVec2) -> bool),
        ("infinite in some", vec3(f32::INFINITY, f32::NEG_INFINITY, 0.5), &some),
        ("1e30 in some", Vec3::splat(1.0e30), &some),
        ("50 maps away in some", vec3(50.0, -50.0, 0.5), &some),
        ("NaN everywhere", Vec3::NAN, &all),
        ("infinite everywhere", Vec3::NEG_INFINITY, &all),
    ] {
        let coord = coordinates(bad, is_bad);
        let inputs = Inputs::new(SIZE)
            .with_image("shadow", map.clone())
            .with_image("coord", coord.clone());
        let (coords, good) = (components(&coord, Vec4::truncate), components(&plain, Vec4::truncate));
        let cfg = Pcf {
            weights: ShadowWeights::Quadratic,
            gradient: Gradient::Fitted,
            ..Pcf::default()
        };
        let at = |coords: &Frame<Vec3>| {
            native(SIZE, |p| {
                pcf(&cfg, &texture, &sampler, &lookup, &Sampler::default(), coords.load(p))
            })
        };
        let options = [("weights", "quadratic"), ("gradient", "fitted")];
        let found = same_everywhere(
            &gpu,
            ["pcf", words],
            &options,
            &inputs,
            at(&coords),
            &[Transport::Block],
            0.03,
        );
        neighbours_are_kept(words, is_bad, &found, &at(&good));
        let cfg = Pcss::default();
        let at = |coords: &Frame<Vec3>| native(SIZE, |p| pcss(&cfg, &texture, &sampler, coords.load(p)));
        let found = same_everywhere(
            &gpu,
            ["pcss", words],
            &[],
            &inputs,
            at(&coords),
            &[Transport::Block],
            0.03,
        );
        neighbours_are_kept(words, is_bad, &found, &at(&good));
        let cfg = Scatter::default();
        let at = |coords: &Frame<Vec3>| native(SIZE, |p| scatter(&cfg, &texture, &sampler, coords.load(p)));
        let file = example("scatter");
        let found = same_everywhere(
            &gpu,
            [&file, words],
            &[],
            &inputs,
            at(&coords),
            &[Transport::Block],
            0.05,
        );
        // Of the example such a place counts: its own border's light, which the quad then shares.
        if !words.starts_with("50 maps") {
            neighbours_are_kept(words, is_bad, &found, &at(&good));
        }
    }
}

/// Pixels whose own coordinates are good have nearly what they have without bad ones in their quad, whose mean place is a
/// fifth of a pixel off then; quads without a bad lane have the same bits.
fn neighbours_are_kept(words: &str, is_bad: &dyn Fn(UVec2) -> bool, found: &[[f32; 4]], good: &[[f32; 4]]) {
    for (k, (a, b)) in found.iter().zip(good).enumerate() {
        let at = uvec2(k as u32 % SIZE.x, k as u32 / SIZE.x);
        let lanes = [UVec2::ZERO, UVec2::X, UVec2::Y, UVec2::ONE].map(|o| (at / 2 * 2 + o).min(SIZE - 1));
        if !lanes.iter().any(|lane| is_bad(*lane)) {
            assert_eq!(a, b, "{words} at {at}");
        } else if !is_bad(at) {
            assert!((a[0] - b[0]).abs() < 0.3, "{words} at {at}: {a:?}, not {b:?}");
        }
    }
}

/// A table of weights that has none, or none that are numbers.
#[test]
fn tables_without_weights_give_light() {
    let gpu = bench();
    let map = step_map();
    let texture = DepthTexture::new(map.size(), map.texels().iter().map(|t| t.x).collect());
    let coord = coordinates(Vec3::NAN, |at| at.x % 9 == 2);
    let coords = components(&coord, Vec4::truncate);
    let sampler = ComparisonSampler::default();
    for value in [0.0, f32::NAN, f32::INFINITY, -1.0, 3.0e38, 1.0e-40] {
        let lookup = Frame::new(uvec2(8, 1), vec![Vec4::splat(value); 8]);
        let table = Texture::new(lookup.size(), lookup.texels().to_vec());
        let inputs = Inputs::new(SIZE)
            .with_image("shadow", map.clone())
            .with_image("coord", coord.clone())
            .with_image("lookup", lookup);
        for (method, gradient, options) in [
            (Method::Quad, Gradient::None, [("method", "quad"), ("gradient", "none")]),
            (
                Method::Quad,
                Gradient::Fitted,
                [("method", "quad"), ("gradient", "fitted")],
            ),
            (
                Method::Bilinear,
                Gradient::None,
                [("method", "bilinear"), ("gradient", "none")],
            ),
        ] {
            let cfg = Pcf {
                method,
                gradient,
                width: Width::Four,
                weights: ShadowWeights::Lookup,
                ..Pcf::default()
            };
            let options = [&options[..], &[("width", "four"), ("weights", "lookup")]].concat();
            let found = native(SIZE, |p| {
                pcf(&cfg, &texture, &sampler, &table, &Sampler::default(), coords.load(p))
            });
            assert!(
                found.iter().flatten().all(|light| (0.0..=1.0).contains(light)),
                "{value}"
            );
            // An infinite texel is infinite between texels, too, on a device or not.
            let words = format!("a table of {value}");
            same_everywhere(
                &gpu,
                ["pcf", &words],
                &options,
                &inputs,
                found,
                &[Transport::Block],
                0.03,
            );
        }
    }
}

/// Weights whose sizes sum up to more than 1 leave no room for the largest colours.
#[test]
fn given_weights_do_not_overflow() {
    let gpu = bench();
    let image = filled(uvec2(13, 7), |at| {
        Vec4::splat([1.0e38, -1.4e38, 1.0, f32::MAX][(at.x + at.y) as usize % 4])
    });
    let mut given = [0.0; 49];
    (given[24], given[23], given[25], given[17], given[31]) = (9.0, -2.0, -2.0, -2.0, -2.0);
    let cfg = QuadConvolution {
        weights: Weights::Given,
        given,
        ..QuadConvolution::default()
    };
    let words: Vec<String> = given.iter().map(|w| format!("{w:?}")).collect();
    let list = words.join(",");
    let inputs = Inputs::new(image.size()).with_image("image", image.clone());
    let found = native(image.size(), |p| quad_convolution(&cfg, &image, &Sampler::default(), p));
    let options = [("weights", "given"), ("given", list.as_str())];
    same_everywhere(
        &gpu,
        ["quad_convolution", "given"],
        &options,
        &inputs,
        found,
        &ALL,
        1.0e-4,
    );
}

/// Picture of a case at the pixels' centres.
fn seen(case: &Case, texel: impl Fn(hard::Seen) -> Vec4) -> Frame<Vec4> {
    filled(case.size, |pixel| texel(case.surface_at(pixel, Vec2::ZERO, None)))
}

fn normal(seen: hard::Seen) -> Vec4 {
    match seen.normal {
        Normal::Vector(vector) => vector.extend(0.0),
        Normal::Texel(texel) => texel,
    }
}

/// Every hard case, by every transport, in fragments, which `study hard` does not run, and the examples, which it does not know.
#[test]
fn every_hard_case_is_finite_by_every_transport() {
    let gpu = bench();
    let names = ["quad_ssao", "quad_convolution", "quad_bilateral", "quad_upsampling"];
    let images: Vec<String> = names
        .iter()
        .map(|n| (*n).to_owned())
        .chain([example("bounce")])
        .collect();
    let shadows = ["cascades", "minified", "scatter"].map(example);
    let (mut ran, mut compared) = (0, 0);
    for (name, is_shadow) in images
        .iter()
        .map(|n| (n, false))
        .chain(shadows.iter().map(|n| (n, true)))
    {
        let transports = if is_shadow { &ALL[2..] } else { &ALL[..] };
        for transport in transports {
            let stage = if *transport == Transport::Block {
                Stage::Compute
            } else {
                Stage::Fragment
            };
            let compiled = compile(name, &[], Unroll::Full, Some(*transport));
            let (pass, manifest) = gpu
                .compile_pass(&compiled, stage)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            for case in hard::all_cases()
                .iter()
                .filter(|case| case.options.is_empty() && (is_shadow || case.coord.is_none()))
            {
                let low = case.size / 2 + 2;
                let packed = |seen: hard::Seen| seen.color.truncate().extend(seen.depth);
                let map = filled(case.map, |texel| Vec4::splat(case.shadow_at(texel)));
                let inputs = Inputs::new(case.size)
                    .with_image("depth", seen(case, |seen| Vec4::splat(seen.depth)))
                    .with_image("normal", seen(case, normal))
                    .with_image("color", seen(case, |seen| seen.color))
                    .with_image("image", seen(case, packed))
                    .with_image(
                        "low",
                        filled(low, |at| {
                            packed(case.surface_at((at * 2).min(case.size - 1), Vec2::ZERO, None))
                        }),
                    )
                    .with_image("shadow", map.clone())
                    .with_image("levels", map)
                    .with_image(
                        "coord",
                        filled(case.size, |pixel| case.coordinates_at(pixel).extend(0.0)),
                    );
                let uploaded = gpu.upload(&manifest, &inputs).unwrap_or_else(|e| panic!("{name}: {e}"));
                let shown = gpu
                    .picture_of(&pass, &uploaded, case.size)
                    .unwrap_or_else(|e| panic!("{name}: {e}"));
                let what = format!("{name} on `{}` by {transport}", case.name);
                assert!(
                    shown.texels().iter().all(|t| t.is_finite()),
                    "{what}: {:?}",
                    shown.texels()
                );
                ran += 1;
                if *transport != Transport::Block {
                    continue;
                }
                let found =
                    interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
                assert!(
                    found.texels.iter().flatten().all(|c| c.is_finite()),
                    "{what}: interpreted"
                );
                // Some pixels may differ if their light hangs on the last bit of the comparison.
                if is_shadow && case.name != "on-texels" {
                    let image = found.texels.iter().zip(shown.texels());
                    let off = image.filter(|(a, b)| (a[0] - b.x).abs() > 0.06).count();
                    assert!(off * 20 <= found.texels.len(), "{what}: {off} pixels differ");
                    compared += 1;
                }
            }
        }
    }
    assert!(ran > 700 && compared > 200, "{ran} ran, {compared} compared");
}

//! Convolution, upsampling, bilateral blur, occlusion: full-screen filters.

use super::*;
use straightline_kernels::quad::bilateral::{self, QuadBilateral, quad_bilateral};
use straightline_kernels::quad::convolution::{self, QuadConvolution, Taps, Weights, quad_convolution};
use straightline_kernels::quad::ssao::{QuadSsao, Sharing, quad_ssao};
use straightline_kernels::quad::upsampling::{
    Downsampling, Factor, Gives, Payload, Reads, Screen, Upsampling, downsampling, quad_upsampling,
};
use straightline_tests::quads;

#[test]
fn convolutions_are_sums_of_weighted_pixels() {
    let gpu = bench();
    let given: [f32; 49] = std::array::from_fn(|k| ((k * 37 % 23) as f32 - 9.0) / 64.0);
    let given_text: Vec<String> = given.iter().map(|w| format!("{w:?}")).collect();
    let given_text = given_text.join(",");
    for size in SIZES {
        let image = noise(size, 7);
        let inputs = Inputs::new(size).with_image("image", image.clone());
        let whole = picture(&image);
        for (radius, weights, word) in [
            (0, Weights::Box, "box"),
            (1, Weights::Box, "box"),
            (2, Weights::Box, "box"),
            (3, Weights::Binomial, "binomial"),
            (5, Weights::Binomial, "binomial"),
            (2, Weights::Given, "given"),
            (3, Weights::Given, "given"),
        ] {
            // A radius of 0 stands for one of 1 that is not shared.
            let (radius, sharing, sharing_word) = match radius {
                0 => (1, convolution::Sharing::Alone, "alone"),
                _ => (radius, convolution::Sharing::Quad, "quad"),
            };
            let cfg = QuadConvolution {
                radius,
                sharing,
                weights,
                given,
                ..QuadConvolution::default()
            };
            let weight = |i: i64, j: i64| match weights {
                Weights::Box => 1.0 / f64::from((2 * radius + 1) * (2 * radius + 1)),
                Weights::Binomial => quads::binomial(radius.into(), i) * quads::binomial(radius.into(), j),
                Weights::Given => f64::from(given[((j + 3) * 7 + i + 3) as usize]),
            };
            let radius_text = radius.to_string();
            let mut options = vec![
                ("radius", radius_text.as_str()),
                ("weights", word),
                ("sharing", sharing_word),
            ];
            if weights == Weights::Given {
                options.push(("given", &given_text));
            }
            check(
                &gpu,
                [
                    &format!("convolution {radius} {word} {sharing_word}"),
                    "quad_convolution",
                ],
                &options,
                &inputs,
                &native(size, |pixel| quad_convolution(&cfg, &image, &Sampler::default(), pixel)),
                &defined(size, |at| quads::convolve_pixel(&whole, radius.into(), weight, at)),
                [4.0e-6, 2.0e-6],
            );
        }
    }
}

/// Samplers weigh in steps of a 256th on some devices, and in single floats on the software drivers.
#[test]
fn bilinear_taps_give_the_plane_that_fits_them() {
    let gpu = bench();
    for size in SIZES {
        let image = noise(size, 9);
        let inputs = Inputs::new(size).with_image("image", image.clone());
        let whole = picture(&image);
        for (radius, weights, word) in [
            (1, Weights::Box, "box"),
            (1, Weights::Binomial, "binomial"),
            (3, Weights::Binomial, "binomial"),
            (5, Weights::Box, "box"),
        ] {
            let cfg = QuadConvolution {
                radius,
                weights,
                taps: Taps::Bilinear,
                ..QuadConvolution::default()
            };
            let weight = |k: i64| match weights {
                Weights::Box => 1.0 / f64::from(2 * radius + 2),
                _ => quads::pascal(2 * i64::from(radius) + 1, i64::from(radius) + 1 + k),
            };
            check(
                &gpu,
                [&format!("fitted {radius} {word}"), "quad_convolution"],
                &[("radius", &radius.to_string()), ("weights", word), ("taps", "bilinear")],
                &inputs,
                &native(size, |pixel| quad_convolution(&cfg, &image, &Sampler::default(), pixel)),
                &defined(size, |at| quads::fit_plane(&whole, radius.into(), weight, at)),
                [2.0e-3, 2.0e-6],
            );
        }
    }
}

#[test]
fn bilateral_blur_is_a_mean_of_near_pixels() {
    let gpu = bench();
    for size in SIZES {
        let image = noise(size, 8);
        let whole = picture(&image);
        for (radius, sharing, word) in [
            (1, bilateral::Sharing::Alone, "alone"),
            (1, bilateral::Sharing::Quad, "quad"),
            (2, bilateral::Sharing::Quad, "quad"),
        ] {
            let cfg = QuadBilateral {
                radius,
                sharing,
                ..QuadBilateral::default()
            };
            check(
                &gpu,
                [&format!("bilateral {radius} {word}"), "quad_bilateral"],
                &[("radius", &radius.to_string()), ("sharing", word)],
                &Inputs::new(size).with_image("image", image.clone()),
                &native(size, |pixel| quad_bilateral(&cfg, &image, pixel)),
                &defined(size, |at| {
                    quads::bilateral_mean(&whole, radius.into(), cfg.sigma.into(), cfg.depth_sigma.into(), at)
                }),
                [2.0e-5, 2.0e-5],
            );
        }
    }
}

/// Inputs of upsampling: two surfaces with a step between them, noise on both.
struct Low {
    packed: Frame<Vec4>,
    color: Frame<Vec4>,
    surface: Frame<Vec4>,
    depth: Frame<Vec4>,
    normal: Frame<Vec4>,
}

fn low(size: UVec2, factor: u32) -> Low {
    let low = size.map(|n| n.div_ceil(factor) + 1);
    let step = |x: f32, y: f32, wide: UVec2| {
        let share = x / wide.x as f32 + 0.4 * y / wide.y as f32;
        if share > 0.6 { 3.0 } else { 1.0 }
    };
    let depths = |of: UVec2, seed| {
        let grain = noise(of, seed);
        let at = |k: usize| {
            let (x, y) = (k as u32 % of.x, k as u32 / of.x);
            step(x as f32, y as f32, of) + 0.15 * grain.texels()[k].x
        };
        (0..(of.x * of.y) as usize).map(at).collect::<Vec<f32>>()
    };
    let low_depth = depths(low, 3);
    let color = noise(low, 4);
    let normal = unit_normals(low, 5);
    let with = |of: &Frame<Vec4>| {
        let texels = of.texels().iter().zip(&low_depth).map(|(t, z)| t.truncate().extend(*z));
        Frame::new(low, texels.collect())
    };
    Low {
        packed: with(&color),
        surface: with(&normal),
        depth: Frame::new(size, depths(size, 6).into_iter().map(Vec4::splat).collect()),
        normal: unit_normals(size, 9),
        color,
    }
}

#[test]
fn upsampling_is_near_on_the_screen_times_gaussians() {
    let gpu = bench();
    for size in SIZES {
        for (factor, word, pixels) in [(Factor::Twice, "twice", 2u32), (Factor::FourTimes, "four-times", 4)] {
            let low = low(size, pixels);
            for (reads, reads_word) in [
                (Reads::Packed, "packed"),
                (Reads::Apart, "apart"),
                (Reads::Naive, "naive"),
            ] {
                for (payload, payload_word, normals, screen) in [
                    (Payload::Scalar, "scalar", false, Screen::Tent),
                    (Payload::Color, "color", false, Screen::Tent),
                    (Payload::Color, "color", false, Screen::Gaussian),
                    (Payload::Color, "color", true, Screen::Tent),
                ] {
                    if normals && reads == Reads::Packed {
                        continue;
                    }
                    let gaussian = screen == Screen::Gaussian;
                    let screen_word = if gaussian { "gaussian" } else { "tent" };
                    let cfg = Upsampling {
                        factor,
                        reads,
                        payload,
                        normals,
                        screen,
                        ..Upsampling::default()
                    };
                    let image = if reads == Reads::Packed {
                        &low.packed
                    } else {
                        &low.color
                    };
                    let (depth, normal) = (components(&low.depth, |t| t.x), components(&low.normal, Vec4::truncate));
                    let texture = |f: &Frame<Vec4>| Texture::new(f.size(), f.texels().to_vec());
                    let (low_texture, surface) = (texture(image), texture(&low.surface));
                    let mut payload_image = picture(image);
                    for texel in &mut payload_image.texels {
                        match (payload, reads) {
                            (Payload::Scalar, _) => *texel = [texel[0]; 4],
                            (_, Reads::Packed) => texel[3] = 1.0,
                            _ => {}
                        }
                    }
                    let (surface_picture, depth_picture) = (picture(&low.surface), picture(&low.depth));
                    let normal_picture = picture(&low.normal);
                    let inputs = Inputs::new(size)
                        .with_image("low", image.clone())
                        .with_image("low_surface", low.surface.clone())
                        .with_image("depth", low.depth.clone())
                        .with_image("normal", low.normal.clone());
                    let by_definition = defined(size, |at| {
                        let inputs = quads::Upsampled {
                            factor: pixels.into(),
                            low: &payload_image,
                            surface: &surface_picture,
                            depth: &depth_picture,
                            normal: &normal_picture,
                            depth_sigma: cfg.depth_sigma.into(),
                            normal_sigma: normals.then_some(cfg.normal_sigma.into()),
                            screen_sigma: gaussian.then_some(cfg.screen_sigma.into()),
                        };
                        quads::upsample_pixel(&inputs, at)
                    });
                    check(
                        &gpu,
                        [
                            &format!("upsampling {word} {reads_word} {payload_word} normals {normals} {screen_word}"),
                            "quad_upsampling",
                        ],
                        &[
                            ("factor", word),
                            ("reads", reads_word),
                            ("payload", payload_word),
                            ("normals", if normals { "true" } else { "false" }),
                            ("screen", screen_word),
                        ],
                        &inputs,
                        &native(size, |pixel| {
                            quad_upsampling(&cfg, &low_texture, &surface, &depth, &normal, pixel)
                        }),
                        &by_definition,
                        // Weights far down a Gaussian hang on the last bits of depths.
                        [2.0e-4, 2.0e-3],
                    );
                }
            }
        }
    }
}

/// A depth that no texel of low resolution has takes the nearest one's colour, and is no NaN.
#[test]
fn without_a_like_surface_the_nearest_depth_counts() {
    let gpu = bench();
    let size = uvec2(6, 6);
    let low = Frame::new(
        uvec2(4, 4),
        (0..16)
            .map(|k| Vec3::splat(k as f32 / 16.0).extend(10.0 + k as f32))
            .collect(),
    );
    let depth = Frame::new(size, vec![Vec4::splat(1.0e4); 36]);
    let inputs = Inputs::new(size)
        .with_image("low", low.clone())
        .with_image("depth", depth);
    for (transport, stage) in [
        (Some(Transport::Subgroup), Stage::Fragment),
        (Some(Transport::Block), Stage::Compute),
    ] {
        let compiled = compile("quad_upsampling", &[], Unroll::Full, transport);
        let found = gpu.run(&compiled, stage, &inputs).expect("it runs");
        for y in 0..6 {
            for x in 0..6 {
                // The texel to the lower right is the deepest of the four around.
                let expected = low.load(ivec2(x / 2 + 1, y / 2 + 1)).x;
                let color = found.load(ivec2(x, y));
                assert_eq!(
                    color,
                    vec4(expected, expected, expected, 1.0),
                    "at {x}, {y} by {transport:?}"
                );
            }
        }
    }
}

#[test]
fn downsampling_takes_the_nearest_pixel_around_a_corner() {
    let gpu = bench();
    for size in SIZES {
        let (image, depth, normal) = (noise(size, 1), noise(size, 2), unit_normals(size, 3));
        let texture = |f: &Frame<Vec4>| Texture::new(f.size(), f.texels().to_vec());
        let depth_texture = Texture::new(size, depth.texels().iter().map(|t| t.x).collect());
        let normal_texture = Texture::new(size, normal.texels().iter().map(|t| t.truncate()).collect());
        for (factor, word, pixels) in [(Factor::Twice, "twice", 2), (Factor::FourTimes, "four-times", 4)] {
            for (gives, gives_word) in [
                (Gives::Packed, "packed"),
                (Gives::Color, "color"),
                (Gives::Surface, "surface"),
            ] {
                let low = size.map(|n| n.div_ceil(pixels) + 1);
                let inputs = Inputs::new(low)
                    .with_image("image", image.clone())
                    .with_image("depth", depth.clone())
                    .with_image("normal", normal.clone());
                let cfg = Downsampling { factor, gives };
                let (colors, depths, normals) = (picture(&image), picture(&depth), picture(&normal));
                let expected = defined(low, |at| {
                    let (at, z) = quads::downsample_corner(&depths, pixels.into(), at);
                    let (c, n) = (colors.texel_at(at[0], at[1]), normals.texel_at(at[0], at[1]));
                    match gives {
                        Gives::Packed => [c[0], c[1], c[2], z],
                        Gives::Color => c,
                        Gives::Surface => [n[0], n[1], n[2], z],
                    }
                });
                let image = texture(&image);
                let found = native(low, |quad| {
                    quad.map(|at| downsampling(&cfg, &image, &depth_texture, &normal_texture, at))
                });
                assert_eq!(largest(&found, &expected), 0.0);
                let compiled = compile(
                    "downsampling",
                    &[("factor", word), ("gives", gives_word)],
                    Unroll::Full,
                    None,
                );
                for stage in [Stage::Compute, Stage::Fragment] {
                    // A fragment knows no frame, and this kernel asks for none.
                    let shown = gpu.run(&compiled, stage, &inputs).expect("it runs");
                    assert_eq!(
                        largest(&texels(&shown), &expected),
                        0.0,
                        "{word} {gives_word} {stage:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn occlusion_is_shared_with_near_surfaces_alone() {
    let gpu = bench();
    for size in SIZES {
        let depth = components(&noise(size, 12), |t| Vec4::splat(1.0 + t.x));
        let normal = unit_normals(size, 13);
        let (depths, normals) = (picture(&depth), picture(&normal));
        for (sharing, word) in [(Sharing::Quad, "quad"), (Sharing::Alone, "alone")] {
            let cfg = QuadSsao {
                sharing,
                pixel_angle: 0.05,
                ..QuadSsao::default()
            };
            let ao = quads::Ao {
                taps: cfg.taps as usize,
                radius: cfg.radius.into(),
                bias: cfg.bias.into(),
                strength: cfg.strength.into(),
                pixel_angle: cfg.pixel_angle.into(),
                depth_sigma: cfg.depth_sigma.into(),
            };
            let (z, n) = (components(&depth, |t| t.x), components(&normal, Vec4::truncate));
            check(
                &gpu,
                [&format!("ssao {word}"), "quad_ssao"],
                &[("sharing", word), ("pixel-angle", "0.05")],
                &Inputs::new(size)
                    .with_image("depth", depth.clone())
                    .with_image("normal", normal.clone()),
                &native(size, |pixel| quad_ssao(&cfg, &z, &n, size, pixel)),
                &defined(size, |at| {
                    [quads::ssao(&ao, &depths, &normals, sharing == Sharing::Quad, at); 4]
                }),
                [2.0e-4, 2.0e-4],
            );
        }
    }
}

/// In units of the last place of `value`.
fn ulps(a: f32, value: f32) -> f64 {
    let place = f64::from(f32::from_bits(value.to_bits() + 1)) - f64::from(value);
    (f64::from(a) - f64::from(value)).abs() / place
}

#[test]
fn constant_images_stay_constant() {
    let gpu = bench();
    let size = uvec2(9, 7);
    for value in [1.0f32, 0.1, 0.7, 1.0e-3, 3.1e4] {
        let image = Frame::new(size, vec![Vec4::splat(value); 63]);
        let low = Frame::new(uvec2(6, 5), vec![Vec4::splat(value); 30]);
        let depth = noise(size, 17);
        let inputs = Inputs::new(size)
            .with_image("image", image)
            .with_image("low", low.clone())
            .with_image("low_surface", low)
            .with_image("depth", depth);
        for (name, options) in [
            ("quad_convolution", vec![("radius", "1")]),
            ("quad_convolution", vec![("radius", "2")]),
            ("quad_convolution", vec![("radius", "3"), ("weights", "binomial")]),
            ("quad_bilateral", vec![]),
            ("quad_upsampling", vec![("reads", "packed")]),
            ("quad_upsampling", vec![("reads", "apart"), ("factor", "four-times")]),
            ("quad_upsampling", vec![("reads", "naive")]),
        ] {
            for (transport, stage) in [
                (Transport::Subgroup, Stage::Fragment),
                (Transport::Derivatives, Stage::Fragment),
                (Transport::Block, Stage::Compute),
            ] {
                let compiled = compile(name, &options, Unroll::Full, Some(transport));
                let shown = gpu.run(&compiled, stage, &inputs).expect("it runs");
                let off = shown.texels().iter().map(|t| ulps(t.x, value)).fold(0.0, f64::max);
                assert!(
                    off <= 1.0,
                    "{name} {options:?} by {transport}: {value} comes back off by {off} ULP"
                );
            }
        }
    }
}

/// Upsampling of a ramp over one surface is that ramp: its tents add up to a straight line.
#[test]
fn ramps_stay_ramps_when_brought_up() {
    let gpu = bench();
    let size = uvec2(33, 21);
    for (word, factor) in [("twice", 2.0f32), ("four-times", 4.0)] {
        let low_size = (size.as_vec2() / factor).ceil().as_uvec2() + 1;
        let ramp = |x: f32, y: f32| 0.25 + 0.01 * x - 0.007 * y;
        let texel = |k: u32| {
            let at = vec2((k % low_size.x) as f32, (k / low_size.x) as f32) * factor;
            Vec3::splat(ramp(at.x, at.y)).extend(1.0)
        };
        let low = Frame::new(low_size, (0..low_size.x * low_size.y).map(texel).collect());
        let depth = Frame::new(size, vec![Vec4::ONE; (size.x * size.y) as usize]);
        let inputs = Inputs::new(size).with_image("low", low).with_image("depth", depth);
        for (transport, stage) in [
            (Transport::Subgroup, Stage::Fragment),
            (Transport::Derivatives, Stage::Fragment),
            (Transport::Block, Stage::Compute),
        ] {
            let compiled = compile("quad_upsampling", &[("factor", word)], Unroll::Full, Some(transport));
            let shown = gpu.run(&compiled, stage, &inputs).expect("it runs");
            let expected = defined(size, |[x, y]| {
                let v = 0.25 + 0.01 * (x as f64 + 0.5) - 0.007 * (y as f64 + 0.5);
                [v, v, v, 1.0]
            });
            let off = largest(&texels(&shown), &expected);
            assert!(off < 3.0e-7, "{word} by {transport}: off by {off:.2e}");
        }
    }
}

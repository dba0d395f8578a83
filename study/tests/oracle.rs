//! The oracle against numbers worked out by hand, and against the kernel run natively.

use glam::{IVec2, UVec2, Vec3, Vec4, ivec2, uvec2, vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_kernels::sraa as kernel;
use straightline_study::oracle::{
    Falloff, Metric, Normalisation, Pattern, Shading, SraaInputs, SraaParams, all_weights_underflow, sraa,
};

fn layers<T: Copy>(size: UVec2, count: usize, value: impl Fn(usize, usize) -> T) -> FrameLayers<T> {
    let texels = (size.x * size.y) as usize;
    FrameLayers::new(
        (0..count)
            .map(|layer| Frame::new(size, (0..texels).map(|i| value(layer, i)).collect()))
            .collect(),
    )
}

fn image(size: UVec2, value: impl Fn(usize) -> Vec4) -> Frame<Vec4> {
    Frame::new(size, (0..(size.x * size.y) as usize).map(value).collect())
}

/// Weight of each of the 3×3 pixels around one in a uniform region, row by row.
fn uniform_weights(params: &SraaParams) -> [[f64; 3]; 3] {
    let size = uvec2(3, 3);
    let depth = layers(size, 17, |_, _| 4.0);
    let normal = layers(size, 17, |_, _| Vec3::Z);
    let mut weights = [[0.0; 3]; 3];
    for (tap, weight) in weights.iter_mut().flatten().enumerate() {
        let color = image(size, |i| Vec4::splat(if i == tap { 1.0 } else { 0.0 }));
        *weight = sraa(
            &SraaInputs {
                color: &color,
                depth: &depth,
                normal: Some(&normal),
            },
            params,
        )[4][0];
    }
    weights
}

/// Asserts that the weights are the product of `axis` with itself.
fn assert_axis(params: SraaParams, axis: [f64; 3]) {
    let weights = uniform_weights(&params);
    for (y, row) in weights.iter().enumerate() {
        for (x, weight) in row.iter().enumerate() {
            let expected = axis[x] * axis[y];
            assert!(
                (weight - expected).abs() < 1e-12,
                "{params:?} at {x}, {y}: {weight} for {expected}"
            );
        }
    }
}

#[test]
fn uniform_regions_are_blurred_by_known_weights() {
    let params = |pattern, shading, falloff| SraaParams {
        pattern,
        shading,
        falloff,
        ..Default::default()
    };
    // The listing: samples at ∓¼, shading at -¼. The first reaches all three taps, the second only 0 and +1.
    assert_axis(
        params(Pattern::Ordered4, Shading::Sample0, Falloff::None),
        [2.0, 5.0, 5.0].map(|w| w / 12.0),
    );
    assert_axis(
        params(Pattern::Ordered4, Shading::Sample0, Falloff::Tent),
        [0.0, 3.0, 1.0].map(|w| w / 4.0),
    );
    assert_axis(
        params(Pattern::Ordered4, Shading::Centre, Falloff::Tent),
        [1.0, 6.0, 1.0].map(|w| w / 8.0),
    );
    // Samples at ∓¼ of shading at 0 reach two taps each, alike: ½ to the middle and ¼ to either side.
    assert_axis(
        params(Pattern::Ordered4, Shading::Centre, Falloff::None),
        [1.0, 2.0, 1.0].map(|w| w / 4.0),
    );
    // Shading at -⅜, samples 0, ¼, ½, ¾ from it: all three taps of the first, then 0 and +1 of the others.
    assert_axis(
        params(Pattern::Ordered16, Shading::Sample0, Falloff::None),
        [2.0, 11.0, 11.0].map(|w| w / 24.0),
    );
    assert_axis(
        params(Pattern::Ordered16, Shading::Sample0, Falloff::Tent),
        [0.0, 5.0, 3.0].map(|w| w / 8.0),
    );
    // Samples at ∓⅛ and ∓⅜.
    assert_axis(
        params(Pattern::Ordered16, Shading::Centre, Falloff::Tent),
        [1.0, 6.0, 1.0].map(|w| w / 8.0),
    );
}

#[test]
fn latin_weights_are_the_mean_over_its_samples() {
    // Shading at the centre; a tent weighs a tap by 1 - |tap - sample| on each axis. Only a sample in the pixel's
    // quarter next to a diagonal neighbour reaches it: (-2, -6)/16 the one at (-1, -1), with 2/16 · 6/16.
    let weights = uniform_weights(&SraaParams::default());
    let expected = |parts: [f64; 2]| parts[0] / 16.0 * parts[1] / 16.0 / 4.0;
    assert!((weights[0][0] - expected([2.0, 6.0])).abs() < 1e-12);
    assert!((weights[0][2] - expected([6.0, 2.0])).abs() < 1e-12);
    // The middle has all four: each (1 - 2/16)(1 - 6/16).
    assert!((weights[1][1] - 4.0 * expected([14.0, 10.0])).abs() < 1e-12);
    let sum: f64 = weights.iter().flatten().sum();
    assert!((sum - 1.0).abs() < 1e-12);
}

#[test]
fn weights_fall_with_the_difference_of_surfaces() {
    // One row, shading at sample 0, no falloff. All of layer 0 is at depth 1 but the right pixel, at 1.002.
    // tau·m = 500·0.002 = 1, so that pixel weighs 1/e where the others weigh 1.
    let size = uvec2(3, 1);
    let depth = layers(size, 4, |layer, i| if layer == 0 && i == 2 { 1.002 } else { 1.0 });
    let color = image(size, |i| Vec4::splat(if i == 2 { 1.0 } else { 0.0 }));
    let params = SraaParams {
        pattern: Pattern::Ordered4,
        shading: Shading::Sample0,
        metric: Metric::Depth,
        falloff: Falloff::None,
        ..Default::default()
    };
    let step = f64::from(1.002f32) - 1.0;
    let w = (-500.0 * step).exp();
    // The two samples on the left reach three columns, the two on the right the middle and right ones.
    let expected = (w / (2.0 + w) + w / (1.0 + w)) / 2.0;
    for normalisation in [Normalisation::Paper, Normalisation::Shifted] {
        let inputs = SraaInputs {
            color: &color,
            depth: &depth,
            normal: None,
        };
        let result = sraa(
            &inputs,
            &SraaParams {
                normalisation,
                ..params
            },
        );
        assert!((result[1][0] - expected).abs() < 1e-12, "{result:?} for {expected}");
        assert!((w - (-1.0f64).exp()).abs() < 1e-4);
    }
}

#[test]
fn the_larger_of_both_differences_counts() {
    let size = uvec2(1, 1);
    let color = image(size, |_| Vec4::ONE);
    // A tilt by 0.001 radian: 1 - cos = 5e-7, so tau·m = 2.5e-4; only the geometry at sample 3 differs.
    let tilted = Vec3::new(0.001f32.sin(), 0.0, 0.001f32.cos());
    let normal = layers(size, 5, |layer, _| if layer == 3 { tilted } else { Vec3::Z });
    let depth = layers(size, 5, |layer, _| if layer == 3 { 1.25 } else { 1.0 });
    let inputs = SraaInputs {
        color: &color,
        depth: &depth,
        normal: Some(&normal),
    };
    // exp(-tau · 0.25) is below 2⁻¹²⁶ from tau = 349.3 on; with depth of no account it never is.
    let flushed = |tau, depth_scale, metric| {
        let params = SraaParams {
            tau,
            depth_scale,
            metric,
            falloff: Falloff::None,
            ..Default::default()
        };
        all_weights_underflow(&inputs, &params)[0]
    };
    assert!(!flushed(349.0, 1.0, Metric::DepthNormals));
    assert!(flushed(350.0, 1.0, Metric::DepthNormals));
    assert!(!flushed(350.0, 0.0, Metric::DepthNormals));
    // From 16 on all differences are alike: 0.25 times 350 is one of them.
    assert!(!flushed(5.4, 350.0, Metric::Depth));
    assert!(flushed(5.5, 350.0, Metric::Depth));
    // 87.3366 / 5e-7 = 1.7467e8: the normals' part, alone.
    assert!(!flushed(1.746e8, 0.0, Metric::DepthNormals));
    assert!(flushed(1.748e8, 0.0, Metric::DepthNormals));
    assert!(!flushed(1.748e8, 0.0, Metric::Depth));
}

/// One pixel whose sample 1 lies on a surface that no tap has.
#[test]
fn a_lonely_sample_is_lost_in_the_listing_only() {
    let size = uvec2(3, 3);
    let depth = layers(size, 5, |layer, i| if layer == 1 && i == 4 { 9.0 } else { 1.0 });
    let normal = layers(size, 5, |_, _| Vec3::Z);
    let color = image(size, |_| vec4(0.25, 0.5, 0.75, 1.0));
    let inputs = SraaInputs {
        color: &color,
        depth: &depth,
        normal: Some(&normal),
    };
    let lost = all_weights_underflow(&inputs, &SraaParams::default());
    assert_eq!(lost, (0..9).map(|i| i == 4).collect::<Vec<_>>());
    // 500·8 is beyond double precision too.
    let paper = sraa(
        &inputs,
        &SraaParams {
            normalisation: Normalisation::Paper,
            ..Default::default()
        },
    );
    assert!(paper[4][0].is_nan() && paper[3][0] == 0.25);
    let shifted = sraa(&inputs, &SraaParams::default());
    assert!(
        shifted
            .iter()
            .flatten()
            .zip([0.25, 0.5, 0.75, 1.0].iter().cycle())
            .all(|(a, b)| (a - b).abs() < 1e-15)
    );
}

#[test]
fn bad_colours_spoil_nothing_that_gives_them_no_weight() {
    let size = uvec2(5, 1);
    // The rightmost pixel is on another surface, far enough that its weight is 0.
    let depth = layers(size, 5, |_, i| if i == 4 { 100.0 } else { 1.0 });
    let color = image(size, |i| if i == 4 { Vec4::splat(f32::INFINITY) } else { Vec4::ONE });
    let inputs = SraaInputs {
        color: &color,
        depth: &depth,
        normal: None,
    };
    let params = SraaParams {
        metric: Metric::Depth,
        ..Default::default()
    };
    for normalisation in [Normalisation::Paper, Normalisation::Shifted] {
        let result = sraa(
            &inputs,
            &SraaParams {
                normalisation,
                ..params
            },
        );
        assert!(result[3].iter().all(|axis| (axis - 1.0).abs() < 1e-15), "{result:?}");
        assert!(!result[4][0].is_finite());
    }
}

#[test]
fn an_infinite_depth_is_like_any_other() {
    let size = uvec2(3, 1);
    // Sky on the left, a wall on the right; the middle pixel's samples see sky.
    let depth = layers(size, 5, |_, i| if i == 2 { 1.0 } else { f32::INFINITY });
    let color = image(size, |i| Vec4::splat(if i == 2 { 1.0 } else { 0.5 }));
    let inputs = SraaInputs {
        color: &color,
        depth: &depth,
        normal: None,
    };
    let result = sraa(
        &inputs,
        &SraaParams {
            metric: Metric::Depth,
            ..Default::default()
        },
    );
    assert_eq!(result.iter().map(|texel| texel[0]).collect::<Vec<_>>(), [0.5, 0.5, 1.0]);
    let blurred = SraaParams {
        metric: Metric::Depth,
        depth_scale: 0.0,
        ..Default::default()
    };
    assert!((sraa(&inputs, &blurred)[1][0] - 0.5625).abs() < 1e-12);
    let blurred = SraaParams {
        metric: Metric::Depth,
        tau: 0.0,
        ..Default::default()
    };
    assert!((sraa(&inputs, &blurred)[1][0] - 0.5625).abs() < 1e-12);
}

#[test]
#[should_panic(expected = "depth: 5 layers")]
fn a_missing_layer_is_noticed() {
    let size = uvec2(2, 2);
    let (color, depth) = (image(size, |_| Vec4::ONE), layers(size, 4, |_, _| 1.0));
    let params = SraaParams {
        metric: Metric::Depth,
        ..Default::default()
    };
    sraa(
        &SraaInputs {
            color: &color,
            depth: &depth,
            normal: None,
        },
        &params,
    );
}

/// A small deterministic generator of numbers in 0..1.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// The kernel's options as the oracle spells them.
fn kernel_options(params: &SraaParams) -> kernel::Sraa {
    kernel::Sraa {
        pattern: match params.pattern {
            Pattern::Ordered4 => kernel::Pattern::Ordered4,
            Pattern::Latin4 => kernel::Pattern::Latin4,
            Pattern::Ordered16 => kernel::Pattern::Ordered16,
            Pattern::Latin16 => kernel::Pattern::Latin16,
        },
        shading: match params.shading {
            Shading::Sample0 => kernel::Shading::Sample0,
            Shading::Centre => kernel::Shading::Centre,
        },
        metric: match params.metric {
            Metric::DepthNormals => kernel::Metric::DepthNormals,
            Metric::Depth => kernel::Metric::Depth,
        },
        falloff: match params.falloff {
            Falloff::None => kernel::Falloff::None,
            Falloff::Tent => kernel::Falloff::Tent,
        },
        normalisation: match params.normalisation {
            Normalisation::Paper => kernel::Normalisation::Paper,
            Normalisation::Shifted => kernel::Normalisation::Shifted,
        },
        tau: params.tau as f32,
        depth_scale: params.depth_scale as f32,
    }
}

#[test]
fn the_kernel_agrees_for_all_options() {
    let size = uvec2(11, 7);
    let mut noise = Noise(2011);
    let mut depth = Vec::new();
    let mut normal = Vec::new();
    let mut color = Vec::new();
    for _ in 0..17 * size.x * size.y {
        // Three surfaces, each rough enough that weights take every value.
        let surface = (noise.next() * 3.0).floor();
        depth.push(1.0 + 0.05 * surface + 0.002 * noise.next());
        normal.push(Vec3::new(0.1 * surface + 0.03 * noise.next(), 0.03 * noise.next(), 1.0).normalize());
    }
    for _ in 0..size.x * size.y {
        color.push(vec4(noise.next(), noise.next(), noise.next(), 1.0));
    }
    let texels = (size.x * size.y) as usize;
    let gbuffer = kernel::GBuffer {
        depth: layers(size, 17, |layer, i| depth[layer * texels + i]),
        normal: layers(size, 17, |layer, i| normal[layer * texels + i]),
    };
    let color = Frame::new(size, color);
    let inputs = SraaInputs {
        color: &color,
        depth: &gbuffer.depth,
        normal: Some(&gbuffer.normal),
    };
    let mut combinations = 0;
    for_all_options(|params| {
        let exact = sraa(&inputs, &params);
        let options = kernel_options(&params);
        for (index, exact) in exact.iter().enumerate() {
            let pixel: IVec2 = ivec2(index as i32 % size.x as i32, index as i32 / size.x as i32);
            let computed = kernel::sraa(&options, &gbuffer, &color, pixel).to_array();
            for (computed, exact) in computed.into_iter().zip(exact) {
                let error = (f64::from(computed) - exact).abs();
                assert!(error < 2.0e-6, "{params:?} at {pixel}: {computed} for {exact}");
            }
        }
        combinations += 1;
    });
    assert_eq!(combinations, 64);
}

fn for_all_options(mut visit: impl FnMut(SraaParams)) {
    for pattern in Pattern::ALL {
        for shading in Shading::ALL {
            for metric in Metric::ALL {
                for falloff in Falloff::ALL {
                    for normalisation in Normalisation::ALL {
                        visit(SraaParams {
                            pattern: *pattern,
                            shading: *shading,
                            metric: *metric,
                            falloff: *falloff,
                            normalisation: *normalisation,
                            ..Default::default()
                        });
                    }
                }
            }
        }
    }
}

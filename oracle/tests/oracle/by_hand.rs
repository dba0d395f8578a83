//! The oracle against numbers worked out by hand.

use glam::{UVec2, Vec3, Vec4, uvec2, vec4};
use straightline_kernels::prelude::Frame;
use straightline_oracle::oracle::{
    self, Falloff, Metric, NonFinite, Normalisation, Pattern, Resolved, Shading, SraaParams,
};
use straightline_scene::inputs::Inputs;

fn layers(size: UVec2, count: usize, value: impl Fn(usize, usize) -> Vec4) -> Vec<Frame<Vec4>> {
    (0..count).map(|layer| image(size, |i| value(layer, i))).collect()
}

fn image(size: UVec2, value: impl Fn(usize) -> Vec4) -> Frame<Vec4> {
    Frame::new(size, (0..(size.x * size.y) as usize).map(value).collect())
}

/// A picture of colours over depths and normals by layer and pixel.
fn inputs(
    size: UVec2,
    color: impl Fn(usize) -> Vec4,
    depth: impl Fn(usize, usize) -> f32,
    normal: impl Fn(usize, usize) -> Vec3,
) -> Inputs {
    Inputs::new(size)
        .with_image("color", image(size, color))
        .with_layers("depth", layers(size, 17, |layer, i| Vec4::splat(depth(layer, i))))
        .with_layers("normal", layers(size, 17, |layer, i| normal(layer, i).extend(0.0)))
}

fn sraa(inputs: &Inputs, params: &SraaParams) -> Vec<[f64; 4]> {
    resolved(inputs, params).into_iter().map(|pixel| pixel.color).collect()
}

fn resolved(inputs: &Inputs, params: &SraaParams) -> Vec<Resolved> {
    oracle::resolve_sraa(inputs, params).expect("all is there")
}

/// Weight of each of the 3×3 pixels around one in a uniform region, row by row.
fn uniform_weights(params: &SraaParams) -> [[f64; 3]; 3] {
    let mut weights = [[0.0; 3]; 3];
    for (tap, weight) in weights.iter_mut().flatten().enumerate() {
        let color = |i| Vec4::splat(if i == tap { 1.0 } else { 0.0 });
        *weight = sraa(&inputs(uvec2(3, 3), color, |_, _| 4.0, |_, _| Vec3::Z), params)[4][0];
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
fn a_gaussian_weighs_by_the_square_of_the_distance() {
    // Shading at the centre, samples at ∓¼: taps ¼ and ¾ away.
    let params = SraaParams {
        pattern: Pattern::Ordered4,
        falloff: Falloff::Gaussian,
        sigma: 0.5,
        ..Default::default()
    };
    let (near, far) = ((-0.125f64).exp(), (-1.125f64).exp());
    let side = 0.5 * far / (near + far);
    assert_axis(params, [side, 1.0 - 2.0 * side, side]);
}

#[test]
fn weights_fall_with_the_difference_of_surfaces() {
    // A single row, shading at sample 0, no falloff. All of layer 0 is at depth 1 but the right pixel, at 1.002.
    // tau·m = 500·0.002 = 1, so that pixel weighs 1/e where the others weigh 1.
    let inputs = inputs(
        uvec2(3, 1),
        |i| Vec4::splat(if i == 2 { 1.0 } else { 0.0 }),
        |layer, i| if layer == 0 && i == 2 { 1.002 } else { 1.0 },
        |_, _| Vec3::Z,
    );
    let step = f64::from(1.002f32) - 1.0;
    let w = (-500.0 * step).exp();
    // The two samples on the left reach three columns, the two on the right the middle and right ones.
    let expected = (w / (2.0 + w) + w / (1.0 + w)) / 2.0;
    for normalisation in [Normalisation::Paper, Normalisation::Epsilon, Normalisation::Shifted] {
        let params = SraaParams {
            pattern: Pattern::Ordered4,
            shading: Shading::Sample0,
            metric: Metric::Depth,
            falloff: Falloff::None,
            normalisation,
            ..Default::default()
        };
        let result = sraa(&inputs, &params);
        assert!((result[1][0] - expected).abs() < 1e-12, "{result:?} for {expected}");
        assert!((w - (-1.0f64).exp()).abs() < 1e-4);
    }
}

#[test]
fn the_larger_of_both_differences_counts() {
    // A tilt by 0.01 radian: 1 - cos = 5e-5, so tau·m = 2.5e-2; only the geometry at sample 3 differs.
    let tilted = Vec3::new(0.01f32.sin(), 0.0, 0.01f32.cos());
    let inputs = inputs(
        uvec2(1, 1),
        |_| Vec4::ONE,
        |layer, _| if layer == 3 { 1.25 } else { 1.0 },
        |layer, _| if layer == 3 { tilted } else { Vec3::Z },
    );
    // exp(-tau · 0.25) is below 2⁻¹²⁶ from tau = 349.3 on; with depth of no account it never is.
    let flushed = |tau, depth_scale, metric| {
        let params = SraaParams {
            tau,
            depth_scale,
            metric,
            falloff: Falloff::None,
            normalisation: Normalisation::Paper,
            ..Default::default()
        };
        !resolved(&inputs, &params)[0].sure
    };
    assert!(!flushed(349.0, 1.0, Metric::DepthNormals));
    assert!(flushed(350.0, 1.0, Metric::DepthNormals));
    assert!(!flushed(350.0, 0.0, Metric::DepthNormals));
    assert!(!flushed(350.0, 1.0, Metric::Normals));
    // From 16 on all differences are alike: 0.25 times 350 is one of them.
    assert!(!flushed(5.4, 350.0, Metric::Depth));
    assert!(flushed(5.5, 350.0, Metric::Depth));
    // 87.3366 / 5e-5 = 1.7467e6: the normals' part, alone.
    assert!(!flushed(1.746e6, 0.0, Metric::DepthNormals));
    assert!(flushed(1.748e6, 0.0, Metric::DepthNormals));
    assert!(!flushed(1.748e6, 0.0, Metric::Depth));
}

/// An image in which no sample of the middle pixel lies on a surface that a tap has.
fn alone() -> Inputs {
    inputs(
        uvec2(3, 3),
        |_| vec4(0.25, 0.5, 0.75, 1.0),
        |layer, i| if layer < 4 && i == 4 { 9.0 } else { 1.0 },
        |_, _| Vec3::Z,
    )
}

/// Sample 1 of the middle pixel lies on a surface that no tap has.
#[test]
fn a_lonely_sample_is_lost_in_the_listing_only() {
    let inputs = inputs(
        uvec2(3, 3),
        |_| vec4(0.25, 0.5, 0.75, 1.0),
        |layer, i| if layer == 1 && i == 4 { 9.0 } else { 1.0 },
        |_, _| Vec3::Z,
    );
    // 500·8 is beyond double precision too.
    let paper = SraaParams {
        normalisation: Normalisation::Paper,
        non_finite: NonFinite::Spread,
        ..Default::default()
    };
    let lost: Vec<bool> = resolved(&inputs, &paper).iter().map(|pixel| !pixel.sure).collect();
    assert_eq!(lost, (0..9).map(|i| i == 4).collect::<Vec<_>>());
    let listed = sraa(&inputs, &paper);
    assert!(listed[4][0].is_nan() && (listed[3][0] - 0.25).abs() < 1e-12);
    // A quarter of the pixel is black.
    let epsilon = SraaParams {
        normalisation: Normalisation::Epsilon,
        ..paper.clone()
    };
    assert!((sraa(&inputs, &epsilon)[4][1] - 0.375).abs() < 1e-12);
    // Left out, as what is not finite is, it takes nothing from the others; a pixel of such samples alone is transparent black.
    let left_out = SraaParams {
        non_finite: NonFinite::Skip,
        ..epsilon
    };
    assert!((sraa(&inputs, &left_out)[4][1] - 0.5).abs() < 1e-12);
    let alone = alone();
    assert_eq!(sraa(&alone, &left_out)[4], [0.0; 4]);
    assert!((sraa(&alone, &SraaParams::default())[4][1] - 0.5).abs() < 1e-12);
    let shifted = sraa(&inputs, &SraaParams::default());
    let expected = [0.25, 0.5, 0.75, 1.0];
    assert!(
        shifted
            .iter()
            .flatten()
            .zip(expected.iter().cycle())
            .all(|(a, b)| (a - b).abs() < 1e-12)
    );
}

#[test]
fn bad_colours_spoil_nothing_that_gives_them_no_weight_or_leaves_them_out() {
    // The rightmost pixel is on another surface, far enough that its weight is 0.
    let inputs = inputs(
        uvec2(5, 1),
        |i| if i == 4 { Vec4::splat(f32::INFINITY) } else { Vec4::ONE },
        |_, i| if i == 4 { 100.0 } else { 1.0 },
        |_, _| Vec3::Z,
    );
    for normalisation in [Normalisation::Paper, Normalisation::Shifted] {
        for non_finite in [NonFinite::Spread, NonFinite::Skip] {
            let params = SraaParams {
                metric: Metric::Depth,
                normalisation,
                non_finite,
                ..Default::default()
            };
            let result = sraa(&inputs, &params);
            assert!(result[3].iter().all(|axis| (axis - 1.0).abs() < 1e-12), "{result:?}");
            assert_eq!(result[4][0].is_finite(), non_finite == NonFinite::Skip);
        }
    }
}

#[test]
fn an_infinite_depth_is_like_any_other() {
    // Sky on the left, a wall on the right; the middle pixel's samples see sky.
    let inputs = inputs(
        uvec2(3, 1),
        |i| Vec4::splat(if i == 2 { 1.0 } else { 0.5 }),
        |_, i| if i == 2 { 1.0 } else { f32::INFINITY },
        |_, _| Vec3::Z,
    );
    let depth = SraaParams {
        metric: Metric::Depth,
        ..Default::default()
    };
    let result = sraa(&inputs, &depth);
    assert_eq!(result.iter().map(|texel| texel[0]).collect::<Vec<_>>(), [0.5, 0.5, 1.0]);
    for params in [
        SraaParams {
            depth_scale: 0.0,
            ..depth.clone()
        },
        SraaParams { tau: 0.0, ..depth },
    ] {
        assert!((sraa(&inputs, &params)[1][0] - 0.5625).abs() < 1e-12);
    }
}

#[test]
fn a_missing_layer_is_noticed() {
    let inputs = Inputs::new(uvec2(2, 2))
        .with_image("color", image(uvec2(2, 2), |_| Vec4::ONE))
        .with_layers("depth", layers(uvec2(2, 2), 4, |_, _| Vec4::ONE));
    let params = SraaParams {
        metric: Metric::Depth,
        ..Default::default()
    };
    let error = oracle::resolve_sraa(&inputs, &params)
        .expect_err("a layer is missing")
        .to_string();
    assert_eq!(error, "the oracle of SRAA needs `depth`: 5 images");
}

//! Conversions of inputs, constants and outputs in half precision.

use super::*;
use straightline_bench::execute::SamplerState;

/// A row of texels.
fn row(texels: &[Vec4]) -> Inputs {
    let size = uvec2(texels.len() as u32, 1);
    Inputs::new(size).with_image("value", Frame::new(size, texels.to_vec()))
}

/// A kernel of one expression on the texel `v`.
fn expression(text: &str) -> Compiled {
    let text = format!(
        "pub fn k(value: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n    let v = value.load(pixel);\n    {text}\n}}\n"
    );
    compile_text(&text, &Settings::default())
}

fn ask(text: &str, texels: &[Vec4]) -> [Frame<Vec4>; 2] {
    both(&half_bench(), &expression(text), Stage::Compute, &row(texels))
}

/// A bound that half precision does not hold goes on bounding, and what keeps a division from 0/0 goes on doing so.
#[test]
fn constants_stay_finite_and_stay_other_than_zero() {
    let texels = [vec4(f32::INFINITY, 0.0, 1.0, 0.0)];
    let smallest = f16::MIN_POSITIVE_SUBNORMAL.to_f32();
    let expected = vec4(65504.0, smallest, nearest(0.1), -65504.0);
    for found in ask(
        "Vec4::new(v.x.min(1.0e30), v.y.max(1.0e-30), v.z * 0.1, -70000.0)",
        &texels,
    ) {
        assert_eq!(found.load(IVec2::ZERO), expected);
    }
}

/// Integers stay finite too; those between two numbers become either.
#[test]
fn integers_become_numbers() {
    let texels = vec![Vec4::ZERO; 64];
    let text = "let n = pixel.x * 3001;
        Vec4::new(n as f32, -n as f32, (n as u32 * 100_000) as f32, (pixel.x - 30) as f32)";
    let [shown, found] = ask(text, &texels);
    for x in 0..64i32 {
        let n = x * 3001;
        let large = (n as u32).wrapping_mul(100_000);
        let exact =
            [f64::from(n), f64::from(-n), f64::from(large), f64::from(x - 30)].map(|n| n.clamp(-65504.0, 65504.0));
        for (lane, exact) in exact.into_iter().enumerate() {
            let near = f16::from_f64(exact).to_f64();
            assert_eq!(f64::from(found.load(ivec2(x, 0))[lane]), near, "{x}, lane {lane}");
            let off = (f64::from(shown.load(ivec2(x, 0))[lane]) - exact).abs();
            assert!(off < (exact.abs() / 1024.0).max(f64::MIN_POSITIVE), "{x}, lane {lane}");
        }
    }
}

/// As in full precision: truncated, and bounded. What a NaN becomes, drivers do not agree on.
#[test]
fn numbers_become_integers() {
    let texels = [
        vec4(2000.4, -3.9, f32::INFINITY, 0.9),
        vec4(0.7, -60000.0, f32::NEG_INFINITY, 17.5),
    ];
    let text = "Vec4::new((v.x as i32) as f32, (v.y as i32) as f32, (v.z as i32) as f32, (v.w as i32) as f32)";
    let expected = [vec4(2000.0, -3.0, 65504.0, 0.0), vec4(0.0, -60000.0, -65504.0, 17.0)];
    for found in ask(text, &texels) {
        assert_eq!(found.texels(), expected);
    }
}

/// Bits are those of the number as an `f32`, so that tests of them go on holding.
#[test]
fn bits_and_tests_of_bits() {
    let texels = [
        vec4(1.0, f32::INFINITY, f32::NAN, 300.0),
        vec4(-0.333, f32::NEG_INFINITY, 2.0, 200.0),
    ];
    let text = "let high = (v.x.to_bits() >> 21) as f32;
        let low = (v.x.to_bits() & 0x1fff) as f32;
        let finite = if v.y.is_finite() { 1.0 } else { 0.0 };
        let nan = if v.z.is_nan() { 2.0 } else { 0.0 };
        // Finite in f32, and not here.
        let product = if (v.w * v.w).is_finite() { 4.0 } else { 0.0 };
        Vec4::new(high, low, finite + nan + product, f32::from_bits(0x3f80_0000 + pixel.x as u32 * 0x2000))";
    let bits = |x: f32| (nearest(x).to_bits() >> 21) as f32;
    for found in ask(text, &texels) {
        assert_eq!(found.load(ivec2(0, 0)), vec4(bits(1.0), 0.0, 2.0, 1.0));
        assert_eq!(
            found.load(ivec2(1, 0)),
            vec4(found.load(ivec2(1, 0)).x, 0.0, 4.0, 1.0 + 1.0 / 1024.0)
        );
    }
    let [_, found] = ask(text, &texels);
    assert_eq!(found.load(ivec2(1, 0)).x, bits(-0.333));
}

/// Uniforms and buffers are a host's, in `f32`; each number is rounded once.
#[test]
fn uniforms_and_buffers_are_rounded_once() {
    let text =
        "pub fn k(value: &Frame<Vec4>, weights: &Buffer<Vec2>, strength: f32, tint: Vec3, pixel: IVec2) -> Vec4 {
    let v = value.load(pixel);
    let w = weights.load(pixel.x as usize);
    (w * strength).extend(v.x + tint.y).extend(tint.z)
}";
    let compiled = compile_text(text, &Settings::default());
    let inputs = row(&[Vec4::ONE; 3])
        .with_buffer(
            "weights",
            vec![[0.1, 0.2, 0.0, 0.0], [3.0, 5.0, 0.0, 0.0], [1.0e-3, 7.7, 0.0, 0.0]],
        )
        .with_uniform("strength", &[1.5])
        .with_uniform("tint", &[0.0, 0.3, 0.7]);
    let h = f16::from_f64;
    let expected = |w: [f64; 2]| {
        let product = |w: f64| (h(w) * h(1.5)).to_f32();
        vec4(
            product(w[0]),
            product(w[1]),
            (h(1.0) + h(0.3)).to_f32(),
            h(0.7).to_f32(),
        )
    };
    let wanted = [[0.1, 0.2], [3.0, 5.0], [1.0e-3, 7.7]].map(expected);
    let gpu = half_bench();
    let [_, found] = both(&gpu, &compiled, Stage::Compute, &inputs);
    assert_eq!(found.texels(), wanted);
    // Rounding in either direction is a step at most, and in a product two.
    let [shown, _] = both(&gpu, &compiled, Stage::Compute, &inputs);
    for (shown, wanted) in shown.texels().iter().zip(wanted) {
        assert!(
            ((*shown - wanted).abs() / wanted).max_element() < 2.1 / 1024.0,
            "{shown} {wanted}"
        );
    }
    let [shown, found] = both(&gpu, &compiled, Stage::Compute, &held(inputs));
    if rounds_exactly(&gpu) {
        assert_eq!(shown.texels(), found.texels());
    }
}

/// A coordinate in half precision tells 2048 texels apart up to the middle, and then every other one.
#[test]
fn coordinates_are_coarse() {
    let wide = 4096;
    let texels: Vec<Vec4> = (0..wide).map(|x| Vec4::splat((x % 2048) as f32)).collect();
    let text = "pub fn k(image: &Texture<Vec4>, nearest: &Sampler, pixel: IVec2) -> Vec4 {
    let x = (pixel.x as f32 + 0.5) / 4096.0;
    image.sample(nearest, vec2(x, 0.5))
}";
    let compiled = compile_text(text, &Settings::default());
    let size = uvec2(wide, 1);
    let state = SamplerState {
        linear: false,
        ..SamplerState::default()
    };
    let inputs = Inputs::new(size)
        .with_image("image", Frame::new(size, texels))
        .with_sampler("nearest", state);
    let h = f16::from_f64;
    let hit = |x: u32| {
        let place = (h(x.into()) + h(0.5)) / h(4096.0);
        ((place.to_f64() * 4096.0) as u32).min(wide - 1)
    };
    let missed = (0..wide).filter(|x| hit(*x) != *x).count();
    assert!(missed > 1000, "{missed}");
    let gpu = half_bench();
    let [shown, found] = both(&gpu, &compiled, Stage::Compute, &inputs);
    for x in 0..wide {
        let expected = (hit(x) % 2048) as f32;
        assert_eq!(found.load(ivec2(x as i32, 0)).x, expected, "{x}");
        // Coordinates beyond 2048 are integers that half precision does not hold.
        if x < 2048 && rounds_exactly(&gpu) {
            assert_eq!(shown.load(ivec2(x as i32, 0)).x, expected, "{x}");
        }
    }
}

/// A comparison uses the depth texture's precision for the texel, and half precision for the reference.
#[test]
fn references_are_compared_in_full_precision() {
    let text = "pub fn k(shadow: &DepthTexture, less: &ComparisonSampler, pixel: IVec2) -> Vec4 {
    let reference = 0.25 + pixel.x as f32 / 4096.0;
    Vec4::splat(shadow.compare(less, vec2(0.5, 0.5), reference))
}";
    let compiled = compile_text(text, &Settings::default());
    let depth = 0.251;
    let size = uvec2(16, 1);
    let inputs = Inputs::new(size).with_image("shadow", Frame::new(uvec2(1, 1), vec![Vec4::splat(depth)]));
    let h = f16::from_f64;
    for found in both(&half_bench(), &compiled, Stage::Compute, &inputs) {
        for x in 0..16 {
            let reference = h(0.25) + h(x.into()) / h(4096.0);
            let expected = if reference.to_f32() <= depth { 1.0 } else { 0.0 };
            assert_eq!(found.load(ivec2(x, 0)).x, expected, "{x}");
        }
    }
}

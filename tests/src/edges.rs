//! Floats at which functions change their ways: what tables and random kernels try.

/// Zeros, ones and their neighbours, halves, where exponentials end, where integers end, the largest and the smallest
/// numbers, and what is no number.
#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "the floats as they are written")]
pub const FLOATS: [f32; 48] = [
    0.0, -0.0,
    1.0, -1.0, 0.999_999_94, -0.999_999_94, 1.000_000_1, -1.000_000_1,
    0.5, -0.5, 0.499_999_97, 0.500_000_06, 1.5, -1.5, 2.5,
    2.0, -2.0, 3.0, -3.0, 10.0, -10.0,
    // pi / 2, pi.
    1.570_796_4, 3.141_592_7, -3.141_592_7,
    // The end of exp, of sinh, of exp2, and of their subnormal results.
    88.8, -88.8, 104.0, -104.0, 128.0, -126.0, -1000.0,
    // 2^23 - 0.5, 2^24, the ends of i32 and u32.
    8_388_607.5, 16_777_216.0, 2_147_483_500.0, 2_147_483_600.0, -2_147_483_600.0, 4_294_967_300.0,
    // A square that overflows, and the largest numbers.
    2.0e19, f32::MAX, f32::MIN,
    // The smallest number, and subnormal ones.
    f32::MIN_POSITIVE, 1.175_494_2e-38, 5.9e-39, -5.9e-39, 1.0e-45,
    f32::INFINITY, f32::NEG_INFINITY, f32::NAN,
];

/// Halves up to 1000, of which sums and products of a few are the same in any order, as a driver may choose it. A driver
/// may also assume that there is no infinity (WGSL, "Floating Point Evaluation"): lavapipe has x - x for 0. What a function
/// gives on drivers for the other floats, a table says that calls it alone.
pub fn of_drivers() -> Vec<f32> {
    let is_half = |x: &f32| x.abs() <= 1000.0 && (x * 2.0).fract() == 0.0;
    FLOATS.into_iter().filter(is_half).collect()
}

/// Representatives of the others, for tests in which all of them would be too many.
#[rustfmt::skip]
pub const FEW: [f32; 16] = [
    0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -3.0, 3.0, -104.0, 2.0e19, f32::MAX, -5.9e-39, 1.570_796_4, f32::INFINITY, f32::NEG_INFINITY, f32::NAN,
];

#[cfg(test)]
mod tests {
    use super::{FEW, FLOATS};

    #[test]
    fn differ() {
        for (k, x) in FLOATS.iter().enumerate() {
            assert!(
                FLOATS[..k].iter().all(|y| x.to_bits() != y.to_bits()),
                "{x} stands twice"
            );
        }
        assert!(FEW.iter().all(|x| FLOATS.iter().any(|y| x.to_bits() == y.to_bits())));
    }
}

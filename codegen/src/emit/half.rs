//! Literals of half precision.

use super::text::Text;
use half::f16;

/// Returns the `f16` nearest to an `f32`, with the fewest digits that read back as the same number. For numbers out of
/// range see `ir::Real::made`.
pub fn half_literal(bits: u32) -> Text {
    let x = straightline_evaluator::ir::F16::nearest_finite(f32::from_bits(bits).into());
    Text::literal(format!("{}h", shortest_decimal(x)), x.is_sign_negative())
}

/// Returns all digits of an integer. For others, enough digits to read back as the same number, both directly and by way of
/// `f32`, as naga does.
fn shortest_decimal(x: f16) -> String {
    let exact = x.to_f64();
    if exact.fract() == 0.0 {
        return format!("{exact:?}");
    }
    let candidates = (0..8).filter_map(|digits| format!("{exact:.digits$e}").parse::<f64>().ok());
    let mut right = candidates.filter(|v| f16::from_f64(*v) == x && f16::from_f32(*v as f32) == x);
    format!("{:?}", right.next().unwrap_or(exact))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn literal_code(x: f32) -> String {
        half_literal(x.to_bits()).code
    }

    #[test]
    fn few_digits() {
        let cases = [
            (0.1, "0.1h"),
            (1.0, "1.0h"),
            (-0.0, "-0.0h"),
            (2048.0, "2048.0h"),
            (1.0 / 3.0, "0.3333h"),
            (-2.5, "-2.5h"),
        ];
        for (x, expected) in cases {
            assert_eq!(literal_code(x), expected);
        }
    }

    #[test]
    fn what_does_not_fit() {
        assert_eq!(literal_code(1.0e30), "65504.0h");
        assert_eq!(literal_code(-65520.0), "-65504.0h");
        assert_eq!(literal_code(1.0e-12), "6e-8h");
        assert_eq!(literal_code(-1.0e-12), "-6e-8h");
    }

    #[test]
    fn every_number_comes_back() {
        for bits in 0..=u16::MAX {
            let x = f16::from_bits(bits);
            if x.is_finite() {
                let text = literal_code(x.to_f32());
                let digits = text.trim_end_matches('h');
                let back: f16 = digits.parse().expect("a number");
                assert_eq!(back.to_bits(), bits, "{text}");
                assert_eq!(
                    f16::from_f64(digits.parse().expect("a number")).to_bits(),
                    bits,
                    "{text}"
                );
                assert!(text.contains('.') || text.contains('e'), "{text}");
            }
        }
    }
}

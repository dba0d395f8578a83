//! The transfer function of sRGB (IEC 61966-2-1).

/// Linear light of an sRGB value, both in 0..=1.
pub fn to_linear(value: f32) -> f32 {
    if value <= 0.040_45 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

/// sRGB value of linear light, both in 0..=1.
pub fn from_linear(light: f32) -> f32 {
    if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    }
}

/// Bytes of a texel of linear RGB and alpha, in sRGB; alpha stays linear. Clamped to 0..=1; NaN becomes 0.
pub fn to_srgb8(texel: [f32; 4]) -> [u8; 4] {
    // A cast from float to integer saturates, and takes NaN to 0.
    let byte = |value: f32| (value * 255.0).round() as u8;
    let color = |light: f32| byte(from_linear(light.clamp(0.0, 1.0)));
    let [r, g, b, a] = texel;
    [color(r), color(g), color(b), byte(a)]
}

/// Linear texel of one in sRGB whose components are 0 to 1.
pub fn from_srgb(texel: [f32; 4]) -> [f32; 4] {
    let [r, g, b, a] = texel;
    [to_linear(r), to_linear(g), to_linear(b), a]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // Linear 0.18 (photographer's grey) is 118 of 255, sRGB 128 is 0.2158 of white.
        assert_eq!((from_linear(0.18) * 255.0).round(), 118.0);
        assert!((to_linear(128.0 / 255.0) - 0.215_86).abs() < 1e-5);
        assert_eq!((from_linear(0.0), to_linear(0.0)), (0.0, 0.0));
        assert!((from_linear(1.0) - 1.0).abs() < 1e-6 && (to_linear(1.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn every_byte_survives_the_round_trip() {
        for byte in 0..=255u8 {
            assert_eq!(
                (from_linear(to_linear(f32::from(byte) / 255.0)) * 255.0).round() as u8,
                byte
            );
        }
    }
}

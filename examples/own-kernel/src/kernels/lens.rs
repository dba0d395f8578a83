//! A cheap lens: colours separate and light falls off towards the corners.

use straightline_kernels::prelude::*;

/// The image as a bad lens shows it; worse with a larger `strength` (0 to 1).
pub fn lens(image: &Texture<Vec4>, linear: &Sampler, strength: f32, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2();
    let away = uv - 0.5;
    let mut colour = Vec3::ZERO;
    for band in 0..3 {
        // Red is refracted least, blue most.
        let bend = 1.0 - strength * 0.03 * (band as f32 - 1.0);
        let seen = image.sample(linear, 0.5 + away * bend);
        colour += [Vec3::X, Vec3::Y, Vec3::Z][band] * seen[band];
    }
    (colour * light(away, strength)).extend(1.0)
}

/// The part of the light that arrives `away` from the middle.
fn light(away: Vec2, strength: f32) -> f32 {
    1.0 - strength * smoothstep(0.1, 0.5, away.length_squared())
}

// `cargo test` runs them natively, and `straightline test src/kernels/lens.rs` as shaders.
#[cfg(test)]
mod tests {
    use super::*;
    use straightline_kernels::testing::*;

    #[test]
    fn light_is_from_none_to_all() {
        for_all_in((-0.5..=0.5, unit()), |away: Vec2, strength: f32| {
            assert!(light(away, strength) >= 0.0);
            assert!(light(away, strength) <= 1.0);
        });
    }

    #[test]
    fn a_lens_without_strength_takes_no_light() {
        for_all_in(-0.5..=0.5, |away: Vec2| assert_close(light(away, 0.0), 1.0, ulp(0)));
    }

    #[test]
    fn a_chart_is_bent_and_split() {
        let size = uvec2(96, 54);
        let chart: Texture<Vec4> = draw(size, |pixel| squares(pixel));
        let linear = Sampler::default();
        assert_picture("lens.png", size, |pixel| lens(&chart, &linear, 1.0, size, pixel), psnr(50.0));
    }

    /// White squares with black lines between them.
    fn squares(pixel: IVec2) -> Vec4 {
        let is_line = pixel.x % 8 == 0 || pixel.y % 9 == 0;
        Vec3::splat(if is_line { 0.0 } else { 1.0 }).extend(1.0)
    }
}

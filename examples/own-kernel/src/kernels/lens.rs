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
    let light = 1.0 - strength * smoothstep(0.1, 0.5, away.length_squared());
    (colour * light).extend(1.0)
}

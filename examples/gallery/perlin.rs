//! Improved noise (Perlin, Improving noise, 2002) in several octaves. The permutation is a hash.

use straightline_kernels::prelude::*;

/// Eight hash bits for a lattice corner (PCG: Jarzynski and Olano, Hash functions for GPU rendering, 2020).
fn hash(corner: IVec3) -> u32 {
    let word = (corner.x as u32)
        .wrapping_mul(1_664_525)
        .wrapping_add((corner.y as u32).wrapping_mul(22_695_477))
        .wrapping_add((corner.z as u32).wrapping_mul(1_103_515_245))
        .wrapping_add(1_013_904_223);
    let word = ((word >> ((word >> 28) + 4)) ^ word).wrapping_mul(277_803_737);
    ((word >> 22) ^ word) & 255
}

/// Dot product with one of the twelve directions from a cube's centre to its edges.
fn gradient(hash: u32, at: Vec3) -> f32 {
    let (x, y, z) = (at.x, at.y, at.z);
    match hash & 15 {
        0 | 12 => x + y,
        1 | 14 => -x + y,
        2 => x - y,
        3 => -x - y,
        4 => x + z,
        5 => -x + z,
        6 => x - z,
        7 => -x - z,
        8 => y + z,
        9 | 13 => -y + z,
        10 => y - z,
        _ => -y - z,
    }
}

fn fade(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Noise between -1 and 1, and 0 on the lattice.
fn noise(at: Vec3) -> f32 {
    let floor = at.floor();
    let corner = floor.as_ivec3();
    let inside = at - floor;
    let ease = inside.map(fade);
    let mut values = [0.0; 8];
    for (k, value) in values.iter_mut().enumerate() {
        let step = ivec3(k as i32 & 1, (k as i32 >> 1) & 1, k as i32 >> 2);
        *value = gradient(hash(corner + step), inside - step.as_vec3());
    }
    let row = |k: usize| mix(values[k], values[k + 1], ease.x);
    mix(mix(row(0), row(2), ease.y), mix(row(4), row(6), ease.y), ease.z)
}

/// Sums octaves of noise, each twice as fine and half as strong. `scale` is the size of the coarsest in pixels.
pub fn perlin(scale: f32, depth: f32, octaves: i32, pixel: IVec2) -> Vec4 {
    let mut at = (pixel.as_vec2() / scale).extend(depth);
    let (mut sum, mut share) = (0.0, 0.5);
    for _ in 0..octaves.clamp(1, 8) {
        sum += share * noise(at);
        at *= 2.0;
        share *= 0.5;
    }
    Vec3::splat(0.5 + 0.5 * sum).extend(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_kernels::testing::*;

    #[test]
    fn noise_is_none_on_the_lattice() {
        for_all_in(-1000..=1000, |corner: IVec3| assert_eq!(noise(corner.as_vec3()), 0.0));
    }

    #[test]
    fn noise_is_from_minus_one_to_one() {
        for_all_in(-100.0..=100.0, |at: Vec3| assert!(noise(at).abs() <= 1.0));
    }

    #[test]
    fn octaves_draw_clouds() {
        assert_picture(
            "golden/perlin.png",
            uvec2(64, 36),
            |pixel| perlin(16.0, 0.5, 4, pixel),
            psnr(45.0),
        );
    }
}

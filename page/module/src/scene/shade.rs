//! Light: a sun with sharp shadows, a sky, and what shines.

use super::solids::{Hit, Material, first_hit};
use glam::{Vec3, vec3};

/// Towards the sun, of length 1.
const SUN: Vec3 = vec3(-0.46, 0.69, -0.559);
const SUNLIGHT: Vec3 = vec3(1.75, 1.5, 1.18);
const ZENITH: Vec3 = vec3(0.07, 0.20, 0.48);
const HORIZON: Vec3 = vec3(0.55, 0.66, 0.76);

/// The sky in a direction.
pub fn sky(direction: Vec3) -> Vec3 {
    let up = direction.normalize().y.max(0.0);
    HORIZON.lerp(ZENITH, (up * 2.2).min(1.0).sqrt())
}

/// Returns the colour of the surface that a ray hits.
pub fn shade_hit(at: Vec3, direction: Vec3, met: &Hit) -> Vec3 {
    let (albedo, shine) = hit_material(at, met);
    let normal = met.normal;
    let towards = normal.dot(SUN);
    let lit = towards > 0.0 && first_hit(at + normal * 2.0e-3, SUN, 100.0).is_none();
    let sun = match lit {
        true => SUNLIGHT * towards,
        false => Vec3::ZERO,
    };
    let around = ZENITH.lerp(HORIZON, 0.5) * (0.36 + 0.30 * normal.y) + vec3(0.05, 0.045, 0.04);
    let mirrored = direction.normalize() - 2.0 * direction.normalize().dot(normal) * normal;
    let glint = match lit {
        true => SUNLIGHT * mirrored.dot(SUN).max(0.0).powi(48) * shine,
        false => Vec3::ZERO,
    };
    let reflected = sky(mirrored) * shine * 0.18;
    let fog = 1.0 - (-0.012 * met.distance).exp();
    (albedo * (sun + around) + glint + reflected).lerp(HORIZON, fog)
}

/// Colour, and how much it shines.
fn hit_material(at: Vec3, met: &Hit) -> (Vec3, f32) {
    match met.material {
        Material::Plain(colour, shine) => (colour, shine),
        Material::Tiles => {
            let odd = ((at.x * 1.25).floor() + (at.z * 1.25).floor()) as i32 & 1;
            let base = vec3(0.33, 0.31, 0.27);
            (if odd == 1 { base } else { base * 0.72 }, 0.02)
        }
        Material::Wall => {
            let across = if met.normal.x.abs() > met.normal.z.abs() {
                at.z
            } else {
                at.x
            };
            let (column, row) = ((across * 2.6).rem_euclid(1.0), (at.y * 1.9).rem_euclid(1.0));
            let window = (0.3..0.7).contains(&column) && (0.25..0.75).contains(&row) && met.normal.y.abs() < 0.5;
            match window {
                true => (vec3(0.05, 0.08, 0.12), 0.5),
                false => (vec3(0.52, 0.36, 0.28), 0.03),
            }
        }
    }
}

//! The colour of one point from what a G-buffer knows of it. `shade.wgsl` says the same line by line.

use super::frame::{Lighting, Ray};
use super::lamps;
use super::patterns::{dots, slats, tiles};
use crate::scene::{EMISSION, Material, SKY_DEPTH};
use glam::{Vec3, Vec3Swizzles, Vec4};

/// A sample of a G-buffer.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Unit normal in view space.
    pub normal: Vec3,
    /// Linear, along the view.
    pub depth: f32,
    /// Linear RGB that is reflected, 0 to 1.
    pub color: Vec3,
    /// A material's number.
    pub material: f32,
}

impl Surface {
    /// Surface of the sky, where there is no geometry.
    pub const SKY: Surface = Surface {
        normal: Vec3::Z,
        depth: SKY_DEPTH,
        color: Vec3::ZERO,
        material: 0.0,
    };
}

/// Linear colour of a surface seen along `ray`, which has depth 1.
pub(super) fn shade_surface(lighting: &Lighting, surface: &Surface, ray: Ray) -> Vec3 {
    shade_sunlit(lighting, surface, ray, sun_visibility(lighting, surface, ray))
}

/// Returns the light that the sun adds to a shaded surface where no shadow falls.
pub(super) fn direct_light(lighting: &Lighting, surface: &Surface, ray: Ray) -> Vec3 {
    shade_sunlit(lighting, surface, ray, 1.0) - shade_sunlit(lighting, surface, ray, 0.0)
}

/// Returns a surface's inputs of a filter that takes light apart from paint and shadow: its albedo, as a sample of a G-buffer
/// has it, and in the fourth component whether the sun reaches it, 1 or 0. Of an emissive surface the albedo is the light that
/// it emits; of the sky 1.
pub(super) fn surface_paint(lighting: &Lighting, surface: &Surface, ray: Ray) -> Vec4 {
    if surface.depth >= SKY_DEPTH {
        return Vec4::ONE;
    }
    let reflected = match surface.material as u32 == Material::Emissive as u32 {
        true => surface.color * EMISSION,
        false => surface_albedo(lighting, surface, ray),
    };
    reflected.extend(sun_visibility(lighting, surface, ray))
}

/// Part of a scene's light that a guide knows: each has all that those before it have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum GuideLight {
    /// The sun's diffuse light with its shadows, and one constant of ambient light for all directions.
    Diffuse,
    /// The sun's highlight.
    #[default]
    Sun,
    /// Ambient light by direction.
    Ambient,
    /// The diffuse light of lamps, as if nothing cast a shadow.
    Lamps,
    /// The shadows of lamps. All that is missing are their highlights.
    Shadows,
}

impl GuideLight {
    /// From the least to the most.
    pub const ALL: [GuideLight; 5] = [Self::Diffuse, Self::Sun, Self::Ambient, Self::Lamps, Self::Shadows];
}

/// Returns an estimate of a surface's colour: what `known` has of the light, emission, and haze. The sky is its own estimate, so that
/// nothing jumps where haze meets it.
pub(super) fn guide(lighting: &Lighting, surface: &Surface, ray: Ray, known: GuideLight) -> Vec3 {
    if surface.depth >= SKY_DEPTH {
        return sky(lighting, ray.along.normalize()).clamp(Vec3::ZERO, Vec3::ONE);
    }
    if surface.material as u32 == Material::Emissive as u32 {
        return through_haze(lighting, surface, ray, surface.color * EMISSION);
    }
    let facing = surface.normal.dot(lighting.sun_direction.truncate()).max(0.0);
    let facing = facing * sun_visibility(lighting, surface, ray);
    let sun = lighting.sun_color.truncate();
    let mut diffuse = sun * facing;
    let mut specular = Vec3::ZERO;
    if known >= GuideLight::Sun {
        specular = sun * highlight(lighting, surface, ray, facing);
    }
    diffuse += match known >= GuideLight::Ambient {
        true => ambient_light(lighting, surface),
        false => (0.5 * (lighting.ground + lighting.zenith) + lighting.environment[0]).truncate(),
    };
    if known >= GuideLight::Lamps {
        diffuse += lamp_light(lighting, surface, ray, known >= GuideLight::Shadows).diffuse;
    }
    through_haze(
        lighting,
        surface,
        ray,
        surface_albedo(lighting, surface, ray) * diffuse + specular,
    )
}

/// Returns the light of a surface, and of the haze before it.
fn through_haze(lighting: &Lighting, surface: &Surface, ray: Ray, lit: Vec3) -> Vec3 {
    let clear = (-lighting.sun_direction.w * surface.depth * ray.along.length()).exp2();
    lighting.horizon.truncate().lerp(lit, clear)
}

/// Returns the sun's highlight on a surface that faces as much of its light.
fn highlight(lighting: &Lighting, surface: &Surface, ray: Ray, facing: f32) -> f32 {
    let halfway = (-ray.along.normalize() + lighting.sun_direction.truncate()).normalize();
    facing * gloss(surface.material as u32, surface.normal.dot(halfway).max(0.0))
}

/// Returns the share of light that a material reflects at a cosine of the angle from its normal to halfway between light and eye.
fn gloss(material: u32, s1: f32) -> f32 {
    let s2 = s1 * s1;
    let s4 = s2 * s2;
    let s8 = s4 * s4;
    let s16 = s8 * s8;
    let s32 = s16 * s16;
    let mut specular = 0.08 * s16;
    if material == Material::Glossy as u32 {
        let s64 = s32 * s32;
        let s128 = s64 * s64;
        specular += 6.0 * s128 * s128;
    }
    if material == Material::Studded as u32 {
        specular += 0.5 * s32;
    }
    specular
}

/// Returns ambient light on a white surface.
fn ambient_light(lighting: &Lighting, surface: &Surface) -> Vec3 {
    let upwards = 0.5 + 0.5 * surface.normal.dot(lighting.up.truncate());
    let ambient = lighting.ground.truncate().lerp(lighting.zenith.truncate(), upwards);
    ambient + lamps::environment(lighting, to_world(lighting, surface.normal))
}

/// Returns the light of all lamps on a surface.
fn lamp_light(lighting: &Lighting, surface: &Surface, ray: Ray, shadows: bool) -> lamps::Light {
    let receiver = lamps::Receiver {
        place: world_position(lighting, surface, ray),
        normal: to_world(lighting, surface.normal),
        view: to_world(lighting, -ray.along.normalize()),
    };
    lamps::light(lighting, &receiver, shadows, |cosine| {
        gloss(surface.material as u32, cosine)
    })
}

/// Turns a direction of view space to world space.
fn to_world(lighting: &Lighting, direction: Vec3) -> Vec3 {
    (lighting.to_world * direction.extend(0.0)).truncate()
}

/// Returns the place of a surface in the world.
fn world_position(lighting: &Lighting, surface: &Surface, ray: Ray) -> Vec3 {
    (lighting.to_world * ray.at(surface.depth).extend(1.0)).truncate()
}

/// Linear RGB that a surface reflects, with what its material paints on it.
fn surface_albedo(lighting: &Lighting, surface: &Surface, ray: Ray) -> Vec3 {
    let is = |material: Material| surface.material as u32 == material as u32;
    let place = world_position(lighting, surface, ray);
    if is(Material::Tiles) {
        let facing = surface.normal.dot(-ray.along.normalize()).max(0.05);
        return surface.color * tiles(place.xz(), lighting.pixel_size(surface.depth) / facing);
    }
    if is(Material::Dots) {
        return surface.color * dots(place);
    }
    surface.color
}

/// The share of the sun's light that reaches a surface: 0 in a shadow, else 1.
fn sun_visibility(lighting: &Lighting, surface: &Surface, ray: Ray) -> f32 {
    let towards_sun = to_world(lighting, lighting.sun_direction.truncate());
    let place = world_position(lighting, surface, ray);
    if surface.material as u32 == Material::Slats as u32 {
        return slats(place, towards_sun);
    }
    lamps::visibility(lighting, place, towards_sun, f32::INFINITY)
}

/// Linear colour of a surface that a share `visible` of the sun's light reaches.
fn shade_sunlit(lighting: &Lighting, surface: &Surface, ray: Ray, visible: f32) -> Vec3 {
    if surface.depth >= SKY_DEPTH {
        return sky(lighting, ray.along.normalize()).clamp(Vec3::ZERO, Vec3::ONE);
    }
    let is = |material: Material| surface.material as u32 == material as u32;
    let albedo = surface_albedo(lighting, surface, ray);
    let sun = lighting.sun_color.truncate();
    let facing = surface.normal.dot(lighting.sun_direction.truncate()).max(0.0) * visible;
    let ambient = ambient_light(lighting, surface);
    let specular = highlight(lighting, surface, ray, facing);
    let mut lit = albedo * (ambient + sun * facing) + sun * specular;
    let mut most = 1.0;
    if is(Material::Glossy) || is(Material::Studded) || lighting.counts.x > 0 {
        most = MOST;
    }
    if lighting.counts.x > 0 {
        let lamps = lamp_light(lighting, surface, ray, true);
        lit += albedo * lamps.diffuse + lamps.specular;
    }
    if is(Material::Emissive) {
        lit = surface.color * EMISSION;
        most = MOST;
    }
    through_haze(lighting, surface, ray, lit).clamp(Vec3::ZERO, Vec3::splat(most))
}

/// The largest half: what a texture of 16 bits holds.
const MOST: f32 = 65504.0;

/// The sky in a direction.
fn sky(lighting: &Lighting, towards: Vec3) -> Vec3 {
    let height = towards.dot(lighting.up.truncate()).clamp(0.0, 1.0);
    let thin = 1.0 - height;
    lighting
        .zenith
        .truncate()
        .lerp(lighting.horizon.truncate(), thin * thin * thin)
}

//! The colour of one point from what a G-buffer knows of it. `shade.wgsl` says the same line by line.

use super::frame::Lighting;
use crate::scene::{EMISSION, Material, SKY_DEPTH};
use glam::{Vec2, Vec3, Vec3Swizzles, Vec4, vec2, vec3};

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
pub(super) fn shade_surface(lighting: &Lighting, surface: &Surface, ray: Vec3) -> Vec3 {
    shade_sunlit(lighting, surface, ray, sun_visibility(lighting, surface, ray))
}

/// Returns the light that the sun adds to a shaded surface where no shadow falls.
pub(super) fn direct_light(lighting: &Lighting, surface: &Surface, ray: Vec3) -> Vec3 {
    shade_sunlit(lighting, surface, ray, 1.0) - shade_sunlit(lighting, surface, ray, 0.0)
}

/// Returns a surface's inputs of a filter that takes light apart from paint and shadow: its albedo, as a sample of a G-buffer
/// has it, and in the fourth component whether the sun reaches it, 1 or 0. Of an emissive surface the albedo is the light that
/// it emits; of the sky 1.
pub(super) fn surface_paint(lighting: &Lighting, surface: &Surface, ray: Vec3) -> Vec4 {
    if surface.depth >= SKY_DEPTH {
        return Vec4::ONE;
    }
    let reflected = match surface.material as u32 == Material::Emissive as u32 {
        true => surface.color * EMISSION,
        false => surface_albedo(lighting, surface, ray),
    };
    reflected.extend(sun_visibility(lighting, surface, ray))
}

/// Returns an estimate of a surface's colour: the sun with its highlight, one constant of ambient light for all directions, emission, and
/// haze. The sky is its own estimate, so that nothing jumps where haze meets it.
pub(super) fn guide(lighting: &Lighting, surface: &Surface, ray: Vec3) -> Vec3 {
    if surface.depth >= SKY_DEPTH {
        return sky(lighting, ray.normalize()).clamp(Vec3::ZERO, Vec3::ONE);
    }
    if surface.material as u32 == Material::Emissive as u32 {
        return through_haze(lighting, surface, ray, surface.color * EMISSION);
    }
    let facing = surface.normal.dot(lighting.sun_direction.truncate()).max(0.0);
    let facing = facing * sun_visibility(lighting, surface, ray);
    let sun = lighting.sun_color.truncate();
    let ambient = 0.5 * (lighting.ground + lighting.zenith).truncate();
    let reflected = surface_albedo(lighting, surface, ray) * (ambient + sun * facing);
    let lit = reflected + sun * highlight(lighting, surface, ray, facing);
    through_haze(lighting, surface, ray, lit)
}

/// Returns the light of a surface, and of the haze before it.
fn through_haze(lighting: &Lighting, surface: &Surface, ray: Vec3, lit: Vec3) -> Vec3 {
    let clear = (-lighting.sun_direction.w * surface.depth * ray.length()).exp2();
    lighting.horizon.truncate().lerp(lit, clear)
}

/// Returns the sun's highlight on a surface that faces as much of its light.
fn highlight(lighting: &Lighting, surface: &Surface, ray: Vec3, facing: f32) -> f32 {
    let view = -ray.normalize();
    let halfway = (view + lighting.sun_direction.truncate()).normalize();
    let s1 = surface.normal.dot(halfway).max(0.0);
    let s2 = s1 * s1;
    let s4 = s2 * s2;
    let s8 = s4 * s4;
    let s16 = s8 * s8;
    let mut specular = 0.08 * s16 * facing;
    if surface.material as u32 == Material::Glossy as u32 {
        let s32 = s16 * s16;
        let s64 = s32 * s32;
        let s128 = s64 * s64;
        specular += 6.0 * s128 * s128 * facing;
    }
    specular
}

/// Returns the place of a surface in the world.
fn world_position(lighting: &Lighting, surface: &Surface, ray: Vec3) -> Vec3 {
    (lighting.to_world * (ray * surface.depth).extend(1.0)).truncate()
}

/// Linear RGB that a surface reflects, with what its material paints on it.
fn surface_albedo(lighting: &Lighting, surface: &Surface, ray: Vec3) -> Vec3 {
    let is = |material: Material| surface.material as u32 == material as u32;
    let place = world_position(lighting, surface, ray);
    if is(Material::Tiles) {
        let footprint = surface.depth * lighting.extent.z / surface.normal.dot(-ray.normalize()).max(0.05);
        return surface.color * tiles(place.xz(), footprint);
    }
    if is(Material::Dots) {
        return surface.color * dots(place);
    }
    surface.color
}

/// The share of the sun's light that reaches a surface: 0 in the shadow of slats, else 1.
fn sun_visibility(lighting: &Lighting, surface: &Surface, ray: Vec3) -> f32 {
    if surface.material as u32 != Material::Slats as u32 {
        return 1.0;
    }
    let towards_sun = lighting.to_world * lighting.sun_direction.truncate().extend(0.0);
    slats(world_position(lighting, surface, ray), towards_sun.truncate())
}

/// Linear colour of a surface that a share `visible` of the sun's light reaches.
fn shade_sunlit(lighting: &Lighting, surface: &Surface, ray: Vec3, visible: f32) -> Vec3 {
    let view = -ray.normalize();
    if surface.depth >= SKY_DEPTH {
        return sky(lighting, -view).clamp(Vec3::ZERO, Vec3::ONE);
    }
    let is = |material: Material| surface.material as u32 == material as u32;
    let normal = surface.normal;
    let albedo = surface_albedo(lighting, surface, ray);
    let sun = lighting.sun_color.truncate();
    let facing = normal.dot(lighting.sun_direction.truncate()).max(0.0) * visible;
    let upwards = 0.5 + 0.5 * normal.dot(lighting.up.truncate());
    let ambient = lighting.ground.truncate().lerp(lighting.zenith.truncate(), upwards);
    let specular = highlight(lighting, surface, ray, facing);
    let mut most = 1.0;
    if is(Material::Glossy) {
        most = MOST;
    }
    let mut lit = albedo * (ambient + sun * facing) + sun * specular;
    if is(Material::Emissive) {
        lit = surface.color * EMISSION;
        most = MOST;
    }
    through_haze(lighting, surface, ray, lit).clamp(Vec3::ZERO, Vec3::splat(most))
}

/// The largest half: what a texture of 16 bits holds.
const MOST: f32 = 65504.0;

/// 1 where the sun shines through the slats above, else 0. Not averaged over a pixel: an edge of shading alone.
fn slats(place: Vec3, towards_sun: Vec3) -> f32 {
    let shadow = place.x - towards_sun.x / towards_sun.y.max(0.05) * place.y;
    let share = 2.0 * shadow;
    if share - share.floor() < 0.45 { 0.0 } else { 1.0 }
}

/// Paint on a surface: dark blue balls in a grid of them, cut by it. Not averaged over a pixel: an edge of shading alone.
fn dots(place: Vec3) -> Vec3 {
    let cell = place * 3.0 + 0.4;
    let away = cell - cell.floor() - 0.5;
    if away.dot(away) < 0.18 {
        vec3(0.10, 0.16, 0.45)
    } else {
        Vec3::ONE
    }
}

/// Returns whether a place on a [`Material::ChainLink`] is one of its wires, which cross at right angles. `geometry.wgsl` says
/// the same.
pub(super) fn is_wire(place: Vec3) -> bool {
    let along = place.x + place.z;
    let wire = |across: f32| {
        let at = across * 8.0;
        at - at.floor() < 0.14
    };
    wire(along + place.y) || wire(along - place.y)
}

/// The sky in a direction.
fn sky(lighting: &Lighting, towards: Vec3) -> Vec3 {
    let height = towards.dot(lighting.up.truncate()).clamp(0.0, 1.0);
    let thin = 1.0 - height;
    lighting
        .zenith
        .truncate()
        .lerp(lighting.horizon.truncate(), thin * thin * thin)
}

/// Brightness of a floor of two kinds of tiles with grooves between, averaged over the footprint of a pixel, so that
/// the floor has no aliasing of its own that no filter of edges could help.
fn tiles(place: Vec2, footprint: f32) -> f32 {
    let both = vec2(stripes(place.x, footprint), stripes(place.y, footprint));
    let checks = 0.5 + 0.5 * both.x * both.y;
    let groove = 1.0 - (1.0 - line(place.x, footprint)) * (1.0 - line(place.y, footprint));
    (0.62 + 0.38 * checks) * (1.0 - 0.55 * groove)
}

/// Mean of alternating stripes, 1 and -1, over a width.
fn stripes(x: f32, width: f32) -> f32 {
    let w = width.max(1.0e-4);
    (triangle(x + 0.5 * w) - triangle(x - 0.5 * w)) / w
}

/// Integral of the stripes.
fn triangle(x: f32) -> f32 {
    let half = 0.5 * x;
    1.0 - 2.0 * (half - half.floor() - 0.5).abs()
}

/// Mean of the grooves' share over a width.
fn line(x: f32, width: f32) -> f32 {
    let w = width.max(1.0e-4);
    (lines(x + 0.5 * w) - lines(x - 0.5 * w)) / w
}

/// Integral of the grooves.
fn lines(x: f32) -> f32 {
    let shifted = x + 0.03;
    let whole = shifted.floor();
    0.06 * whole + (shifted - whole).min(0.06)
}

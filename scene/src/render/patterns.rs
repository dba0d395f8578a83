//! Patterns that materials have in world space: paint, shadow, holes and relief. `shade.wgsl` and `geometry.wgsl` say the same.

use glam::{Vec2, Vec3, vec2, vec3};

/// 1 where the sun shines through the slats above, else 0. Not averaged over a pixel: an edge of shading alone.
pub(super) fn slats(place: Vec3, towards_sun: Vec3) -> f32 {
    let shadow = place.x - towards_sun.x / towards_sun.y.max(0.05) * place.y;
    let share = 2.0 * shadow;
    if share - share.floor() < 0.45 { 0.0 } else { 1.0 }
}

/// Paint on a surface: dark blue balls in a grid of them, cut by it. Not averaged over a pixel: an edge of shading alone.
pub(super) fn dots(place: Vec3) -> Vec3 {
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

/// Brightness of a floor of two kinds of tiles with grooves between, averaged over the footprint of a pixel, so that
/// the floor has no aliasing of its own that no filter of edges could help.
pub(super) fn tiles(place: Vec2, footprint: f32) -> f32 {
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

/// Returns the slope of studs, three-dimensional and cut by the surface, as seen by pixels of a size: with distance they flatten, as the
/// levels of a normal map do.
pub(super) fn studs(place: Vec3, footprint: f32) -> Vec3 {
    let cell = place * 4.0 + 0.4;
    let away = cell - cell.floor() - 0.5;
    let inside = (1.0 - 5.0 * away.dot(away)).max(0.0);
    let sharp = (1.3 - 10.0 * footprint).clamp(0.0, 1.0);
    away * (-3.5 * inside * sharp)
}

/// Returns a unit normal tilted by a slope along its surface.
pub(super) fn tilted(normal: Vec3, slope: Vec3) -> Vec3 {
    (normal - (slope - normal * slope.dot(normal))).normalize_or(normal)
}

//! Screen-space ambient occlusion in the hemisphere over each surface (Mittring 2007, Filion and McNaughton 2008).

use straightline_kernels::prelude::*;

/// Points in the unit hemisphere around +z, denser near the centre.
const POINTS: [Vec3; 12] = [
    vec3(0.05, 0.02, 0.06),
    vec3(-0.09, 0.07, 0.08),
    vec3(0.04, -0.15, 0.07),
    vec3(-0.12, -0.11, 0.15),
    vec3(0.25, 0.06, 0.12),
    vec3(0.02, 0.28, 0.21),
    vec3(-0.35, 0.05, 0.18),
    vec3(-0.08, -0.41, 0.23),
    vec3(0.38, -0.28, 0.31),
    vec3(0.33, 0.47, 0.28),
    vec3(-0.52, 0.39, 0.35),
    vec3(-0.44, -0.55, 0.48),
];

options! {
    /// Options of the occlusion.
    pub struct Ssao {
        /// Distance within which a surface can be occluded by others, in scene units.
        pub radius: f32 [0.01..=10.0] = 0.6,
        /// Depth by which a surface may lie behind another without being occluded; hides its own roughness.
        pub bias: f32 [0.0..=0.5] = 0.02,
        /// Pixels covered by one unit at distance one.
        pub focal: f32 [1.0..=10000.0] = 300.0,
    }
}

/// Openness of each surface in grey. `depth` is the distance along the view; `normal` is in view space:
/// x right, y up, z towards the viewer.
pub fn ssao(cfg: &Ssao, depth: &Frame<f32>, normal: &Frame<Vec3>, pixel: IVec2) -> Vec4 {
    let here = depth.load(pixel);
    let up = normal.load(pixel).normalize();
    // Any two perpendicular directions in the surface.
    let tangent = if up.z.abs() < 0.9 {
        Vec3::Z.cross(up).normalize()
    } else {
        Vec3::X.cross(up).normalize()
    };
    let bitangent = up.cross(tangent);
    let mut occluded = 0.0;
    for point in POINTS {
        let away = (tangent * point.x + bitangent * point.y + up * point.z) * cfg.radius;
        let reach = cfg.focal / here;
        // Rows go down where view space goes up.
        let offset = round(away.truncate() * vec2(reach, -reach)).as_ivec2();
        let behind = here - away.z - depth.load(pixel + offset);
        // A surface that is much nearer belongs to another object.
        let near = 1.0 - smoothstep(cfg.radius, 2.0 * cfg.radius, behind.abs());
        occluded += if behind > cfg.bias { near } else { 0.0 };
    }
    let open = 1.0 - occluded / POINTS.len() as f32;
    vec4(open, open, open, 1.0)
}

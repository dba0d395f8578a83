//! Screen-space reflections (McGuire and Mara, Efficient GPU screen-space ray tracing, 2014): a digital differential analyser
//! along the ray's projection, with perspective-correct depth.

use straightline_kernels::prelude::*;

const STEPS: i32 = 48;
/// Assumed thickness of surfaces.
const THICKNESS: f32 = 0.35;

struct Camera {
    size: Vec2,
    focal: f32,
}

impl Camera {
    /// Position of a pixel's centre at some depth: x right, y down, z away.
    fn position(&self, at: IVec2, depth: f32) -> Vec3 {
        ((at.as_vec2() + 0.5 - 0.5 * self.size) / self.focal * depth).extend(depth)
    }

    fn project(&self, at: Vec3) -> Vec2 {
        at.truncate() / at.z * self.focal + 0.5 * self.size
    }
}

/// Returns the pixel that a ray hits.
fn trace(camera: &Camera, depth: &Frame<f32>, from: Vec3, direction: Vec3) -> Option<IVec2> {
    // Clipped in front of the eye.
    let length = if from.z + direction.z * 4.0 < 0.2 {
        (0.2 - from.z) / direction.z
    } else {
        4.0
    };
    let to = from + direction * length;
    let (start, end) = (camera.project(from), camera.project(to));
    let span = (end - start).abs().max_element().max(1.0);
    // 1 / z is linear on the screen.
    let (near, far) = (1.0 / from.z, 1.0 / to.z);
    let stride = (span / STEPS as f32).max(1.0);
    for k in 1..=STEPS {
        let t = k as f32 * stride / span;
        if t > 1.0 {
            return None;
        }
        let at = start.lerp(end, t).floor().as_ivec2();
        if at.cmplt(IVec2::ZERO).any() || at.cmpge(camera.size.as_ivec2()).any() {
            return None;
        }
        let behind = 1.0 / mix(near, far, t) - depth.load(at);
        if behind > 0.02 && behind < THICKNESS {
            return Some(at);
        }
    }
    None
}

/// `depth` is the distance along the view; `normal` is in view space with y up and z towards the viewer.
pub fn screen_space_reflections(
    color: &Frame<Vec4>,
    depth: &Frame<f32>,
    normal: &Frame<Vec3>,
    focal: f32,
    pixel: IVec2,
) -> Vec4 {
    let camera = Camera {
        size: color.size().as_vec2(),
        focal,
    };
    let here = color.load(pixel);
    let from = camera.position(pixel, depth.load(pixel));
    // Into the camera's frame: y down, z away.
    let facing = normal.load(pixel) * vec3(1.0, -1.0, -1.0);
    let incoming = from.normalize();
    let reflected = incoming - 2.0 * incoming.dot(facing) * facing;
    let Some(at) = trace(&camera, depth, from + facing * 0.02, reflected) else {
        return here;
    };
    // Schlick's approximation of Fresnel's law.
    let grazing = 1.0 - (-incoming.dot(facing)).clamp(0.0, 1.0);
    let share = 0.04 + 0.96 * grazing.powi(5);
    here.lerp(color.load(at), share)
}

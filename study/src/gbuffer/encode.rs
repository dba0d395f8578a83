//! Depth and normals as G-buffers hold them.

use glam::{Vec2, Vec3, Vec4, vec2};
use half::f16;

/// How depth is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthCode {
    Linear,
    Perspective,
    Reversed,
    ReversedInfinite,
}

impl DepthCode {
    /// By the value of the option `depth`.
    pub fn named(name: &str) -> Self {
        match name {
            "perspective" => DepthCode::Perspective,
            "reversed" => DepthCode::Reversed,
            "reversed-infinite" => DepthCode::ReversedInfinite,
            _ => DepthCode::Linear,
        }
    }

    /// Linear depth as it is held, with near and far plane; what is beyond the far plane lies on it.
    pub fn encode(self, linear: f32, planes: Vec2) -> f32 {
        let (near, far) = (f64::from(planes.x), f64::from(planes.y));
        let z = f64::from(linear);
        let whole = far / (far - near);
        let encoded = match self {
            DepthCode::Linear => z,
            DepthCode::Perspective => whole * (1.0 - near / z.min(far)),
            DepthCode::Reversed => 1.0 - whole * (1.0 - near / z.min(far)),
            DepthCode::ReversedInfinite => near / z,
        };
        encoded as f32
    }
}

/// How normals are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalCode {
    Float,
    /// 8 bits an axis.
    Unorm,
    /// 8 bits an axis.
    Octahedral,
    /// Not quantised here: [`pack`] is.
    Packed,
}

impl NormalCode {
    /// By the value of the option `normals`.
    pub fn named(name: &str) -> Self {
        match name {
            "unorm" => NormalCode::Unorm,
            "octahedral" => NormalCode::Octahedral,
            "packed" => NormalCode::Packed,
            _ => NormalCode::Float,
        }
    }

    /// A unit vector as a texel.
    pub fn encode(self, normal: Vec3) -> Vec4 {
        match self {
            NormalCode::Float => normal.extend(0.0),
            NormalCode::Unorm => {
                let axes = (0.5 + 0.5 * normal).to_array().map(|x| quantised(x, 8));
                Vec3::from_array(axes).extend(0.0)
            }
            NormalCode::Octahedral => {
                let square = 0.5 + 0.5 * unfolded(normal);
                Vec4::new(quantised(square.x, 8), quantised(square.y, 8), 0.0, 0.0)
            }
            NormalCode::Packed => unfolded(normal).extend(0.0).extend(0.0),
        }
    }
}

/// A unit vector unfolded from the octahedron |x| + |y| + |z| = 1 to the square from -1 to 1.
fn unfolded(normal: Vec3) -> Vec2 {
    let n = normal / normal.abs().element_sum();
    if n.z >= 0.0 {
        return n.truncate();
    }
    vec2((1.0 - n.y.abs()).copysign(n.x), (1.0 - n.x.abs()).copysign(n.y))
}

/// An unfolded normal and a depth in four 16-bit floats: the depth as a sum of two.
pub fn pack(x: f32, y: f32, depth: f32) -> Vec4 {
    let half = |value: f32| f16::from_f32(value).to_f32();
    let coarse = half(depth.min(f16::MAX.to_f32()));
    let fine = half((depth - coarse).clamp(-f16::MAX.to_f32(), f16::MAX.to_f32()));
    Vec4::new(half(x), half(y), coarse, fine)
}

/// A texel in 16-bit floats.
pub fn halved(texel: Vec4) -> Vec4 {
    Vec4::from_array(texel.to_array().map(|x| f16::from_f32(x).to_f32()))
}

/// In 0..1, as a normalised format of `bits` holds it.
fn quantised(x: f32, bits: u32) -> f32 {
    let steps = ((1u64 << bits) - 1) as f32;
    (x.clamp(0.0, 1.0) * steps).round() / steps
}

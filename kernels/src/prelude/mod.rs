//! Vocabulary of a kernel.
//!
//! Everything a kernel may call besides its own functions: glam's vectors and matrices, `f32` and integer mathematics, the
//! functions of [`maths`] whose names mean something else in Rust, the textures, samplers and
//! buffers below, [`Quad`]s and their messages, and [`tally`]. Each means the same natively and in the emitted shader. `options!`
//! declares the options that are fixed when a shader is generated.
//!
//! Two attributes are for the generator only; rustc ignores them:
//!
//! - `#[cfg_attr(false, unroll(full))]`, `unroll(none)` or `unroll(4)` before a `for` sets the unrolling of that loop;
//! - `#[cfg_attr(false, branch)]` or `select` before an `if` decides if a condition that is a runtime value
//!   becomes a branch, or if both sides are computed and one is selected.

mod buffer;
mod frame;
pub mod maths;
mod picture;
mod quad;
mod storage;
mod texture;
mod workgroup;

pub use glam::{
    BVec2, BVec3, BVec4, IVec2, IVec3, IVec4, Mat2, Mat3, Mat4, Quat, UVec2, UVec3, UVec4, Vec2, Vec2Swizzles, Vec3,
    Vec3Swizzles, Vec4, Vec4Swizzles, ivec2, ivec3, ivec4, mat2, mat3, mat4, uvec2, uvec3, uvec4, vec2, vec3, vec4,
};

pub use buffer::Buffer;
pub use frame::{Frame, FrameLayers};
pub use maths::{fract, inverse_sqrt, mix, round, saturate, sign, smoothstep, step};
pub use picture::{Picture, draw};
pub use quad::{PerLane, Quad, lane_position, quad_select, quad_vector};
pub use storage::{AtomicBuffer, AtomicElement, StorageBuffer, StorageTexture};
pub use texture::{
    Address, Comparison, ComparisonSampler, DepthCube, DepthTexture, DepthTextureArray, Filter, Filterable,
    Multisampled, Sampler, Texel, Texture, Texture3D, TextureArray, TextureCube,
};
pub use workgroup::{AtomicShared, PerThread, Shared, SharedAtomics, Thread, Workgroup};

pub use crate::options;

/// `default`, as the default of an option set at run time unless a setting turns it into a constant: `= uniform(0.5)`.
///
/// Affects the generator only as the entire default of a number in `options!`.
pub const fn uniform<T: Copy>(default: T) -> T {
    default
}

/// Returns `value`, a number or a quad of them, and counts it under `name` in the generator's reports. No other effect.
///
/// Counts only values that are still computed after partial evaluation. A tallied value that turned out to be
/// constant, unused or shared costs nothing and is not counted.
pub fn tally<T>(_name: &str, value: T) -> T {
    value
}

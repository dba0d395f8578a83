//! G-buffers in other formats: what a renderer that stores depth and normals in fewer bits would hand to a filter.
//!
//! A capture has linear depth and unit normals in whole floats. [`encode_depths`] and [`encode_normals`] make of them what
//! a texture of another format reads as, in the numbers that a shader gets from a load: 0 to 1 where the format is
//! normalised (`unorm`). How each is read back, [`DepthEncoding::decode`] and [`NormalEncoding::decode`], is its
//! definition, in double precision; tests compare kernels with that.

mod depth;
mod normal;

use glam::{Vec3, Vec4, vec4};
use half::f16;
use straightline_kernels::prelude::{Frame, FrameLayers};

pub use depth::{DepthEncoding, DepthStorage};
pub use normal::NormalEncoding;

/// Depth of every layer as `encoding` stores it with the precision of `storage`.
pub fn encode_depths(linear: &FrameLayers<f32>, encoding: DepthEncoding, storage: DepthStorage) -> FrameLayers<f32> {
    map_texels(linear, |depth| storage.round(encoding.encode(f64::from(depth))) as f32)
}

/// Normals of every layer as the components that a shader reads; those that the format lacks are 0, alpha 1.
pub fn encode_normals(normals: &FrameLayers<Vec3>, encoding: NormalEncoding) -> FrameLayers<Vec4> {
    map_texels(normals, |normal| {
        let [x, y, z] = encoding.encode(normal.as_dvec3().to_array());
        vec4(x as f32, y as f32, z as f32, 1.0)
    })
}

/// Normals and depth in one texel, half the reads, in four 16-bit floats: red and green are the normal unfolded to a square
/// from -1 to 1, blue and alpha have the sum that `encoding` stores for the depth. The two halves of a depth hold 22 bits
/// from 1/8 to 65504, and steps of 2⁻²⁴ below.
///
/// Panics unless both have as many layers.
pub fn pack_normals_depths(
    normals: &FrameLayers<Vec3>,
    linear: &FrameLayers<f32>,
    encoding: DepthEncoding,
) -> FrameLayers<Vec4> {
    assert_eq!(normals.layers().len(), linear.layers().len(), "layers of both");
    let layers = normals.layers().iter().zip(linear.layers()).map(|(normals, depths)| {
        let texels = normals.texels().iter().zip(depths.texels());
        Frame::new(
            normals.size(),
            texels.map(|(n, d)| pack_texel(*n, *d, encoding)).collect(),
        )
    });
    FrameLayers::new(layers.collect())
}

fn pack_texel(normal: Vec3, depth: f32, encoding: DepthEncoding) -> Vec4 {
    let [x, y] = normal::unfold_octahedron(normal.as_dvec3().to_array());
    let largest = f16::MAX.to_f64();
    let stored = encoding.encode(f64::from(depth)).clamp(-largest, largest);
    let coarse = f16::from_f64(stored);
    let fine = f16::from_f64(stored - coarse.to_f64());
    Vec4::from_array([f16::from_f64(x), f16::from_f64(y), coarse, fine].map(f16::to_f32))
}

/// Rounds texels to 16-bit floats, which every device can multisample.
pub fn round_to_half(texels: &FrameLayers<Vec4>) -> FrameLayers<Vec4> {
    let half = |texel: Vec4| Vec4::from_array(texel.to_array().map(|c| f16::from_f32(c).to_f32()));
    map_texels(texels, half)
}

fn map_texels<A: Copy, B: Copy>(stack: &FrameLayers<A>, texel: impl Fn(A) -> B) -> FrameLayers<B> {
    let layer = |layer: &Frame<A>| Frame::new(layer.size(), layer.texels().iter().map(|t| texel(*t)).collect());
    FrameLayers::new(stack.layers().iter().map(layer).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::uvec2;

    #[test]
    fn a_packed_depth_keeps_22_bits() {
        for k in 1..2000 {
            let depth = 0.013 * k as f32 * k as f32;
            let texel = pack_texel(Vec3::Z, depth, DepthEncoding::Linear);
            let back = f64::from(texel.z) + f64::from(texel.w);
            let apart = (back - f64::from(depth)).abs();
            assert!(
                apart <= f64::from(depth).max(0.125) * 2.0_f64.powi(-22),
                "{depth}: {back}"
            );
        }
    }

    #[test]
    fn a_packed_texel_is_normal_and_depth() {
        let size = uvec2(2, 1);
        let normals = FrameLayers::new(vec![Frame::new(size, vec![Vec3::Z, Vec3::NEG_X])]);
        let depths = FrameLayers::new(vec![Frame::new(size, vec![4.0, 8.0])]);
        let encoding = DepthEncoding::InfiniteReversed { near: 1.0 };
        let stack = pack_normals_depths(&normals, &depths, encoding);
        let texels = stack.layers()[0].texels();
        for (texel, (normal, depth)) in texels.iter().zip([(Vec3::Z, 4.0), (Vec3::NEG_X, 8.0)]) {
            let square = [texel.x, texel.y].map(|c| 0.5 + 0.5 * f64::from(c));
            let read = NormalEncoding::Octahedral16.decode([square[0], square[1], 0.0]);
            assert!(
                (Vec3::from(read.map(|c| c as f32)) - normal).length() < 1.0e-3,
                "{texel}"
            );
            assert_eq!(encoding.decode(f64::from(texel.z) + f64::from(texel.w)), depth);
        }
    }
}

//! G-buffers in other formats: what a renderer that stores depth and normals in fewer bits would hand to a filter.
//!
//! A capture has linear depth and unit normals in whole floats. [`depth`] and [`normal`] make of them what a texture of
//! another format reads as, in the numbers that a shader gets from a load: 0 to 1 where the format is normalised
//! (`unorm`). How each is read back, [`DepthEncoding::decode`] and [`NormalEncoding::decode`], is its definition, in
//! double precision; tests compare kernels with that.

mod depth;
mod normal;

use glam::{Vec3, Vec4, vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};

pub use depth::{DepthEncoding, DepthStorage};
pub use normal::NormalEncoding;

/// Depth of every layer as `encoding` stores it with the precision of `storage`.
pub fn depth(linear: &FrameLayers<f32>, encoding: DepthEncoding, storage: DepthStorage) -> FrameLayers<f32> {
    each(linear, |depth| storage.round(encoding.encode(f64::from(depth))) as f32)
}

/// Normals of every layer as the components that a shader reads; those that the format lacks are 0, alpha 1.
pub fn normal(normals: &FrameLayers<Vec3>, encoding: NormalEncoding) -> FrameLayers<Vec4> {
    each(normals, |normal| {
        let [x, y, z] = encoding.encode(normal.as_dvec3().to_array());
        vec4(x as f32, y as f32, z as f32, 1.0)
    })
}

/// Normals and depth in one texel, half the reads: red and green are the normal in [`NormalEncoding::Octahedral16`],
/// blue is depth as `encoding` stores it in a whole float, alpha is 1. In bits, 32 for the normal and 32 for depth.
///
/// Panics unless both have as many layers.
pub fn packed(normals: &FrameLayers<Vec3>, linear: &FrameLayers<f32>, encoding: DepthEncoding) -> FrameLayers<Vec4> {
    assert_eq!(normals.layers().len(), linear.layers().len(), "layers of both");
    let normals = normal(normals, NormalEncoding::Octahedral16);
    let depths = depth(linear, encoding, DepthStorage::Float32);
    let layers = normals.layers().iter().zip(depths.layers()).map(|(normals, depths)| {
        let texels = normals.texels().iter().zip(depths.texels());
        Frame::new(normals.size(), texels.map(|(n, d)| vec4(n.x, n.y, *d, 1.0)).collect())
    });
    FrameLayers::new(layers.collect())
}

fn each<A: Copy, B: Copy>(stack: &FrameLayers<A>, texel: impl Fn(A) -> B) -> FrameLayers<B> {
    let layer = |layer: &Frame<A>| Frame::new(layer.size(), layer.texels().iter().map(|t| texel(*t)).collect());
    FrameLayers::new(stack.layers().iter().map(layer).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::uvec2;

    #[test]
    fn a_packed_texel_is_normal_and_depth() {
        let size = uvec2(2, 1);
        let normals = FrameLayers::new(vec![Frame::new(size, vec![Vec3::Z, Vec3::NEG_X])]);
        let depths = FrameLayers::new(vec![Frame::new(size, vec![4.0, 8.0])]);
        let encoding = DepthEncoding::InfiniteReversed { near: 1.0 };
        let stack = packed(&normals, &depths, encoding);
        let texels = stack.layers()[0].texels();
        for (texel, (normal, depth)) in texels.iter().zip([(Vec3::Z, 4.0), (Vec3::NEG_X, 8.0)]) {
            let read = NormalEncoding::Octahedral16.decode([texel.x.into(), texel.y.into(), 0.0]);
            assert!(
                (Vec3::from(read.map(|c| c as f32)) - normal).length() < 1.0e-4,
                "{texel}"
            );
            assert_eq!(encoding.decode(texel.z.into()), depth);
        }
    }
}

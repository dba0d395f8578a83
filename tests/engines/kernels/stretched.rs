//! Stretches a picture over the target, whatever their sizes: a kernel that takes `resolution` without a `Frame`.

use straightline_kernels::prelude::*;

/// The picture, stretched over the target and darkened towards its edges.
pub fn stretched(image: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2();
    let from_edge = uv.min(1.0 - uv);
    image.sample(linear, uv) * (0.5 + from_edge.min_element())
}

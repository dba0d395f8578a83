//! Enhanced subpixel morphological antialiasing, all three passes (Jimenez, Echevarria, Sousa and Gutierrez, SMAA, 2012).
//!
//! The kernels are those of `examples/gallery`, which has the tables `smaa_area.png` and `smaa_search.png` too.

use super::smaa_blend::smaa_blend;
use super::smaa_edges::smaa_edges;
use super::smaa_weights::smaa_weights;
use straightline_kernels::prelude::*;

/// Antialiases a picture by the edges that it shows.
pub fn smaa(color: &Frame<Vec4>, area: &Texture<Vec4>, search: &Texture<Vec4>, linear: &Sampler) -> Frame<Vec4> {
    #[cfg_attr(false, format(rgba8unorm))]
    let edges: Frame<Vec4> = draw(color.size(), |pixel| smaa_edges(color, pixel));
    #[cfg_attr(false, format(rgba8unorm))]
    let weights: Frame<Vec4> = draw(color.size(), |pixel| smaa_weights(&edges, area, search, linear, pixel));
    draw(color.size(), |pixel| smaa_blend(color, &weights, linear, pixel))
}

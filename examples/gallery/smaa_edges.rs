//! Enhanced subpixel morphological antialiasing, first pass: edges by luma (Jimenez, Echevarria, Sousa and Gutierrez, SMAA,
//! 2012; after the reference implementation, MIT licence, https://github.com/iryoku/smaa), preset High.

use straightline_kernels::prelude::*;

const THRESHOLD: f32 = 0.1;
/// Factor against weak edges: one counts only if this times its contrast reaches the strongest contrast around.
const CONTRAST_ADAPTATION: f32 = 2.0;

/// Edges of a pixel: to the left in x, above in y. `color` is in display encoding, not linear.
pub fn smaa_edges(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let luma = |x, y| {
        color
            .load(pixel + ivec2(x, y))
            .truncate()
            .dot(vec3(0.2126, 0.7152, 0.0722))
    };
    let here = luma(0, 0);
    let before = vec2(luma(-1, 0), luma(0, -1));
    let delta = (here - before).abs();
    let mut edges = vec2(step(THRESHOLD, delta.x), step(THRESHOLD, delta.y));
    if edges == Vec2::ZERO {
        return Vec4::ZERO;
    }
    let after = (here - vec2(luma(1, 0), luma(0, 1))).abs();
    let farther = (before - vec2(luma(-2, 0), luma(0, -2))).abs();
    let most = delta.max(after).max(farther).max_element();
    edges.x *= step(most, CONTRAST_ADAPTATION * delta.x);
    edges.y *= step(most, CONTRAST_ADAPTATION * delta.y);
    edges.extend(0.0).extend(0.0)
}

//! Scale2x (Mazzoleni 2001), also known as EPX (Johnston 1992): pixel art at twice its size, without new colours.

use straightline_kernels::prelude::*;

fn same(a: Vec4, b: Vec4) -> bool {
    a == b
}

/// The image at twice its size.
pub fn scale2x(image: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    let at = pixel / 2;
    let load = |x, y| image.load(at + ivec2(x, y));
    let (above, left, here, right, below) = (load(0, -1), load(-1, 0), load(0, 0), load(1, 0), load(0, 1));
    if same(above, below) || same(left, right) {
        return here;
    }
    match (pixel.x & 1, pixel.y & 1) {
        (0, 0) if same(left, above) => left,
        (1, 0) if same(above, right) => right,
        (0, 1) if same(left, below) => left,
        (1, 1) if same(below, right) => right,
        _ => here,
    }
}

//! A generation of the Game of Life (Conway; Gardner, Scientific American, October 1970). All cells beyond the border are dead.

use straightline_kernels::prelude::*;

fn alive(cells: &Frame<Vec4>, at: IVec2) -> bool {
    let size = cells.size().as_ivec2();
    at.cmpge(IVec2::ZERO).all() && at.cmplt(size).all() && cells.load(at).x > 0.5
}

pub fn life(cells: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut neighbours = 0;
    for y in -1..=1 {
        for x in -1..=1 {
            if (x, y) == (0, 0) {
                continue;
            }
            neighbours += i32::from(alive(cells, pixel + ivec2(x, y)));
        }
    }
    match (alive(cells, pixel), neighbours) {
        (true, 2 | 3) | (false, 3) => Vec4::ONE,
        _ => vec4(0.0, 0.0, 0.0, 1.0),
    }
}

//! Chains whose pictures workgroups can compute one after another.

use straightline_kernels::prelude::*;

fn mean(from: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for y in 0..2 {
        for x in 0..2 {
            sum += from.load(pixel * 2 + ivec2(x, y));
        }
    }
    sum * 0.25
}

/// The levels of a picture, each half of the one before.
pub fn mips(color: &Texture<Vec4>) -> Vec<Texture<Vec4>> {
    let a: Texture<Vec4> = draw(color.size() / 2, |pixel| mean(color, pixel));
    let b: Texture<Vec4> = draw(a.size() / 2, |pixel| mean(&a, pixel));
    let c: Texture<Vec4> = draw(b.size() / 2, |pixel| mean(&b, pixel));
    let d: Texture<Vec4> = draw(c.size() / 2, |pixel| mean(&c, pixel));
    let e: Texture<Vec4> = draw(d.size() / 2, |pixel| mean(&d, pixel));
    vec![a, b, c, d, e]
}

/// Rows, then columns.
pub fn blur(color: &Texture<Vec4>) -> Texture<Vec4> {
    let rows: Texture<Vec4> = draw(color.size(), |pixel| {
        let mut sum = Vec4::ZERO;
        for x in -3..=3 {
            sum += color.load(pixel + ivec2(x, 0)) * (4 - i32::abs(x)) as f32;
        }
        sum
    });
    draw(color.size(), |pixel| {
        let mut sum = Vec4::ZERO;
        for y in -3..=3 {
            sum += rows.load(pixel + ivec2(0, y)) * (4 - i32::abs(y)) as f32;
        }
        sum
    })
}

/// Smaller sizes rounded up, with a filter of 4x4 texels, and back by the parity of the pixel.
pub fn rounded_up(color: &Texture<Vec4>) -> Texture<Vec4> {
    let small: Texture<Vec4> = draw((color.size() + 1) / 2, |pixel| {
        let mut sum = Vec4::ZERO;
        for y in -1..=2 {
            for x in -1..=2 {
                sum += color.load(pixel * 2 + ivec2(x, y));
            }
        }
        sum / 16.0
    });
    let smaller: Texture<Vec4> = draw((small.size() + 1) / 2, |pixel| {
        small.load(pixel * 2) - small.load(pixel * 2 + 1)
    });
    let wide: Texture<Vec4> = draw(small.size(), |pixel| {
        let side = (pixel % 2) * 2 - 1;
        smaller.load(pixel / 2) + smaller.load(pixel / 2 + side) * 0.5
    });
    draw(color.size(), |pixel| {
        wide.load(pixel / 2) + wide.load((pixel + 1) / 2) + color.load(pixel)
    })
}

/// Sizes rounded down, and back: the border of a larger picture has no texel of the smaller one.
pub fn rounded_down(color: &Texture<Vec4>) -> Texture<Vec4> {
    let small: Texture<Vec4> = draw(color.size() / 3, |pixel| {
        color.load(pixel * 3) + color.load(pixel * 3 + ivec2(1, 2)) * 0.5
    });
    let wide: Texture<Vec4> = draw(color.size(), |pixel| {
        small.load(pixel / 3) - small.load(pixel / 3 + ivec2(1, -1))
    });
    draw(color.size(), |pixel| {
        wide.load(pixel) * color.load(pixel) + wide.load(pixel - ivec2(2, 0))
    })
}

/// A picture that a later pass reads besides, of one number, and one of integers.
pub fn kinds(color: &Texture<Vec4>) -> Texture<Vec4> {
    let light: Texture<f32> = draw(color.size(), |pixel| {
        color.load(pixel).truncate().dot(vec3(0.25, 0.5, 0.25))
    });
    let signs: Texture<IVec2> = draw(color.size(), |pixel| {
        let side = |by: IVec2| light.load(pixel + by) > light.load(pixel - by);
        ivec2(i32::from(side(ivec2(1, 0))), -i32::from(side(ivec2(0, 1))))
    });
    let thin: Texture<Vec3> = draw(color.size(), |pixel| {
        let mut sum = IVec2::ZERO;
        for k in -1..=1 {
            sum += signs.load(pixel + ivec2(k, 0)) + signs.load(pixel + ivec2(0, k));
        }
        sum.as_vec2().extend(light.load(pixel + ivec2(2, 2)))
    });
    draw(color.size(), |pixel| {
        let edge = thin.load(pixel) + thin.load(pixel + ivec2(-1, 1));
        color.load(pixel) + edge.extend(light.load(pixel))
    })
}

/// Two results of unlike sizes, one of which the other reads.
pub fn halves(color: &Texture<Vec4>) -> (Texture<Vec4>, Texture<Vec4>) {
    let sharp: Texture<Vec4> = draw(color.size(), |pixel| {
        color.load(pixel) * 5.0 - color.load(pixel + ivec2(1, 0)) - color.load(pixel - ivec2(1, 0))
    });
    let half: Texture<Vec4> = draw(sharp.size() / 2, |pixel| {
        mean(&sharp, pixel) - sharp.load(pixel * 2 - 1)
    });
    (sharp, half)
}

/// A frame, whose size the kernel knows.
pub fn frames(color: &Frame<Vec4>) -> Frame<Vec4> {
    let near: Frame<Vec4> = draw(color.size(), |pixel| {
        color.load(pixel) - color.load(pixel + ivec2(0, 2))
    });
    draw(color.size(), |pixel| {
        let last = near.size().as_ivec2() - 1;
        near.load((pixel + ivec2(1, 1)).min(last)) + near.load(pixel.max(IVec2::ZERO)) * 0.5
    })
}

//! A chain for each construct that chains have.

use straightline_kernels::prelude::*;

const TAPS: usize = 3;

/// Coordinate of a texel as a position, 0 to 1.
fn place(pixel: IVec2, size: UVec2) -> Vec2 {
    (pixel.as_vec2() + 0.5) / size.as_vec2()
}

fn mean(from: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for y in 0..2 {
        for x in 0..2 {
            sum += from.load(pixel * 2 + ivec2(x, y));
        }
    }
    sum * 0.25
}

/// Two passes of one size.
pub fn separable(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let rows: Texture<Vec4> = draw(color.size(), |pixel| {
        color.load(pixel - ivec2(1, 0)) + strength * color.load(pixel + ivec2(1, 0))
    });
    draw(color.size(), |pixel| {
        rows.load(pixel - ivec2(0, 1)) + strength * rows.load(pixel + ivec2(0, 1))
    })
}

/// A list of pictures, smaller and smaller, and back.
pub fn pyramid(color: &Texture<Vec4>, linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let first: Texture<Vec4> = draw(color.size() / 2, |pixel| mean(color, pixel));
    let mut levels = vec![first];
    for k in 1..TAPS {
        let next: Texture<Vec4> = draw(levels[k - 1].size() / 2, |pixel| mean(&levels[k - 1], pixel));
        levels.push(next);
    }
    let mut up = levels.pop().unwrap();
    for level in levels.iter().rev() {
        let wider: Texture<Vec4> = draw(level.size(), |p| {
            level.load(p) + strength * up.sample(linear, place(p, level.size()))
        });
        up = wider;
    }
    draw(color.size(), |pixel| {
        color.load(pixel) - up.sample(linear, place(pixel, color.size()))
    })
}

/// Values that passes compute for themselves, and constants of loops.
pub fn values(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let twice = strength * 2.0;
    let (near, far) = (twice + 1.0, twice - 1.0);
    let half = color.size() / 2;
    let side = half.x;
    let mut current: Texture<Vec4> = draw(half, |pixel| {
        color.load(pixel) * near + Vec4::splat(half.y as f32 + side as f32)
    });
    for k in (1..=5).step_by(2) {
        let weight = far / k as f32;
        let offset = 1 << k;
        current = draw(half, |pixel| current.load(pixel + ivec2(offset, -k)) * weight);
    }
    draw(color.size(), |pixel| current.load(pixel / 2) + color.load(pixel))
}

/// Conditions and a `match` over what is known.
pub fn choices(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let mut current: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    for k in 0..4 {
        current = if k % 2 == 0 && TAPS > 2 {
            draw(color.size(), |pixel| current.load(pixel).yzwx())
        } else {
            let step = match k {
                1 => 2,
                2 | 3 => 5,
                _ => 7,
            };
            draw(color.size(), |pixel| current.load(pixel + ivec2(step, 0)) * strength)
        };
    }
    current
}

fn blurred(from: &Texture<Vec4>, radius: i32, gain: f32) -> Texture<Vec4> {
    let rows: Texture<Vec4> = draw(from.size(), |pixel| {
        let mut sum = Vec4::ZERO;
        for x in -radius..=radius {
            sum += from.load(pixel + ivec2(x, 0));
        }
        sum * gain
    });
    rows
}

/// A chain that calls others.
pub fn calls(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let wide = blurred(color, 2, strength + 0.5);
    let wider = blurred(&wide, 1, strength);
    draw(color.size(), |pixel| wider.load(pixel) - wide.load(pixel))
}

/// Variables that change places, and a `while`.
pub fn ping_pong(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let mut front: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel) * strength);
    let mut back: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel) - 1.0);
    let mut left = 3;
    while left > 0 {
        std::mem::swap(&mut front, &mut back);
        front = draw(color.size(), |pixel| {
            front.load(pixel + ivec2(left, 0)) + back.load(pixel)
        });
        left -= 1;
    }
    draw(color.size(), |pixel| front.load(pixel) * back.load(pixel))
}

/// Pictures of numbers and of integers.
pub fn kinds(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let light: Texture<f32> = draw(color.size(), |pixel| color.load(pixel).dot(Vec4::splat(strength)));
    let pair: Texture<Vec2> = draw(color.size(), |pixel| {
        vec2(light.load(pixel), light.load(pixel + ivec2(1, 1)))
    });
    let counts: Texture<UVec2> = draw(color.size(), |pixel| (pair.load(pixel).abs() * 16.0).as_uvec2());
    let signs: Texture<i32> = draw(color.size(), |pixel| {
        counts.load(pixel).x as i32 - counts.load(pixel).y as i32
    });
    let three: Texture<Vec3> = draw(color.size(), |pixel| pair.load(pixel).extend(signs.load(pixel) as f32));
    draw(color.size(), |pixel| {
        three.load(pixel - ivec2(0, 1)).extend(light.load(pixel))
    })
}

/// Sizes of several forms.
pub fn sizes(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let row: Texture<Vec4> = draw(uvec2(color.size().x, 1), |pixel| {
        let mut sum = Vec4::ZERO;
        for y in 0..4 {
            sum += color.load(ivec2(pixel.x, y)) * strength;
        }
        sum
    });
    let small: Texture<Vec4> = draw((color.size() + 2) / 3, |pixel| color.load(pixel * 3));
    let large: Texture<Vec4> = draw((small.size() * 2).min(UVec2::splat(40)), |pixel| small.load(pixel / 2));
    let fixed: Texture<Vec4> = draw(uvec2(5, 3), |pixel| large.load(pixel) + row.load(ivec2(pixel.x, 0)));
    draw(color.size(), |pixel| {
        fixed.load(pixel % 4) + large.load(pixel) + row.load(ivec2(pixel.x, 7))
    })
}

fn named_small(from: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    from.load(pixel * 2)
}

/// A pass and a function that could have one name.
pub fn named(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let small: Texture<Vec4> = draw(color.size() / 2, |pixel| named_small(color, pixel));
    let r#type: Texture<Vec4> = draw(small.size(), |pixel| small.load(pixel) * strength);
    draw(color.size(), |pixel| r#type.load(pixel / 2))
}

/// Passes of one text, of which the first reads a picture that can be computed in place.
pub fn repeated(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let mut current: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel) - 0.25);
    for _ in 0..3 {
        current = draw(color.size(), |pixel| current.load(pixel + ivec2(1, 0)) * strength);
    }
    current
}

/// Frames, which have the size of what is drawn of them.
pub fn frames(color: &Texture<Vec4>, _linear: &Sampler, strength: f32) -> Texture<Vec4> {
    fn sharpened(from: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        from.load(pixel) * 2.0 - from.load(pixel + ivec2(1, 0))
    }
    let a: Frame<Vec4> = draw(color.size(), |pixel| color.load(pixel) * strength);
    let b: Frame<Vec4> = draw(a.size(), |pixel| sharpened(&a, pixel));
    draw(b.size(), |pixel| sharpened(&b, pixel) + a.load(pixel))
}

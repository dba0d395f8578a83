//! Percentage-closer soft shadows (Fernando 2005): the distance of the blockers determines the softness of the shadow.

use straightline_kernels::prelude::*;

/// Vogel's spiral: position `k` of `count` in a disc, rotated by `turn`.
fn vogel(k: i32, count: i32, turn: f32) -> Vec2 {
    let radius = ((k as f32 + 0.5) / count as f32).sqrt();
    let angle = k as f32 * 2.399_963_2 + turn;
    radius * Vec2::from_angle(angle)
}

/// Mean depth of the blockers nearer to the light than `receiver`; `None` if there are none.
fn blocker(shadow: &DepthTexture, at: Vec2, receiver: f32, reach: f32) -> Option<f32> {
    let (mut sum, mut count) = (0.0, 0);
    for k in 0..16 {
        let depth = shadow.load((at + vogel(k, 16, 0.0) * reach).floor().as_ivec2());
        if depth < receiver {
            sum += depth;
            count += 1;
        }
    }
    if count == 0 { None } else { Some(sum / count as f32) }
}

/// Share of the light that reaches a plane at depth `receiver`, seen by a pixel at `at` texels of the shadow map. The light is
/// `light` texels wide.
pub fn pcss(shadow: &DepthTexture, less: &ComparisonSampler, light: f32, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let size = shadow.size().as_vec2();
    let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2();
    let receiver = 0.4 + 0.5 * uv.y;
    let Some(depth) = blocker(shadow, uv * size, receiver, light) else {
        return Vec4::ONE;
    };
    let penumbra = ((receiver - depth) / depth * light).max(0.5);
    let turn = 6.283_185_5 * fract(52.982_918 * fract(0.06711056 * pixel.x as f32 + 0.00583715 * pixel.y as f32));
    let mut lit = 0.0;
    for k in 0..24 {
        lit += shadow.compare(less, uv + vogel(k, 24, turn) * penumbra / size, receiver);
    }
    Vec3::splat(lit / 24.0).extend(1.0)
}

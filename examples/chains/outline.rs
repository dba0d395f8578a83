//! Outlines where the light of a picture changes: Sobel's gradient of the luminance, thinned by its neighbours.

use straightline_kernels::prelude::*;

/// Draws dark outlines over a picture.
pub fn outline(color: &Texture<Vec4>, strength: f32) -> Texture<Vec4> {
    let light: Texture<f32> = draw(color.size(), |pixel| {
        color.load(pixel).truncate().dot(vec3(0.2126, 0.7152, 0.0722)).max(0.0).sqrt()
    });
    let gradient: Texture<Vec2> = draw(color.size(), |pixel| {
        let mut sum = Vec2::ZERO;
        for y in -1..=1_i32 {
            for x in -1..=1_i32 {
                let at = light.load(pixel + ivec2(x, y));
                sum += at * vec2((x * (2 - y.abs())) as f32, (y * (2 - x.abs())) as f32);
            }
        }
        sum
    });
    let edge: Texture<f32> = draw(color.size(), |pixel| {
        let here = gradient.load(pixel);
        let along = if here.x.abs() > here.y.abs() { ivec2(1, 0) } else { ivec2(0, 1) };
        let length = here.length();
        let ahead = gradient.load(pixel + along).length();
        let behind = gradient.load(pixel - along).length();
        if length >= ahead && length >= behind { length } else { 0.0 }
    });
    draw(color.size(), |pixel| {
        let drawn = saturate(strength * edge.load(pixel));
        (color.load(pixel).truncate() * (1.0 - drawn)).extend(1.0)
    })
}

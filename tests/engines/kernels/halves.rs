use straightline_kernels::prelude::*;

/// The size of a picture of half the size, and the place of each of its pixels.
pub fn halves(color: &Texture<Vec4>) -> Texture<Vec4> {
    let small: Texture<Vec4> = draw(color.size() / 2, |pixel| {
        let place = pixel.as_vec2();
        vec4(place.x, place.y, color.load(pixel * 2).x, 1.0)
    });
    draw(color.size(), |pixel| {
        let size = small.size().as_vec2();
        let texel = small.load(pixel / 2);
        vec4(texel.x, texel.y, size.x + texel.z, size.y)
    })
}

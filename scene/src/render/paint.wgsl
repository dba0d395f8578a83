// What textures give to a surface. Line by line the same as `paint.rs`.

struct Image {
    first: u32,
    width: u32,
    height: u32,
    levels: u32,
    cutoff: f32,
}

@group(1) @binding(0) var<storage, read> images: array<Image>;
@group(1) @binding(1) var<storage, read> image_texels: array<u32>;

fn painted(image: Image, uv: vec2f, footprint: f32) -> vec4f {
    let level = clamp(log2(max(footprint, 1.0)), 0.0, f32(image.levels - 1u));
    let finer = floor(level);
    let fine = of_level(image, u32(finer), uv);
    let coarse = of_level(image, min(u32(finer) + 1u, image.levels - 1u), uv);
    return mix(fine, coarse, level - finer);
}

fn of_level(image: Image, level: u32, uv: vec2f) -> vec4f {
    var first = image.first;
    var size = vec2u(image.width, image.height);
    for (var k = 0u; k < level; k++) {
        first += size.x * size.y;
        size = max(size / 2u, vec2u(1u));
    }
    let at = (uv - floor(uv)) * vec2f(size) - 0.5;
    let corner = floor(at);
    let share = at - corner;
    let near = vec2u(corner + vec2f(size)) % size;
    let far = (near + 1u) % size;
    let row = vec2u(first + near.y * size.x, first + far.y * size.x);
    let upper = mix(decoded(row.x + near.x), decoded(row.x + far.x), share.x);
    let lower = mix(decoded(row.y + near.x), decoded(row.y + far.x), share.x);
    return mix(upper, lower, share.y);
}

fn decoded(at: u32) -> vec4f {
    let texel = unpack4x8unorm(image_texels[at]);
    let linear = select(pow((texel.xyz + 0.055) / 1.055, vec3f(2.4)), texel.xyz / 12.92, texel.xyz <= vec3f(0.04045));
    return vec4f(linear, texel.w);
}

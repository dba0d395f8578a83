// The geometry and colour of the nearest surface at one place in each pixel. Follows `paint.wgsl` in one module, which begins with
// whether the scene has textures: what has none computes nothing of them.

struct Pass {
    to_clip: mat4x4f,
    to_view: mat4x4f,
    size: vec2u,
    offset: vec2f,
    keep: f32,
    evaluations: u32,
    pixel_angle: f32,
    parallel: f32,
}

@group(0) @binding(0) var<uniform> frame: Pass;

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) normal: vec3f,
    @location(1) color: vec3f,
    @location(2) depth: f32,
    @location(3) @interpolate(flat) material: u32,
    @location(4) place: vec3f,
    @location(5) uv: vec2f,
    @location(6) @interpolate(flat) image: u32,
    @location(7) density: f32,
}

const CHAIN_LINK: u32 = 2;
// STUDDED of `shade.wgsl`, which may follow.
const TILTED: u32 = 7;

struct Texels {
    @location(0) normal_depth: vec4f,
    @location(1) color_material: vec4f,
}

@vertex
fn corner(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
    @location(3) material: u32,
    @location(4) uv: vec2f,
    @location(5) image: u32,
    @location(6) density: f32,
) -> Corner {
    let clip = frame.to_clip * vec4f(position, 1.0);
    let turned = (frame.to_view * vec4f(normal, 0.0)).xyz;
    return Corner(clip, turned, color, linear_depth(position), material, position, uv, image, density);
}

// Also of a parallel projection, where clip.w is 1.
fn linear_depth(place: vec3f) -> f32 {
    return -(frame.to_view * vec4f(place, 1.0)).z;
}

// Units of a surface to a pixel. `normal` is in view space.
fn footprint_of(place: vec3f, depth: f32, normal: vec3f) -> f32 {
    let parallel = frame.parallel > 0.0;
    let towards = select(normalize((frame.to_view * vec4f(place, 1.0)).xyz), vec3f(0.0, 0.0, -1.0), parallel);
    return select(depth, 1.0, parallel) * frame.pixel_angle / max(abs(dot(normal, towards)), 0.05);
}

// Colour and alpha of a surface's texture, and from which alpha on the surface is there. `normal` is in view space.
struct Painted {
    color: vec4f,
    cutoff: f32,
}

fn paint_of(number: u32, uv: vec2f, density: f32, place: vec3f, depth: f32, normal: vec3f) -> Painted {
    if !HAS_TEXTURES || number == 0u {
        return Painted(vec4f(1.0), 0.0);
    }
    let image = images[number - 1u];
    return Painted(painted(image, uv, footprint_of(place, depth, normal) * density), image.cutoff);
}

// Whether there is no surface, and its colour.
struct Seen {
    color: vec3f,
    hole: bool,
}

fn seen(surface: Corner) -> Seen {
    let normal = normalize(surface.normal);
    let paint = paint_of(surface.image, surface.uv, surface.density, surface.place, surface.depth, normal);
    let hole = surface.material == CHAIN_LINK && !is_wire(surface.place);
    return Seen(surface.color * paint.color.xyz, hole || paint.color.w < paint.cutoff);
}

// As in `shade.rs`.
fn is_wire(place: vec3f) -> bool {
    let along = place.x + place.z;
    return wire(along + place.y) || wire(along - place.y);
}

fn wire(across: f32) -> bool {
    let at = across * 8.0;
    return at - floor(at) < 0.14;
}

// The normal of the side that is seen, in view space, tilted by studs.
fn seen_normal(interpolated: vec3f, material: u32, place: vec3f, depth: f32, front: bool) -> vec3f {
    var normal = normalize(interpolated);
    if material == TILTED {
        let slope = (frame.to_view * vec4f(studs(place, footprint_of(place, depth, normal)), 0.0)).xyz;
        normal = normalize(normal - (slope - normal * dot(slope, normal)));
    }
    return select(-normal, normal, front);
}

// As in `patterns.rs`.
fn studs(place: vec3f, footprint: f32) -> vec3f {
    let cell = place * 4.0 + 0.4;
    let away = cell - floor(cell) - 0.5;
    let inside = max(1.0 - 5.0 * dot(away, away), 0.0);
    let sharp = clamp(1.3 - 10.0 * footprint, 0.0, 1.0);
    return away * (-3.5 * inside * sharp);
}

@fragment
fn texels(surface: Corner, @builtin(front_facing) front: bool) -> Texels {
    let paint = seen(surface);
    if paint.hole {
        discard;
    }
    let normal = seen_normal(surface.normal, surface.material, surface.place, surface.depth, front);
    return Texels(vec4f(normal, surface.depth), vec4f(paint.color, f32(surface.material)));
}

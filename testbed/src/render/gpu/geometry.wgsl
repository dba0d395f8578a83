// The geometry and colour of the nearest surface at one place in each pixel.

struct Pass {
    to_clip: mat4x4f,
    to_view: mat4x4f,
    size: vec2u,
    offset: vec2f,
    keep: f32,
    evaluations: u32,
}

@group(0) @binding(0) var<uniform> frame: Pass;

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) normal: vec3f,
    @location(1) color: vec3f,
    @location(2) depth: f32,
    @location(3) @interpolate(flat) material: u32,
    @location(4) place: vec3f,
}

const CHAIN_LINK: u32 = 2;

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
) -> Corner {
    let clip = frame.to_clip * vec4f(position, 1.0);
    return Corner(clip, (frame.to_view * vec4f(normal, 0.0)).xyz, color, clip.w, material, position);
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

@fragment
fn texels(surface: Corner, @builtin(front_facing) front: bool) -> Texels {
    if surface.material == CHAIN_LINK && !is_wire(surface.place) {
        discard;
    }
    let normal = normalize(surface.normal);
    return Texels(
        vec4f(select(-normal, normal, front), surface.depth),
        vec4f(surface.color, f32(surface.material)),
    );
}

// Shading at one point, in WGSL. `../shade.rs` says the same in Rust, name by name and line by line.

struct View {
    to_clip: mat4x4f,
    eye: vec3f,
    pixel: f32,
    forward: vec3f,
    haze: f32,
    right: vec3f,
    add: u32,
    up: vec3f,
    sun_direction: vec3f,
    sun_color: vec3f,
    zenith: vec3f,
    horizon: vec3f,
    ground: vec3f,
    size: vec2u,
    offset: vec2f,
}

struct Surface {
    depth: f32,
    normal: vec3f,
    color: vec3f,
    material: u32,
}

const SKY_DEPTH: f32 = 1.0e6;
const TILES: u32 = 1u;
const JOINT: f32 = 0.035;

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var depths: texture_2d<f32>;
@group(0) @binding(2) var normals: texture_2d<f32>;
@group(0) @binding(3) var colors: texture_2d<f32>;
@group(0) @binding(4) var<storage, read_write> sums: array<vec4f>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= view.size) {
        return;
    }
    let attributes = textureLoad(colors, id.xy, 0);
    var surface: Surface;
    surface.depth = textureLoad(depths, id.xy, 0).x;
    surface.normal = textureLoad(normals, id.xy, 0).xyz;
    surface.color = attributes.rgb;
    surface.material = u32(attributes.a);
    let color = vec4f(shade(surface, vec2f(id.xy) + 0.5 + view.offset), 1.0);
    let at = id.y * view.size.x + id.x;
    if view.add == 0u {
        sums[at] = color;
    } else {
        sums[at] += color;
    }
}

fn shade(surface: Surface, at: vec2f) -> vec3f {
    let ndc = 2.0 * at / vec2f(view.size) - 1.0;
    let ray = view.forward + ndc.x * view.right - ndc.y * view.up;
    let outwards = normalize(ray);
    if surface.depth >= SKY_DEPTH {
        return sky(outwards);
    }
    let normal = surface.normal;
    var albedo = surface.color;
    if surface.material == TILES {
        let slant = max(abs(dot(outwards, normal)), 1.0e-3);
        albedo *= tiles(view.eye + ray * surface.depth, outwards, view.pixel * surface.depth, slant);
    }
    let around = 0.5 * (view.zenith + view.horizon);
    let ambient = mix(view.ground, around, 0.5 + 0.5 * normal.y);
    let lit = max(dot(normal, view.sun_direction), 0.0);
    let halfway = normalize(view.sun_direction - outwards);
    let sharp = pow(max(dot(normal, halfway), 0.0), 32.0);
    let color = albedo * (ambient + lit * view.sun_color) + 0.1 * lit * sharp * view.sun_color;
    let clear = exp2(-view.haze * surface.depth);
    return clamp(mix(view.horizon, color, clear), vec3f(0.0), vec3f(1.0));
}

fn sky(outwards: vec3f) -> vec3f {
    let height = sqrt(clamp(outwards.y, 0.0, 1.0));
    return clamp(mix(view.horizon, view.zenith, height), vec3f(0.0), vec3f(1.0));
}

fn tiles(position: vec3f, outwards: vec3f, across: f32, slant: f32) -> f32 {
    let p = position.xz;
    let along = abs(outwards.xz);
    let width = across * (1.0 + along * (1.0 / slant - 1.0));
    let low = p - 0.5 * width;
    let high = p + 0.5 * width;
    let joints = (joints_below(high) - joints_below(low)) / width;
    let joint = 1.0 - (1.0 - joints.x) * (1.0 - joints.y);
    let kinds = (kinds_below(high) - kinds_below(low)) / width;
    return (1.0 + 0.13 * kinds.x * kinds.y) * (1.0 - 0.6 * joint);
}

fn joints_below(p: vec2f) -> vec2f {
    return JOINT * floor(p) + min(p - floor(p), vec2f(JOINT));
}

fn kinds_below(p: vec2f) -> vec2f {
    let pair = 0.5 * p;
    return 1.0 - abs(2.0 * (pair - floor(pair)) - 1.0);
}

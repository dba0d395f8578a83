// The colour of one point from what a G-buffer knows of it. Line by line the same as `shade.rs`.

const SKY_DEPTH: f32 = 1.0e6;
const TILES: u32 = 1;
const SLATS: u32 = 3;
const GLOSSY: u32 = 4;
const EMISSIVE: u32 = 5;
const DOTS: u32 = 6;
const EMISSION: f32 = 50.0;
const MOST: f32 = 65504.0;

struct Lighting {
    to_world: mat4x4f,
    sun_direction: vec4f,
    sun_color: vec4f,
    up: vec4f,
    zenith: vec4f,
    horizon: vec4f,
    ground: vec4f,
    extent: vec4f,
}

struct Surface {
    normal: vec3f,
    depth: f32,
    color: vec3f,
    material: f32,
}

fn shade(lighting: Lighting, surface: Surface, ray: vec3f) -> vec3f {
    let view = -normalize(ray);
    if surface.depth >= SKY_DEPTH {
        return clamp(sky(lighting, -view), vec3f(0.0), vec3f(1.0));
    }
    let material = u32(surface.material);
    let normal = surface.normal;
    var albedo = surface.color;
    let place = lighting.to_world * vec4f(ray * surface.depth, 1.0);
    if material == TILES {
        let footprint = surface.depth * lighting.extent.z / max(dot(normal, view), 0.05);
        albedo *= tiles(place.xz, footprint);
    }
    if material == DOTS {
        albedo *= dots(place.xyz);
    }
    var facing = max(dot(normal, lighting.sun_direction.xyz), 0.0);
    if material == SLATS {
        let towards_sun = lighting.to_world * vec4f(lighting.sun_direction.xyz, 0.0);
        facing *= slats(place.xyz, towards_sun.xyz);
    }
    let upwards = 0.5 + 0.5 * dot(normal, lighting.up.xyz);
    let ambient = mix(lighting.ground.xyz, lighting.zenith.xyz, upwards);
    let halfway = normalize(view + lighting.sun_direction.xyz);
    let s1 = max(dot(normal, halfway), 0.0);
    let s2 = s1 * s1;
    let s4 = s2 * s2;
    let s8 = s4 * s4;
    let s16 = s8 * s8;
    var specular = 0.08 * s16 * facing;
    var most = 1.0;
    if material == GLOSSY {
        let s32 = s16 * s16;
        let s64 = s32 * s32;
        let s128 = s64 * s64;
        specular += 6.0 * s128 * s128 * facing;
        most = MOST;
    }
    var lit = albedo * (ambient + lighting.sun_color.xyz * facing) + lighting.sun_color.xyz * specular;
    if material == EMISSIVE {
        lit = surface.color * EMISSION;
        most = MOST;
    }
    let clear = exp2(-lighting.sun_direction.w * surface.depth * length(ray));
    return clamp(mix(lighting.horizon.xyz, lit, clear), vec3f(0.0), vec3f(most));
}

fn slats(place: vec3f, towards_sun: vec3f) -> f32 {
    let shadow = place.x - towards_sun.x / max(towards_sun.y, 0.05) * place.y;
    let share = 2.0 * shadow;
    return select(1.0, 0.0, share - floor(share) < 0.45);
}

fn dots(place: vec3f) -> vec3f {
    let cell = place * 3.0 + 0.4;
    let away = cell - floor(cell) - 0.5;
    return select(vec3f(1.0), vec3f(0.10, 0.16, 0.45), dot(away, away) < 0.18);
}

fn sky(lighting: Lighting, towards: vec3f) -> vec3f {
    let height = clamp(dot(towards, lighting.up.xyz), 0.0, 1.0);
    let thin = 1.0 - height;
    return mix(lighting.zenith.xyz, lighting.horizon.xyz, thin * thin * thin);
}

fn tiles(place: vec2f, footprint: f32) -> f32 {
    let checks = 0.5 + 0.5 * stripes(place.x, footprint) * stripes(place.y, footprint);
    let groove = 1.0 - (1.0 - line(place.x, footprint)) * (1.0 - line(place.y, footprint));
    return (0.62 + 0.38 * checks) * (1.0 - 0.55 * groove);
}

fn stripes(x: f32, width: f32) -> f32 {
    let w = max(width, 1.0e-4);
    return (triangle(x + 0.5 * w) - triangle(x - 0.5 * w)) / w;
}

fn triangle(x: f32) -> f32 {
    let half = 0.5 * x;
    return 1.0 - 2.0 * abs(half - floor(half) - 0.5);
}

fn line(x: f32, width: f32) -> f32 {
    let w = max(width, 1.0e-4);
    return (lines(x + 0.5 * w) - lines(x - 0.5 * w)) / w;
}

fn lines(x: f32) -> f32 {
    let shifted = x + 0.03;
    let whole = floor(shifted);
    return 0.06 * whole + min(shifted - whole, 0.06);
}

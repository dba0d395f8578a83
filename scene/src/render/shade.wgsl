// The colour of one point from what a G-buffer knows of it. Line by line the same as `shade.rs`, `lamps.rs` and `patterns.rs`. In one
// module it follows whether the scene has lamps, environment or balls that cast shadows: what has none computes nothing of them.

const SKY_DEPTH: f32 = 1.0e6;
const TILES: u32 = 1;
const SLATS: u32 = 3;
const GLOSSY: u32 = 4;
const EMISSIVE: u32 = 5;
const DOTS: u32 = 6;
const STUDDED: u32 = 7;
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
    environment: array<vec4f, 9>,
    lamp_places: array<vec4f, 4>,
    lamp_colors: array<vec4f, 4>,
    shades: array<vec4f, 8>,
    counts: vec4u,
}

@group(0) @binding(1) var<uniform> lighting: Lighting;

struct Ray {
    origin: vec3f,
    along: vec3f,
}

// Through a place of the picture, -1 to 1 to the right and down.
fn ray_through(place: vec2f) -> Ray {
    let across = vec2f(place.x * lighting.extent.x, -place.y * lighting.extent.y);
    if lighting.extent.w > 0.0 {
        return Ray(vec3f(across, 0.0), vec3f(0.0, 0.0, -1.0));
    }
    return Ray(vec3f(0.0), vec3f(across, -1.0));
}

struct Surface {
    normal: vec3f,
    depth: f32,
    color: vec3f,
    material: f32,
}

fn shade(surface: Surface, ray: Ray) -> vec3f {
    let view = -normalize(ray.along);
    if surface.depth >= SKY_DEPTH {
        return clamp(sky(-view), vec3f(0.0), vec3f(1.0));
    }
    let material = u32(surface.material);
    let normal = surface.normal;
    var albedo = surface.color;
    let place = lighting.to_world * vec4f(ray.origin + ray.along * surface.depth, 1.0);
    if material == TILES {
        let pixel = lighting.extent.z * select(surface.depth, 1.0, lighting.extent.w > 0.0);
        albedo *= tiles(place.xz, pixel / max(dot(normal, view), 0.05));
    }
    if material == DOTS {
        albedo *= dots(place.xyz);
    }
    var facing = max(dot(normal, lighting.sun_direction.xyz), 0.0);
    let towards_sun = (lighting.to_world * vec4f(lighting.sun_direction.xyz, 0.0)).xyz;
    if material == SLATS {
        facing *= slats(place.xyz, towards_sun);
    } else if HAS_LAMPS {
        facing *= visibility(place.xyz, towards_sun, 1.0e30);
    }
    let upwards = 0.5 + 0.5 * dot(normal, lighting.up.xyz);
    var ambient = mix(lighting.ground.xyz, lighting.zenith.xyz, upwards);
    let halfway = normalize(view + lighting.sun_direction.xyz);
    let specular = gloss(material, max(dot(normal, halfway), 0.0)) * facing;
    var most = 1.0;
    if material == GLOSSY || material == STUDDED {
        most = MOST;
    }
    var light = Light();
    if HAS_LAMPS {
        let turned = (lighting.to_world * vec4f(normal, 0.0)).xyz;
        let eye = (lighting.to_world * vec4f(view, 0.0)).xyz;
        ambient += environment(turned);
        light = lamp_light(material, place.xyz, turned, eye);
        if lighting.counts.x > 0u {
            most = MOST;
        }
    }
    var lit = albedo * (ambient + lighting.sun_color.xyz * facing + light.diffuse);
    lit += lighting.sun_color.xyz * specular + light.specular;
    if material == EMISSIVE {
        lit = surface.color * EMISSION;
        most = MOST;
    }
    let clear = exp2(-lighting.sun_direction.w * surface.depth * length(ray.along));
    return clamp(mix(lighting.horizon.xyz, lit, clear), vec3f(0.0), vec3f(most));
}

fn gloss(material: u32, s1: f32) -> f32 {
    let s2 = s1 * s1;
    let s4 = s2 * s2;
    let s8 = s4 * s4;
    let s16 = s8 * s8;
    let s32 = s16 * s16;
    var specular = 0.08 * s16;
    if material == GLOSSY {
        let s64 = s32 * s32;
        let s128 = s64 * s64;
        specular += 6.0 * s128 * s128;
    }
    if material == STUDDED {
        specular += 0.5 * s32;
    }
    return specular;
}

struct Light {
    diffuse: vec3f,
    specular: vec3f,
}

fn lamp_light(material: u32, place: vec3f, normal: vec3f, view: vec3f) -> Light {
    var sum = Light();
    for (var i = 0u; i < lighting.counts.x; i++) {
        let lamp = lighting.lamp_places[i];
        let towards = lamp.xyz - place;
        let distance = dot(towards, towards);
        let direction = towards * (1.0 / sqrt(distance));
        var facing = max(dot(normal, direction), 0.0) * lamp.w / (lamp.w + distance);
        facing *= visibility(place, towards, 1.0);
        let halfway = normalize(view + direction);
        sum.diffuse += lighting.lamp_colors[i].xyz * facing;
        sum.specular += lighting.lamp_colors[i].xyz * (facing * gloss(material, max(dot(normal, halfway), 0.0)));
    }
    return sum;
}

fn visibility(place: vec3f, towards: vec3f, until: f32) -> f32 {
    var visible = 1.0;
    for (var i = 0u; i < lighting.counts.y; i++) {
        let ball = lighting.shades[i];
        let centre = ball.xyz - place;
        let nearest = dot(centre, towards) / dot(towards, towards);
        let beside = centre - towards * nearest;
        if nearest > 0.0 && nearest < until && dot(beside, beside) < ball.w {
            visible = 0.0;
        }
    }
    return visible;
}

fn environment(n: vec3f) -> vec3f {
    let e = lighting.environment;
    var sum = e[0].xyz + e[1].xyz * n.x + e[2].xyz * n.y + e[3].xyz * n.z;
    sum += e[4].xyz * (n.x * n.y) + e[5].xyz * (n.y * n.z) + e[6].xyz * (3.0 * n.z * n.z - 1.0);
    sum += e[7].xyz * (n.x * n.z) + e[8].xyz * (n.x * n.x - n.y * n.y);
    return max(sum, vec3f(0.0));
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

fn sky(towards: vec3f) -> vec3f {
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

// Every shader of the renderer but SRAA. Directions are in the space of the camera.

struct View {
    // Model space to clip space, shifted to the sample.
    to_clip: mat4x4f,
    // Model space to the space of the camera.
    to_view: mat4x4f,
    // Rays to depth 1: through the picture's upper left corner, and the steps by a pixel.
    ray_corner: vec4f,
    ray_right: vec4f,
    ray_down: vec4f,
    sun: vec4f,
    up: vec4f,
    sun_light: vec4f,
    ground_light: vec4f,
    sky_light: vec4f,
    // Weight of this frame in the mean of a reference.
    share: f32,
}

@group(0) @binding(0) var<uniform> view: View;

// Geometry: all samples of a pixel, or its centre.

struct Surface {
    @builtin(position) clip: vec4f,
    @location(0) normal: vec3f,
    @location(1) color: vec3f,
}

// The G-buffer: a target of the renderer's, and one of SRAA's.
struct Texels {
    @location(0) albedo: vec4f,
    @location(1) normal: vec4f,
}

@vertex
fn corner(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) color: vec3f) -> Surface {
    let clip = view.to_clip * vec4f(position, 1.0);
    return Surface(clip, (view.to_view * vec4f(normal, 0.0)).xyz, color);
}

@fragment
fn surface(in: Surface) -> Texels {
    return Texels(vec4f(in.color, 1.0), vec4f(normalize(in.normal), 0.0));
}

struct GuidedTexels {
    @location(0) albedo: vec4f,
    @location(1) normal: vec4f,
    @location(2) guide: vec4f,
}

// The guide is cheaper than the shading's light: no highlights, and a sky that is the same on all sides.
@fragment
fn guided_surface(in: Surface) -> GuidedTexels {
    let normal = normalize(in.normal);
    let ambient = 0.5 * (view.ground_light + view.sky_light).rgb;
    let light = ambient + view.sun_light.rgb * max(dot(normal, view.sun.xyz), 0.0);
    return GuidedTexels(vec4f(in.color, 1.0), vec4f(normal, 0.0), vec4f(in.color * light, 0.0));
}

// One triangle over the whole picture.

@vertex
fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, k == 1u), select(-1.0, 3.0, k == 2u), 0.0, 1.0);
}

// Shading: at the pixel's centre, where the place map says, or at all samples.

@group(0) @binding(1) var depth_samples: texture_multisampled_2d<f32>;
@group(0) @binding(2) var normal_samples: texture_multisampled_2d<f32>;
@group(0) @binding(3) var albedo_samples: texture_multisampled_2d<f32>;
@group(0) @binding(4) var centre_depth: texture_2d<f32>;
@group(0) @binding(5) var centre_normal: texture_2d<f32>;
@group(0) @binding(6) var centre_albedo: texture_2d<f32>;
@group(0) @binding(7) var place_map: texture_2d<u32>;

const SAMPLES = 4u;

struct Seen {
    depth: f32,
    normal: vec3f,
    albedo: vec3f,
}

fn seen_at_sample(pixel: vec2i, k: u32) -> Seen {
    let normal = textureLoad(normal_samples, pixel, k).xyz;
    return Seen(textureLoad(depth_samples, pixel, k).x, normal, textureLoad(albedo_samples, pixel, k).rgb);
}

fn seen_at_centre(pixel: vec2i) -> Seen {
    let normal = textureLoad(centre_normal, pixel, 0).xyz;
    return Seen(textureLoad(centre_depth, pixel, 0).x, normal, textureLoad(centre_albedo, pixel, 0).rgb);
}

fn shaded(at: vec4f, seen: Seen) -> vec3f {
    // The ray through the pixel's centre, wherever in it the surface is seen: in half a pixel it hardly turns.
    let ray = normalize((view.ray_corner + at.x * view.ray_right + at.y * view.ray_down).xyz);
    // Depth is reversed: 0 is endlessly far away.
    if seen.depth <= 0.0 {
        let height = clamp(0.5 + 1.2 * dot(ray, view.up.xyz), 0.0, 1.0);
        return mix(vec3f(0.50, 0.53, 0.56), vec3f(0.10, 0.16, 0.28), height);
    }
    let facing = max(dot(seen.normal, view.sun.xyz), 0.0);
    let ambient = mix(view.ground_light, view.sky_light, 0.5 + 0.5 * dot(seen.normal, view.up.xyz)).rgb;
    let gloss = pow(max(dot(reflect(ray, seen.normal), view.sun.xyz), 0.0), 40.0);
    let sun = view.sun_light.rgb;
    return seen.albedo * (ambient + sun * facing) + 0.5 * sun * gloss;
}

@fragment
fn shade_centre(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return vec4f(shaded(at, seen_at_centre(vec2i(at.xy))), 1.0);
}

@fragment
fn shade_placed(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    let place = textureLoad(place_map, pixel, 0).x;
    if place < SAMPLES {
        return vec4f(shaded(at, seen_at_sample(pixel, place)), 1.0);
    }
    return vec4f(shaded(at, seen_at_centre(pixel)), 1.0);
}

@fragment
fn shade_samples(@builtin(position) at: vec4f) -> @location(0) vec4f {
    var sum = vec3f(0.0);
    for (var k = 0u; k < SAMPLES; k++) {
        sum += shaded(at, seen_at_sample(vec2i(at.xy), k));
    }
    return vec4f(sum / f32(SAMPLES), 1.0);
}

@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var earlier: texture_2d<f32>;

// The mean of several frames, for a reference.
@fragment
fn accumulate(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    return mix(textureLoad(earlier, pixel, 0), textureLoad(picture, pixel, 0), view.share);
}

// To the screen.
@fragment
fn present(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let color = textureLoad(picture, vec2i(at.xy), 0).rgb;
    // Whatever is brighter than white is compressed after antialiasing, in linear light as the kernel works.
    return vec4f(color / (1.0 + max(color - 0.8, vec3f(0.0))), 1.0);
}

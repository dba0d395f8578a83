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

// Geometry: one sample of the G-buffer.

struct Surface {
    @builtin(position) clip: vec4f,
    @location(0) normal: vec3f,
    @location(1) color: vec3f,
    @location(2) depth: f32,
}

struct Texels {
    @location(0) depth: f32,
    @location(1) normal: vec4f,
    // Alpha is visibility from the sun: the scene has no shadows.
    @location(2) albedo: vec4f,
}

@vertex
fn corner(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) color: vec3f) -> Surface {
    let clip = view.to_clip * vec4f(position, 1.0);
    return Surface(clip, (view.to_view * vec4f(normal, 0.0)).xyz, color, clip.w);
}

@fragment
fn surface(in: Surface) -> Texels {
    return Texels(in.depth, vec4f(normalize(in.normal), 0.0), vec4f(in.color, 1.0));
}

// One triangle over the whole picture.

@vertex
fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, k == 1u), select(-1.0, 3.0, k == 2u), 0.0, 1.0);
}

// Shading: at the pixel's centre, at the sample that the place map names, or at all samples.

@group(0) @binding(1) var depth_map: texture_2d_array<f32>;
@group(0) @binding(2) var normal_map: texture_2d_array<f32>;
@group(0) @binding(3) var albedo_map: texture_2d_array<f32>;
@group(0) @binding(4) var place_map: texture_2d<u32>;

const SAMPLES = 4u;
const CENTRE = 4u;
const SKY = 1.0e6;

fn shaded(at: vec4f, layer: u32) -> vec3f {
    let pixel = vec2i(at.xy);
    // The ray through the pixel's centre, wherever in it the surface is seen: in half a pixel it hardly turns.
    let ray = normalize((view.ray_corner + at.x * view.ray_right + at.y * view.ray_down).xyz);
    if textureLoad(depth_map, pixel, layer, 0).x >= SKY {
        let height = clamp(0.5 + 1.2 * dot(ray, view.up.xyz), 0.0, 1.0);
        return mix(vec3f(0.50, 0.53, 0.56), vec3f(0.10, 0.16, 0.28), height);
    }
    let normal = textureLoad(normal_map, pixel, layer, 0).xyz;
    let albedo = textureLoad(albedo_map, pixel, layer, 0).rgb;
    let facing = max(dot(normal, view.sun.xyz), 0.0);
    let ambient = mix(view.ground_light, view.sky_light, 0.5 + 0.5 * dot(normal, view.up.xyz)).rgb;
    let gloss = pow(max(dot(reflect(ray, normal), view.sun.xyz), 0.0), 40.0);
    let sun = view.sun_light.rgb;
    return albedo * (ambient + sun * facing) + 0.5 * sun * gloss;
}

@fragment
fn shade_centre(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return vec4f(shaded(at, CENTRE), 1.0);
}

@fragment
fn shade_placed(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return vec4f(shaded(at, textureLoad(place_map, vec2i(at.xy), 0).x), 1.0);
}

@fragment
fn shade_samples(@builtin(position) at: vec4f) -> @location(0) vec4f {
    var sum = vec3f(0.0);
    for (var layer = 0u; layer < SAMPLES; layer++) {
        sum += shaded(at, layer);
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

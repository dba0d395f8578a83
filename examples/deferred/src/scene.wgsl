// Every shader of the renderer but SRAA.

struct View {
    // Model space to clip space, shifted to the sample.
    to_clip: mat4x4f,
    // Model space to world space: a rotation.
    to_world: mat4x4f,
    // From the middle of the picture to its right and its upper edge, in world space, at depth 1.
    right: vec4f,
    up: vec4f,
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
    @location(2) albedo: vec4f,
}

@vertex
fn corner(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) color: vec3f) -> Surface {
    let clip = view.to_clip * vec4f(position, 1.0);
    return Surface(clip, (view.to_world * vec4f(normal, 0.0)).xyz, color, clip.w);
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

// Shading, once a pixel: at the sample that the place map names, or at the centre.

@group(0) @binding(1) var depth_map: texture_2d_array<f32>;
@group(0) @binding(2) var normal_map: texture_2d_array<f32>;
@group(0) @binding(3) var albedo_map: texture_2d_array<f32>;
@group(0) @binding(4) var place_map: texture_2d<u32>;

struct Shaded {
    @location(0) color: vec4f,
    // What of it does not follow the albedo.
    @location(1) rest: vec4f,
}

const SUN = vec3f(0.48, 0.64, 0.60);

@fragment
fn shade(@builtin(position) at: vec4f) -> Shaded {
    let pixel = vec2i(at.xy);
    let layer = textureLoad(place_map, pixel, 0).x;
    // The ray through the pixel's centre, wherever in it the surface is seen: in half a pixel it hardly turns.
    let size = vec2f(textureDimensions(depth_map));
    let place = vec2f(at.x / size.x, 1.0 - at.y / size.y) * 2.0 - 1.0;
    let forward = normalize(cross(view.up.xyz, view.right.xyz));
    let ray = normalize(forward + place.x * view.right.xyz + place.y * view.up.xyz);
    let normal = textureLoad(normal_map, pixel, layer, 0).xyz;
    let albedo = textureLoad(albedo_map, pixel, layer, 0).rgb;
    if textureLoad(depth_map, pixel, layer, 0).x >= 1.0e6 {
        let height = clamp(0.5 + 1.2 * ray.y, 0.0, 1.0);
        let sky = mix(vec3f(0.50, 0.53, 0.56), vec3f(0.10, 0.16, 0.28), height);
        return Shaded(vec4f(sky, 1.0), vec4f(0.0));
    }
    let facing = max(dot(normal, SUN), 0.0);
    let ambient = mix(vec3f(0.10, 0.09, 0.08), vec3f(0.22, 0.27, 0.34), 0.5 + 0.5 * normal.y);
    let gloss = pow(max(dot(reflect(ray, normal), SUN), 0.0), 40.0);
    let sun = vec3f(1.3, 1.15, 0.95);
    let highlight = 0.5 * sun * gloss;
    return Shaded(vec4f(albedo * (ambient + sun * facing) + highlight, 1.0), vec4f(highlight, 0.0));
}

// To the screen.

@group(0) @binding(1) var picture: texture_2d<f32>;

@fragment
fn present(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let color = textureLoad(picture, vec2i(at.xy), 0).rgb;
    // Whatever is brighter than white is compressed after antialiasing, in linear light as the kernel works.
    return vec4f(color / (1.0 + max(color - 0.8, vec3f(0.0))), 1.0);
}

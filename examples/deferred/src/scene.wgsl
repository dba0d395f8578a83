// Every shader of the renderer but SRAA.

struct View {
    // Model space to clip space, shifted to the sample.
    to_clip: mat4x4f,
    // Model space to world space: a rotation.
    to_world: mat4x4f,
    // From the middle of the picture to its right and its upper edge, in world space, at depth 1.
    right: vec4f,
    up: vec4f,
    // The camera, in world space.
    eye: vec4f,
    // Where in its pixels this frame is shaded: from the centre, in pixels, y down.
    jitter: vec2f,
    // The least albedo that light is what colours are divided by.
    albedo_floor: f32,
    then: array<Earlier, 3>,
}

// An earlier frame.
struct Earlier {
    // From model space, which was another then, to clip space, shifted to where it was shaded.
    to_clip: mat4x4f,
    jitter: vec2f,
    // 0 if there was none.
    is_known: f32,
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
    // In model space, where a normal stays what it was in earlier frames.
    return Surface(clip, normal, color, clip.w);
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

// Shading, once a pixel: at the sample that the place map names, or where the frame is shaded.

@group(0) @binding(1) var depth_map: texture_2d_array<f32>;
@group(0) @binding(2) var normal_map: texture_2d_array<f32>;
@group(0) @binding(3) var albedo_map: texture_2d_array<f32>;
@group(0) @binding(4) var place_map: texture_2d<u32>;

struct Shaded {
    @location(0) color: vec4f,
    // What of it does not follow the albedo.
    @location(1) rest: vec4f,
}

const SKY = 1.0e6;
const SUN = vec3f(0.48, 0.64, 0.60);

// From the camera to depth 1, through a place of a picture of `size` pixels.
fn ray_through(at: vec2f, size: vec2f) -> vec3f {
    let place = vec2f(at.x / size.x, 1.0 - at.y / size.y) * 2.0 - 1.0;
    let forward = normalize(cross(view.up.xyz, view.right.xyz));
    return forward + place.x * view.right.xyz + place.y * view.up.xyz;
}

@fragment
fn shade(@builtin(position) at: vec4f) -> Shaded {
    let pixel = vec2i(at.xy);
    let layer = textureLoad(place_map, pixel, 0).x;
    // The ray through the pixel's centre, wherever in it the surface is seen: in half a pixel it hardly turns.
    let ray = normalize(ray_through(at.xy, vec2f(textureDimensions(depth_map))));
    let normal = (view.to_world * vec4f(textureLoad(normal_map, pixel, layer, 0).xyz, 0.0)).xyz;
    let albedo = textureLoad(albedo_map, pixel, layer, 0).rgb;
    if textureLoad(depth_map, pixel, layer, 0).x >= SKY {
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

// Where what each pixel shows was in three earlier frames: in pixels, less where it is now, and by how much it was deeper.

@group(0) @binding(2) var place_of: texture_2d<u32>;

struct Motions {
    @location(0) first: vec4f,
    @location(1) second: vec4f,
    @location(2) third: vec4f,
}

// Farther than anything moves: nothing is known.
const UNKNOWN = vec4f(65504.0);

@fragment
fn motion(@builtin(position) centre: vec4f) -> Motions {
    let pixel = vec2i(centre.xy);
    let layer = textureLoad(place_of, pixel, 0).x;
    let depth = textureLoad(depth_map, pixel, layer, 0).x;
    // The samples of the kernel's pattern, and where the frame is shaded.
    var places = array<vec2f, 5>(
        vec2f(-0.125, -0.375), vec2f(0.375, -0.125), vec2f(-0.375, 0.125), vec2f(0.125, 0.375), view.jitter,
    );
    let at = centre.xy + places[layer];
    return Motions(moved(0u, at, depth), moved(1u, at, depth), moved(2u, at, depth));
}

fn moved(k: u32, at: vec2f, depth: f32) -> vec4f {
    let then = view.then[k];
    if then.is_known == 0.0 {
        return UNKNOWN;
    }
    // The sky is so smooth that it may be taken to stand still.
    if depth >= SKY {
        return vec4f(-then.jitter, 0.0, 0.0);
    }
    // All else turns as one: its motion follows from its depth. What moves by itself needs a vertex shader that knows where it was.
    let size = vec2f(textureDimensions(depth_map));
    let from_world = view.eye.xyz + depth * ray_through(at, size);
    // By a rotation's inverse.
    let from_model = vec4f(from_world, 0.0) * view.to_world;
    let clip = then.to_clip * vec4f(from_model.xyz, 1.0);
    let raster = (vec2f(clip.x, -clip.y) / clip.w * 0.5 + 0.5) * size;
    return vec4f(raster - at, clip.w - depth, 0.0);
}

// What later frames need of this one.

@group(0) @binding(5) var shaded: texture_2d<f32>;
@group(0) @binding(6) var shaded_rest: texture_2d<f32>;

struct Kept {
    // Light that follows the albedo.
    @location(0) light: vec4f,
    @location(1) rest: vec4f,
    // The normal, and depth.
    @location(2) surface: vec4f,
}

@fragment
fn keep(@builtin(position) at: vec4f) -> Kept {
    let pixel = vec2i(at.xy);
    let layer = textureLoad(place_map, pixel, 0).x;
    let color = textureLoad(shaded, pixel, 0);
    let rest = textureLoad(shaded_rest, pixel, 0);
    let albedo = max(textureLoad(albedo_map, pixel, layer, 0).rgb, vec3f(view.albedo_floor));
    let normal = textureLoad(normal_map, pixel, layer, 0).xyz;
    let depth = textureLoad(depth_map, pixel, layer, 0).x;
    return Kept(vec4f((color.rgb - rest.rgb) / albedo, color.a), rest, vec4f(normal, depth));
}

// To the screen.

@group(0) @binding(1) var picture: texture_2d<f32>;

@fragment
fn present(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let color = textureLoad(picture, vec2i(at.xy), 0).rgb;
    // Whatever is brighter than white is compressed after antialiasing, in linear light as the kernel works.
    return vec4f(color / (1.0 + max(color - 0.8, vec3f(0.0))), 1.0);
}

// Triangles in space, made of their indices.

struct Camera {
    to_clip: mat4x4f,
}

@group(0) @binding(0) var<uniform> camera: Camera;

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) normal: vec3f,
    @location(1) @interpolate(flat) color: vec3f,
}

fn number(index: u32) -> f32 {
    var n = index * 747796405u + 2891336453u;
    n = ((n >> ((n >> 28u) + 4u)) ^ n) * 277803737u;
    return f32((n >> 22u) ^ n & 0xffffu) / 65536.0 % 1.0;
}

fn place(index: u32) -> vec3f {
    return vec3f(number(3u * index), number(3u * index + 1u), number(3u * index + 2u));
}

@vertex
fn corner(@builtin(vertex_index) index: u32) -> Corner {
    let triangle = index / 3u;
    let center = (place(1000u + triangle) - 0.5) * vec3f(4.0, 3.0, 4.0) - vec3f(0.0, 0.0, 5.0);
    var at: array<vec3f, 3>;
    for (var k = 0u; k < 3u; k++) {
        at[k] = center + 1.6 * (place(3u * triangle + k) - 0.5);
    }
    let across = normalize(cross(at[1] - at[0], at[2] - at[0]));
    // Towards the camera, on both sides.
    let normal = across * select(1.0, -1.0, across.z < 0.0);
    let lit = 0.2 + 0.8 * max(dot(normal, normalize(vec3f(1.0, 2.0, 3.0))), 0.0);
    return Corner(camera.to_clip * vec4f(at[index % 3u], 1.0), normal, lit * place(7000u + triangle));
}

struct Shaded {
    @location(0) color: vec4f,
}

@fragment
fn shaded(in: Corner) -> Shaded {
    return Shaded(vec4f(in.color, 1.0));
}

@fragment
fn normals(in: Corner) -> @location(0) vec4f {
    return vec4f(in.normal, 0.0);
}

struct Guided {
    @location(0) normal: vec4f,
    @location(1) guide: vec4f,
}

// A guide of half of the brightness.
@fragment
fn guided(in: Corner) -> Guided {
    return Guided(vec4f(in.normal, 0.0), vec4f(0.5 * in.color, 0.0));
}

// Shading where the place map says, from pictures of all places.

@group(0) @binding(1) var pictures: texture_2d_array<f32>;
@group(0) @binding(2) var places: texture_2d<u32>;

@vertex
fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, k == 1u), select(-1.0, 3.0, k == 2u), 0.0, 1.0);
}

@fragment
fn chosen(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    return textureLoad(pictures, pixel, textureLoad(places, pixel, 0).x, 0);
}

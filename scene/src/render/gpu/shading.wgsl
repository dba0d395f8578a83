// Shades a G-buffer, one sample a pixel. Follows `shade.wgsl` in one module.

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
@group(0) @binding(2) var normal_depth: texture_2d<f32>;
@group(0) @binding(3) var color_material: texture_2d<f32>;
// Rows from the top. A buffer, since few devices can read and write a texture of four floats.
@group(0) @binding(4) var<storage, read_write> colors: array<vec4f>;

@compute @workgroup_size(8, 8)
fn light(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.size) {
        return;
    }
    let geometry = textureLoad(normal_depth, id.xy, 0);
    let paint = textureLoad(color_material, id.xy, 0);
    let place = (vec2f(id.xy) + 0.5 + frame.offset) / vec2f(frame.size) * 2.0 - 1.0;
    let color = shade(Surface(geometry.xyz, geometry.w, paint.xyz, paint.w), ray_through(place));
    let at = id.y * frame.size.x + id.x;
    // Not 0 times what was there, which may be anything.
    var before = vec4f(0.0);
    if frame.keep > 0.0 {
        before = colors[at];
    }
    colors[at] = before + vec4f(color, 1.0);
}

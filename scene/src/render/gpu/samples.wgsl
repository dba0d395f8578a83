// One sample of each pixel of a multisampled G-buffer as plain floats, rows from the top: normal, then depth.

@group(0) @binding(0) var depth: texture_multisampled_2d<f32>;
@group(0) @binding(1) var normal: texture_multisampled_2d<f32>;
@group(0) @binding(2) var<storage, read_write> texels: array<vec4f>;
@group(0) @binding(3) var<uniform> sample: vec4u;

@compute @workgroup_size(8, 8)
fn read_sample(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(depth);
    if any(id.xy >= size) {
        return;
    }
    let k = i32(sample.x);
    texels[id.y * size.x + id.x] = vec4f(textureLoad(normal, id.xy, k).xyz, textureLoad(depth, id.xy, k).x);
}

// Shades the pixels of a list at one of their samples, a thread for each entry. Follows `shade.wgsl` and `shading.wgsl` in one module.

// Of `sraa_extra`: workgroups to dispatch for the list, and how many pixels wanted to be in it.
@group(0) @binding(5) var<storage, read> extra_counts: array<u32, 4>;
// A pixel as x + 65536 y, and the number of its sample.
@group(0) @binding(6) var<storage, read> extra_list: array<vec2u>;
// The sample that the G-buffer was drawn at.
@group(0) @binding(7) var<uniform> drawn: u32;

@compute @workgroup_size(64)
fn light_listed(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= min(extra_counts[3], arrayLength(&extra_list)) {
        return;
    }
    let entry = extra_list[id.x];
    if entry.y != drawn {
        return;
    }
    let pixel = vec2u(entry.x & 0xffffu, entry.x >> 16u);
    let geometry = textureLoad(normal_depth, pixel, 0);
    let paint = textureLoad(color_material, pixel, 0);
    let place = (vec2f(pixel) + 0.5 + frame.offset) / vec2f(frame.size) * 2.0 - 1.0;
    let color = shade(Surface(geometry.xyz, geometry.w, paint.xyz, paint.w), ray_through(place));
    colors[pixel.y * frame.size.x + pixel.x] = vec4f(color, 1.0);
}

// The G-buffer: depth, normal, colour and material of what is seen.

struct View {
    to_clip: mat4x4f,
}

struct Corner {
    @builtin(position) clip: vec4f,
    @location(0) depth: f32,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
    @location(3) @interpolate(flat) material: u32,
}

struct Texel {
    @location(0) depth: f32,
    @location(1) normal: vec4f,
    @location(2) color: vec4f,
}

@group(0) @binding(0) var<uniform> view: View;

@vertex
fn corner(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
    @location(3) material: u32,
) -> Corner {
    // Clip space's w is linear depth.
    let clip = view.to_clip * vec4f(position, 1.0);
    return Corner(clip, clip.w, normal, color, material);
}

@fragment
fn texel(seen: Corner, @builtin(front_facing) front: bool) -> Texel {
    // Both sides are drawn, each with the normal of the side that is seen.
    let normal = normalize(seen.normal) * select(-1.0, 1.0, front);
    return Texel(seen.depth, vec4f(normal, 0.0), vec4f(seen.color, f32(seen.material)));
}

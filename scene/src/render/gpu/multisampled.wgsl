// Geometry at every sample of a multisampled texture in one pass. Follows `geometry.wgsl` in one module.

// As `Corner`, evaluated at each sample. Software drivers (lavapipe, SwiftShader) evaluate a/w there, but multiply by w of
// the pixel's centre. `one` is off by the same factor, and what is divided by it is right everywhere.
struct SampledCorner {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(perspective, sample) normal: vec3f,
    @location(1) @interpolate(flat) material: u32,
    @location(2) @interpolate(perspective, sample) place: vec3f,
    @location(3) @interpolate(perspective, sample) depth_one: vec2f,
    @location(4) @interpolate(perspective, sample) uv_density: vec3f,
    @location(5) @interpolate(flat) image: u32,
}

struct SampledTexels {
    @location(0) depth: f32,
    @location(1) normal: vec4f,
}

@vertex
fn sampled_corner(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
    @location(3) material: u32,
    @location(4) uv: vec2f,
    @location(5) image: u32,
    @location(6) density: f32,
) -> SampledCorner {
    let clip = frame.to_clip * vec4f(position, 1.0);
    // Not the literal, which a driver may carry over to the fragments as it is.
    let one = f32(min(frame.size.x, 1u));
    let turned = (frame.to_view * vec4f(normal, 0.0)).xyz;
    return SampledCorner(clip, turned, material, position, vec2f(linear_depth(position), one), vec3f(uv, density), image);
}

@fragment
fn sampled_texels(surface: SampledCorner, @builtin(front_facing) front: bool) -> SampledTexels {
    let one = surface.depth_one.y;
    let place = surface.place / one;
    let depth = surface.depth_one.x / one;
    let normal = normalize(surface.normal);
    let uv_density = surface.uv_density / one;
    let paint = paint_of(surface.image, uv_density.xy, uv_density.z, place, depth, normal);
    if (surface.material == CHAIN_LINK && !is_wire(place)) || paint.color.w < paint.cutoff {
        discard;
    }
    return SampledTexels(depth, vec4f(seen_normal(normal, surface.material, place, depth, front), 0.0));
}

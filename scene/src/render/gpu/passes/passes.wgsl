// The further passes of ways to antialias a frame. Follows `geometry.wgsl` and `shade.wgsl` in one module.

@group(0) @binding(2) var normal_depth: texture_2d<f32>;
@group(0) @binding(3) var color_material: texture_2d<f32>;
@group(0) @binding(4) var shaded: texture_storage_2d<rgba16float, write>;

// What SRAA reads of a geometry sample.
struct Auxiliary {
    @location(0) depth: f32,
    @location(1) normal: vec4f,
}

@fragment
fn auxiliary(surface: Corner, @builtin(front_facing) front: bool) -> Auxiliary {
    if seen(surface).hole {
        discard;
    }
    let normal = seen_normal(surface.normal, surface.material, surface.place, surface.depth, front);
    return Auxiliary(surface.depth, vec4f(normal, 0.0));
}

// The mean of several evaluations at places of their own within the pixel, the first of them where the sample is. Their
// number is a uniform, and the view direction, texture, highlight and haze follow from the place: no compiler can leave one
// out. It may share what follows from the normal alone, the ambient and diffuse terms.
fn evaluated(surface: Surface, pixel: vec2f) -> vec3f {
    let place = (pixel + frame.offset) / vec2f(frame.size) * 2.0 - 1.0;
    var sum = vec3f(0.0);
    for (var k = 0u; k < frame.evaluations; k++) {
        let within = fract(f32(k) * vec2f(0.7548777, 0.5698403) + 0.5) - 0.5;
        sum += shade(surface, ray_through(place + 2.0 * within / vec2f(frame.size)));
    }
    return sum / f32(frame.evaluations);
}

@compute @workgroup_size(8, 8)
fn deferred(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.size) {
        return;
    }
    let geometry = textureLoad(normal_depth, id.xy, 0);
    let paint = textureLoad(color_material, id.xy, 0);
    let surface = Surface(geometry.xyz, geometry.w, paint.xyz, paint.w);
    textureStore(shaded, id.xy, vec4f(evaluated(surface, vec2f(id.xy) + 0.5), 1.0));
}

@fragment
fn forward(surface: Corner, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let paint = seen(surface);
    if paint.hole {
        discard;
    }
    let normal = seen_normal(surface.normal, surface.material, surface.place, surface.depth, front);
    let nearest = Surface(normal, surface.depth, paint.color, f32(surface.material));
    return vec4f(evaluated(nearest, surface.clip.xy), 1.0);
}

// A triangle around the picture, behind everything.
@vertex
fn behind(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn forward_sky(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return vec4f(evaluated(Surface(vec3f(0.0, 0.0, 1.0), SKY_DEPTH, vec3f(0.0), 0.0), at.xy), 1.0);
}

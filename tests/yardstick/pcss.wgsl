// Contact-hardening shadows, split over pixel quads, written by hand: the yardstick for shaders-out/pcss.wgsl.
// tests/tests/shaders/yardstick.rs runs it; docs/emitted-code.md compares the two.

@group(0) @binding(0) var shadow: texture_depth_2d;
@group(0) @binding(1) var shadow_sampler: sampler_comparison;

// Widths in texels: of the search for blockers, and of the penumbra.
const SEARCH = 16.0;
const NARROWEST = 2.0;
const WIDEST = 24.0;
// Width of the penumbra for a difference of depths of 1.
const LIGHT = 400.0;

// Depth of a blocker and 1, or nothing and 0. `centre` is a place in texels, and a depth.
fn blocker(centre: vec3f, at: vec2f) -> vec2f {
    let place = centre.xy + at * (SEARCH / 8.0);
    let last = vec2f(textureDimensions(shadow) - 1);
    let depth = textureLoad(shadow, vec2i(clamp(place, vec2f(0.0), last)), 0);
    return select(vec2f(0.0), vec2f(depth, 1.0), depth < centre.z);
}

fn lit(centre: vec3f, at: vec2f) -> f32 {
    return textureSampleCompareLevel(shadow, shadow_sampler, centre.xy + at, centre.z);
}

@fragment
fn pcss(@builtin(position) position: vec4f, @location(0) coord: vec3f) -> @location(0) vec4f {
    // The quad's mean place and depth.
    let coord_row = coord + quadSwapX(coord);
    let centre = (coord_row + quadSwapY(coord_row)) * 0.25;
    // This lane's four of sixteen taps: -3, -1, 1 or 3 on each axis.
    let lane = vec2f(vec2i(position.xy) & vec2i(1)) * 2.0 - 1.0;
    let a = lane + vec2f(-2, -2);
    let b = lane + vec2f(2, -2);
    let c = lane + vec2f(-2, 2);
    let d = lane + vec2f(2, 2);

    let size = vec2f(textureDimensions(shadow));
    let texel = vec3f(centre.xy * size, centre.z);
    let own = blocker(texel, a) + blocker(texel, b) + blocker(texel, c) + blocker(texel, d);
    let own_row = own + quadSwapX(own);
    let found = own_row + quadSwapY(own_row);

    // Without a blocker all is light, whatever the width.
    let distance = centre.z - found.x / max(found.y, 1.0);
    let penumbra = select(NARROWEST, clamp(distance * LIGHT, NARROWEST, WIDEST), found.y > 0.5);

    let width = penumbra / 8.0;
    let sum = lit(centre, a * width / size)
        + lit(centre, b * width / size)
        + lit(centre, c * width / size)
        + lit(centre, d * width / size);
    let row = sum + quadSwapX(sum);
    return vec4f((row + quadSwapY(row)) / 16.0);
}

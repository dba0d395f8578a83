// SRAA with 4 geometry samples and default options, written by hand: the yardstick for shaders-out/sraa4.wgsl.
// tests/tests/shaders/yardstick.rs runs it; docs/emitted-code.md compares the two.

@group(0) @binding(0) var depth: texture_2d_array<f32>;
@group(0) @binding(1) var normal: texture_2d_array<f32>;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var destination: texture_storage_2d<rgba16float, write>;

// The layer of the pixels' centres, which are shaded.
const CENTRE = 4;
// As deep as anything counts; the sky is infinitely deep.
const DEEPEST = 1e30;
// Differences from here on are alike.
const FAR = 16.0;
// tau * log2(e)
const STEEPNESS = 721.34753;
const EPSILON = 1e-30;

struct Surface {
    at: vec2i,
    depth: f32,
    normal: vec3f,
}

struct Sum {
    color: vec4f,
    weight: f32,
}

fn surface(at: vec2i, layer: i32) -> Surface {
    let stored = textureLoad(depth, at, layer, 0).x;
    let deep = select(DEEPEST, stored, abs(stored) < DEEPEST);
    return Surface(at, deep, textureLoad(normal, at, layer, 0).xyz);
}

// At most FAR, which a NaN is too.
fn bounded(difference: f32) -> f32 {
    return select(FAR, difference, difference < FAR);
}

// 0 for the same surface, 1 or more for unrelated ones.
fn difference(a: Surface, b: Surface) -> f32 {
    return min(max(abs(a.depth - b.depth), bounded(1.0 - dot(a.normal, b.normal))), FAR);
}

// What four taps give to a sample, by how near they are and how like; a quarter in all.
fn shares(tents: vec4f, seen: Surface, a: Surface, b: Surface, c: Surface, d: Surface) -> vec4f {
    let differences =
        vec4f(difference(seen, a), difference(seen, b), difference(seen, c), difference(seen, d));
    let nearest = min(min(min(differences.x, differences.y), differences.z), differences.w);
    let w = tents * exp2(-STEEPNESS * (differences - nearest));
    return w * (0.25 / (w.x + w.y + w.z + w.w));
}

// A colour that is infinite or not a number gives its weight to the others.
fn add(sum: ptr<function, Sum>, at: vec2i, weight: f32) {
    let texel = textureLoad(color, at, 0);
    let finite = all((bitcast<vec4u>(texel) & vec4u(0x7fffffff)) < vec4u(0x7f800000));
    let w = select(0.0, weight, finite);
    (*sum).color += w * select(vec4f(0.0), texel, finite);
    (*sum).weight += w;
}

@compute @workgroup_size(16, 16, 1)
fn sraa(@builtin(global_invocation_id) id: vec3u) {
    let frame = vec2i(textureDimensions(destination));
    let pixel = vec2i(id.xy);
    if any(pixel >= frame) {
        return;
    }
    let low = max(pixel - 1, vec2i(0));
    let high = min(pixel + 1, frame - 1);
    let nw = surface(low, CENTRE);
    let n = surface(vec2i(pixel.x, low.y), CENTRE);
    let ne = surface(vec2i(high.x, low.y), CENTRE);
    let w = surface(vec2i(low.x, pixel.y), CENTRE);
    let c = surface(pixel, CENTRE);
    let e = surface(vec2i(high.x, pixel.y), CENTRE);
    let sw = surface(vec2i(low.x, high.y), CENTRE);
    let s = surface(vec2i(pixel.x, high.y), CENTRE);
    let se = surface(high, CENTRE);

    // The samples lie at (-1, -3), (3, -1), (-3, 1) and (1, 3) eighths of a pixel from its centre.
    let s0 = shares(vec4f(3, 21, 5, 35) / 64, surface(pixel, 0), nw, n, w, c);
    let s1 = shares(vec4f(5, 3, 35, 21) / 64, surface(pixel, 1), n, ne, c, e);
    let s2 = shares(vec4f(21, 35, 3, 5) / 64, surface(pixel, 2), w, c, sw, s);
    let s3 = shares(vec4f(35, 5, 21, 3) / 64, surface(pixel, 3), c, e, s, se);

    var sum: Sum;
    add(&sum, nw.at, s0.x);
    add(&sum, n.at, s0.y + s1.x);
    add(&sum, ne.at, s1.y);
    add(&sum, w.at, s0.z + s2.x);
    add(&sum, c.at, s0.w + s1.z + s2.y + s3.x);
    add(&sum, e.at, s1.w + s3.y);
    add(&sum, sw.at, s2.z);
    add(&sum, s.at, s2.w + s3.z);
    add(&sum, se.at, s3.w);
    textureStore(destination, pixel, select(vec4f(0.0), sum.color / sum.weight, sum.weight > EPSILON));
}

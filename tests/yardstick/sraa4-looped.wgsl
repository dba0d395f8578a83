// SRAA with 4 geometry samples and the loops of its source, by hand: the yardstick for shaders-out/sraa4-looped.wgsl.
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
// Where in a pixel geometry is sampled, in sixteenths of a pixel from its centre.
const LATIN4 = array(vec2f(-2, -6), vec2f(6, -2), vec2f(-6, 2), vec2f(2, 6));

struct Surface {
    depth: f32,
    normal: vec3f,
}

fn surface(at: vec2i, layer: i32) -> Surface {
    let stored = textureLoad(depth, at, layer, 0).x;
    let deep = select(DEEPEST, stored, abs(stored) < DEEPEST);
    return Surface(deep, textureLoad(normal, at, layer, 0).xyz);
}

// At most FAR, which a NaN is too.
fn bounded(difference: f32) -> f32 {
    return select(FAR, difference, difference < FAR);
}

// 0 for the same surface, 1 or more for unrelated ones.
fn difference(a: Surface, b: Surface) -> f32 {
    return min(max(abs(a.depth - b.depth), bounded(1.0 - dot(a.normal, b.normal))), FAR);
}

// Linear from 1 at zero to 0 at one, on each axis.
fn tent(away: vec2f) -> f32 {
    let near = max(1.0 - abs(away), vec2f(0.0));
    return near.x * near.y;
}

fn neighbour(tap: i32) -> vec2i {
    return vec2i(tap % 3, tap / 3) - 1;
}

fn is_finite(texel: vec4f) -> bool {
    return all((bitcast<vec4u>(texel) & vec4u(0x7fffffff)) < vec4u(0x7f800000));
}

@compute @workgroup_size(16, 16, 1)
fn sraa(@builtin(global_invocation_id) id: vec3u) {
    let frame = vec2i(textureDimensions(destination));
    let pixel = vec2i(id.xy);
    if any(pixel >= frame) {
        return;
    }
    let last = frame - 1;
    var weights: array<f32, 9>;
    for (var sample = 0; sample < 4; sample++) {
        let place = LATIN4[sample] / 16.0;
        let seen = surface(pixel, sample);
        var distances: array<f32, 9>;
        var nearest = FAR;
        for (var tap = 0; tap < 9; tap++) {
            let away = neighbour(tap);
            if tent(vec2f(away) - place) > 0.0 {
                let d = difference(seen, surface(clamp(pixel + away, vec2i(0), last), CENTRE));
                distances[tap] = d;
                nearest = min(nearest, d);
            }
        }
        var tap_weights: array<f32, 9>;
        var sum = 0.0;
        for (var tap = 0; tap < 9; tap++) {
            let near = tent(vec2f(neighbour(tap)) - place);
            if near > 0.0 {
                let w = near * exp2(-STEEPNESS * (distances[tap] - nearest));
                tap_weights[tap] = w;
                sum += w;
            }
        }
        let scale = 0.25 / sum;
        for (var tap = 0; tap < 9; tap++) {
            weights[tap] += tap_weights[tap] * scale;
        }
    }
    var result = vec4f(0.0);
    var sum = 0.0;
    for (var tap = 0; tap < 9; tap++) {
        let shaded = textureLoad(color, clamp(pixel + neighbour(tap), vec2i(0), last), 0);
        let w = weights[tap];
        if w != 0.0 && is_finite(shaded) {
            result += w * shaded;
            sum += w;
        }
    }
    textureStore(destination, pixel, select(vec4f(0.0), result / sum, sum > EPSILON));
}

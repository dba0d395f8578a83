// Asks the lanes of pixel quads what arrives. CONTROL is Fine or Coarse; ANSWERS is written by the host.

@vertex
fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, k == 1u), select(-1.0, 3.0, k == 2u), 0.0, 1.0);
}

// Whether 4 arrives where the lane that it comes from has it, and 0 where another has.
fn arrived(heard: f32, lane: u32, direction: u32, hot: u32) -> bool {
    return heard == select(0.0, 4.0, (lane ^ direction) == hot);
}

@fragment
fn probe(@builtin(position) position: vec4f) -> @location(0) vec4u {
    let pixel = vec2u(floor(position.xy));
    let lane = (pixel.x & 1u) + 2u * (pixel.y & 1u);
    let towards = vec2f(1.0) - 2.0 * vec2f(pixel & vec2u(1u));
    // Squares of neighbours differ by twice the lower one and 1: this tells where the quad begins.
    let place = vec2f(pixel);
    let square = place * place;
    let first = vec2i(round((vec2f(dpdxCONTROL(square.x), dpdyCONTROL(square.y)) - 1.0) * 0.5));
    var derivatives = 0u;
    var subgroup = 0u;
ANSWERS
    return vec4u(derivatives, subgroup, bitcast<vec2u>(first));
}

// Texel by texel into a target of any format.
@group(0) @binding(0) var source: texture_2d<f32>;

@vertex
fn corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn texel(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return textureLoad(source, vec2u(at.xy), 0);
}

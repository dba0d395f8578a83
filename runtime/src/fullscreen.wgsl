// One triangle that covers the whole target: its corners are (-1, -1), (3, -1) and (-1, 3) in clip space.
// A single triangle has no diagonal seam along which fragments would be shaded twice.
@vertex
fn fullscreen(@builtin(vertex_index) corner: u32) -> @builtin(position) vec4f {
    let x = f32((corner << 1u) & 2u);
    let y = f32(corner & 2u);
    return vec4f(2.0 * x - 1.0, 2.0 * y - 1.0, 0.0, 1.0);
}

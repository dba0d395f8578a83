/// Interpolated values, of triangles.
pub fn drawn(shadow: &DepthTexture, compare: &ComparisonSampler, bias: f32, coord: Quad<Vec3>, shade: Quad<f32>) -> Quad<Vec4> {
    let lit = shadow.compare(compare, coord.truncate(), coord.z() - bias);
    Vec4::ONE * (lit * shade).average()
}

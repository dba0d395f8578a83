pub fn k(depth: &FrameLayers<f32>, layer: i32, pixel: IVec2) -> Vec4 {
    Vec4::splat(depth.load(pixel, layer as usize))
}

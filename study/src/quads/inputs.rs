//! Inputs of full-screen filters: a rendered frame, and its occlusion at a lower resolution.

use super::subject::{OCCLUSION, compile_filter};
use super::{QUAD, QuadsError};
use glam::{UVec2, Vec2, Vec4, vec3};
use straightline_bench::execute::{Bench, Inputs};
use straightline_kernels::prelude::Frame;
use straightline_manifest::Stage;
use straightline_scene::render::{GpuRenderer, Renderer};
use straightline_scene::scene::Scene;

/// Returns a rendered frame: its colours with depth, its depths, normals, and the angle of a pixel.
pub fn screen_inputs(bench: &Bench, scene: &Scene, size: UVec2) -> Result<Inputs, QuadsError> {
    let renderer = GpuRenderer::new(bench.device(), bench.queue(), scene, size)?;
    let color = renderer.draw_shaded(Vec2::ZERO)?;
    let (depth, normal) = renderer.draw_geometry(Vec2::ZERO)?;
    let with_depth = color
        .texels()
        .iter()
        .zip(depth.texels())
        .map(|(c, z)| c.truncate().extend(*z));
    let image = Frame::new(size, with_depth.collect());
    let depth = Frame::new(size, depth.texels().iter().map(|z| Vec4::splat(*z)).collect());
    // The testbed looks along -z with y up, the kernel along z with y down.
    let turned = normal.texels().iter().map(|n| vec3(n.x, -n.y, -n.z).extend(0.0));
    let normal = Frame::new(size, turned.collect());
    let angle = 2.0 * scene.camera.half_extent(size).y / size.y as f32;
    Ok(Inputs::new(size)
        .with_image("image", image)
        .with_image("depth", depth)
        .with_image("normal", normal)
        .with_uniform("pixel_angle", &[f64::from(angle)]))
}

/// Adds the inputs of upsampling: occlusion and surfaces at a resolution `factor` times lower, 2 or 4. The occlusion is
/// taken from the full resolution, to isolate the loss of upsampling.
pub fn low_resolution(bench: &Bench, full: &Inputs, factor: u32) -> Result<Inputs, QuadsError> {
    let occlusion = compile_filter(
        "quad_ssao",
        &[&[("sharing", "alone")], &OCCLUSION[..]].concat(),
        None,
        QUAD,
    )?;
    let occlusion = bench.run(&occlusion, Stage::Compute, full)?;
    let mut low = full.clone().with_image("image", occlusion);
    low.size = full.size.map(|n| n.div_ceil(factor) + 1);
    let factor = if factor == 2 { "twice" } else { "four-times" };
    let down = |gives: &str| -> Result<Frame<Vec4>, QuadsError> {
        let compiled = compile_filter("downsampling", &[("gives", gives), ("factor", factor)], None, QUAD)?;
        Ok(bench.run(&compiled, Stage::Compute, &low)?)
    };
    let (packed, surface) = (down("packed")?, down("surface")?);
    Ok(full
        .clone()
        .with_image("low", packed)
        .with_image("low_surface", surface))
}

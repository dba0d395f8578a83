//! Loading of scenes and choice of a renderer.

use crate::args::ViewArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use glam::{UVec2, Vec2};
use indicatif::{ProgressBar, ProgressStyle};
use std::path::Path;
use straightline_scene::capture::ShadingSample;
use straightline_scene::gbuffer;
use straightline_scene::render::{CpuRenderer, GpuRenderer, Renderer};
use straightline_scene::scene::{self, Scene, Viewpoint};

/// Loads a model, or else the built-in scene of this name.
pub fn load_scene(mesh: Option<&Path>, name: &str) -> Result<Scene, Failure> {
    load_seen(mesh, name, &Viewpoint::default())
}

/// Loads the requested scene, seen from the requested viewpoint.
pub fn load_viewed(args: &ViewArgs) -> Result<Scene, Failure> {
    let viewpoint = Viewpoint {
        eye: args.eye,
        target: args.target,
        vertical_fov: args.fov.map(f32::to_radians),
    };
    load_seen(args.mesh.as_deref(), &args.scene, &viewpoint)
}

fn load_seen(mesh: Option<&Path>, name: &str, viewpoint: &Viewpoint) -> Result<Scene, Failure> {
    match mesh {
        Some(path) => scene::load_seen(path, viewpoint).map_err(Failure::from_error),
        None => {
            let mut scene = Scene::from_name(name).map_err(|error| Failure::Usage(error.to_string()))?;
            scene.camera = viewpoint.camera(|_| scene.camera, |point| point);
            scene.check().map_err(Failure::from_error)?;
            Ok(scene)
        }
    }
}

/// Creates a renderer on the GPU if there is one, else on the CPU.
pub fn create_renderer(gpu: Option<&Gpu>, scene: &Scene, size: UVec2) -> Result<Box<dyn Renderer>, Failure> {
    Ok(match gpu {
        Some(gpu) => Box::new(GpuRenderer::new(&gpu.device, &gpu.queue, scene, size).map_err(Failure::from_error)?),
        None => Box::new(CpuRenderer::new(scene, size).map_err(Failure::from_error)?),
    })
}

/// Returns the sample offsets of a named pattern, or of a list.
pub fn sample_offsets(name: &str) -> Result<Vec<Vec2>, Failure> {
    gbuffer::pattern_offsets(name).ok_or_else(|| {
        Failure::Usage(format!(
            "there is no pattern `{name}`; use one of {}, or x and y of each sample, separated by commas, each from -0.5 to 0.5",
            gbuffer::PATTERNS.join(", ")
        ))
    })
}

/// Parses the position of the shading sample; `shaded` are the geometry samples of `listed`.
pub fn parse_shading(name: &str, shaded: &[usize]) -> Result<ShadingSample, Failure> {
    match (name, shaded) {
        ("centre", []) => Ok(ShadingSample::Centre),
        ("sample0", []) => Ok(ShadingSample::Sample(0)),
        ("placed", []) => Ok(ShadingSample::Placed),
        ("centre" | "sample0" | "placed", _) => Err(Failure::Usage(format!(
            "--shaded lists the samples of --shading listed, and --shading is {name}"
        ))),
        ("listed", [only]) => Ok(ShadingSample::Sample(*only)),
        ("listed", several) if matches!(several.len(), 2 | 4) => Ok(ShadingSample::Samples(several.to_vec())),
        ("listed", several) => Err(Failure::Usage(format!(
            "--shading listed needs one, two or four samples in --shaded, such as --shaded 0,3, and there are {}",
            several.len()
        ))),
        _ => Err(Failure::Usage(format!(
            "shading cannot be at `{name}`; use centre, sample0, placed or listed"
        ))),
    }
}

/// Creates a progress bar on stderr, labelled `what`.
pub fn progress_bar(what: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:<28} [{bar:30}] {pos}/{len}, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(1).with_style(style).with_message(what.to_owned())
}

/// Returns a progress callback that advances `bar`.
pub fn advance_bar(bar: &ProgressBar) -> impl FnMut(usize, usize) + '_ {
    |done, total| {
        bar.set_length(total as u64);
        bar.set_position(done as u64);
    }
}

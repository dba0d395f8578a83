//! `capture`: a scene or a model as the frame that `resolve` reads.

use crate::args::{CaptureArgs, PlacedByArg};
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use straightline_scene::capture::ShadingSample;
use straightline_scene::gbuffer;
use straightline_scene::render::{self, GuideLight, PlacedBy};

/// Renders and writes a capture, or nothing.
pub fn render_capture(args: &CaptureArgs) -> Result<(), Failure> {
    if !cfg!(feature = "exr") {
        return Err(super::lacking_feature("exr"));
    }
    let samples = scene::sample_offsets(&args.pattern)?;
    let shading = scene::parse_shading(&args.shading, &args.shaded)?;
    let placed_by = placed_by(args, &shading)?;
    let world = scene::load_viewed(&args.view)?;
    let gpu = Gpu::open(&args.adapter)?;
    let renderer = scene::create_renderer(gpu.as_ref(), &world, args.size)?;
    let capture = match placed_by {
        Some(by) => render::capture_placed(renderer.as_ref(), &samples, by),
        None => render::capture_scene(renderer.as_ref(), &samples, shading),
    };
    let mut capture = capture.map_err(Failure::from_error)?;
    if args.albedo {
        render::add_albedo(&mut capture, renderer.as_ref()).map_err(Failure::from_error)?;
    }
    if args.guide {
        render::add_guide(&mut capture, renderer.as_ref(), GuideLight::default()).map_err(Failure::from_error)?;
    }
    if let Some(samples) = &args.reference {
        let side = if samples == "256" { 16 } else { 4 };
        let bar = scene::progress_bar(&format!("rendering {samples} samples"));
        let frame = render::render_reference(renderer.as_ref(), side, &mut scene::advance_bar(&bar))
            .map_err(Failure::from_error)?;
        bar.finish_and_clear();
        capture.reference = Some(frame);
    }
    capture.write(&args.out).map_err(Failure::from_error)?;
    outln!("{}", args.out.display());
    Ok(())
}

/// Returns the metric that places shading, if it is placed: planes, unless depths are asked for or the samples' places are
/// unknown.
fn placed_by(args: &CaptureArgs, shading: &ShadingSample) -> Result<Option<PlacedBy>, Failure> {
    match (shading, args.placed_by) {
        (ShadingSample::Placed, Some(PlacedByArg::Planes)) => Ok(Some(PlacedBy::Planes)),
        (ShadingSample::Placed, Some(PlacedByArg::Depths)) => Ok(Some(PlacedBy::Depths)),
        (ShadingSample::Placed, None) => match gbuffer::PATTERNS.contains(&args.pattern.as_str()) {
            true => Ok(Some(PlacedBy::Planes)),
            false => Ok(Some(PlacedBy::Depths)),
        },
        (_, Some(_)) => Err(Failure::Usage(format!(
            "--placed-by is of --shading placed, and --shading is {}",
            args.shading
        ))),
        (_, None) => Ok(None),
    }
}

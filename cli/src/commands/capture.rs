//! `capture`: a scene or a model as the frame that `resolve` reads.

use crate::args::CaptureArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use straightline_testbed::render;

/// Renders and writes a capture, or nothing.
pub fn run(args: &CaptureArgs) -> Result<(), Failure> {
    if !cfg!(feature = "exr") {
        return Err(super::lacking("exr"));
    }
    let samples = scene::pattern(&args.pattern)?;
    let shading = scene::shading(&args.shading, &args.shaded)?;
    let world = scene::viewed(&args.view)?;
    let gpu = Gpu::open(&args.adapter)?;
    let renderer = scene::renderer(gpu.as_ref(), &world, args.size)?;
    let mut capture = render::capture(renderer.as_ref(), &samples, shading).map_err(Failure::of)?;
    if args.albedo {
        render::add_albedo(&mut capture, renderer.as_ref()).map_err(Failure::of)?;
    }
    if let Some(samples) = &args.reference {
        let side = if samples == "256" { 16 } else { 4 };
        let bar = scene::bar(&format!("rendering {samples} samples"));
        let frame = render::reference(renderer.as_ref(), side, &mut scene::advance(&bar)).map_err(Failure::of)?;
        bar.finish_and_clear();
        capture.reference = Some(frame);
    }
    capture.write(&args.out).map_err(Failure::of)?;
    outln!("{}", args.out.display());
    Ok(())
}

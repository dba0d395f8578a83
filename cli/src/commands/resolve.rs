//! `resolve`: antialiases a captured frame.

use crate::args::{Executor, ResolveArgs, SettingsArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use glam::Vec4;
use serde_json::json;
use straightline_bench::execute::interpret_kernel;
use straightline_codegen::{Compiled, Kernel, OptionValue, OptionValues, Settings, files};
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics;
use straightline_scene::capture::Capture;
use straightline_scene::gbuffer;
use straightline_scene::picture;

/// Reads a capture, resolves it with SRAA, writes the picture, and prints errors on request.
pub fn resolve_capture(args: &ResolveArgs) -> Result<(), Failure> {
    if !cfg!(feature = "exr") {
        return Err(super::lacking_feature("exr"));
    }
    check_extension(args)?;
    files::try_file(&args.out, false).map_err(Failure::from_error)?;
    let capture = Capture::read(&args.capture).map_err(Failure::from_error)?;
    let kernel = Kernel::builtin("sraa")?;
    let settings = with_capture(&kernel, &args.options, &capture)?;
    let compiled = kernel.compile(&settings)?;
    let inputs = gbuffer::sraa_inputs(&capture, &compiled.options).map_err(Failure::from_error)?;
    let warnings = capture_warnings(&capture, &compiled.options);
    for warning in &warnings {
        errln!("warning: {warning}");
    }
    let (resolved, by) = match args.executor {
        Executor::Gpu => {
            let gpu = Gpu::require(&args.adapter)?;
            let resolved = gpu.bench().run(&compiled, args.stage, &inputs);
            (resolved.map_err(Failure::from_error)?, gpu.describe())
        }
        Executor::Cpu => {
            let resolved = interpret_kernel::<f32>(&compiled, &inputs, false).map_err(Failure::from_error)?;
            (resolved.frame(&inputs), "CPU interpreter".to_owned())
        }
    };
    let errors = args
        .reference
        .then(|| measure_errors(&capture, &resolved))
        .transpose()?;
    picture::write_picture(&args.out, &resolved).map_err(Failure::from_error)?;
    print_report(args, &compiled, &by, &resolved, errors, &warnings)
}

/// Returns warnings about flaws of the capture that degrade the picture.
fn capture_warnings(capture: &Capture, options: &OptionValues) -> Vec<String> {
    let mut warnings = Vec::new();
    if let Some(misplaced) = gbuffer::find_misplaced(capture) {
        warnings.push(misplaced.describe_remedy().to_owned());
    }
    let by_planes = options.choice("metric") == Some("planes-normals");
    if let Some(share) = gbuffer::bent_normals(capture).filter(|_| by_planes) {
        warnings.push(format!(
            "{:.0} % of the normals stand off the planes of the depths, as those of normal maps do: write the normals of the geometry, or use \
             metric=depth",
            100.0 * share
        ));
    }
    if let Some(coarse) = gbuffer::detect_coarse_depth(capture, options) {
        warnings.push(format!(
            "depth is too coarse: {:.0} % of the samples on even ground are off their plane by what counts as more than {}, {:.1e}, and a tenth \
             by {:.1e} and more; store depth in 32 bits, reversed, move the near plane away, or set a lower depth-scale or higher thresholds",
            100.0 * coarse.share,
            match coarse.option {
                "tau" => "1 / tau",
                option => option,
            },
            coarse.threshold,
            coarse.least
        ));
    }
    warnings
}

fn print_report(
    args: &ResolveArgs,
    compiled: &Compiled,
    by: &str,
    resolved: &Frame<Vec4>,
    errors: Option<(f64, f64)>,
    warnings: &[String],
) -> Result<(), Failure> {
    let bad = metrics::non_finite(resolved);
    if args.json {
        let mut out = json!({
            "out": args.out, "executor": by, "options": compiled.options.spelled(),
            "size": resolved.size().to_array(), "non_finite_pixels": bad, "warnings": warnings,
        });
        if let Some((before, after)) = errors {
            out["psnr_1x_db"] = json!(before);
            out["psnr_db"] = json!(after);
        }
        outln!("{out:#}");
        return Ok(());
    }
    outln!("{}", args.out.display());
    if let Some((before, after)) = errors {
        outln!("PSNR against the reference: {after:.2} dB, and {before:.2} dB without antialiasing");
    }
    if bad > 0 {
        outln!("{bad} pixels are not finite");
    }
    Ok(())
}

/// Returns the PSNR of the capture's own colour, and of the resolved picture.
fn measure_errors(capture: &Capture, resolved: &Frame<Vec4>) -> Result<(f64, f64), Failure> {
    let Some(reference) = &capture.reference else {
        return Err(Failure::Failed(
            "the capture has no reference.exr to compare with; capture with --reference 256, or leave --reference out"
                .into(),
        ));
    };
    Ok((
        metrics::psnr(&capture.color, reference),
        metrics::psnr(resolved, reference),
    ))
}

/// Returns the requested options, completed by those that the capture determines: its sample positions.
fn with_capture(kernel: &Kernel, options: &SettingsArgs, capture: &Capture) -> Result<Settings, Failure> {
    let mut settings = options.settings();
    settings.options = settings.option_texts();
    settings.overrides.clear();
    let sampled = gbuffer::sampled_at(capture);
    let asked = kernel.option_values(&settings.options)?;
    let decided = kernel.option_values(&sampled)?;
    for (name, text) in sampled {
        let is_set = settings.options.iter().any(|(known, _)| *known == name);
        if let (Some(asked), Some(decided)) = (asked.get(&name), decided.get(&name))
            && is_set
            && asked != decided
        {
            return Err(Failure::Usage(format!(
                "--set {name}={asked}, but the capture was sampled with {name}={decided}"
            )));
        }
        if !is_set {
            settings.options.push((name, text));
        }
    }
    let height = capture.camera.and_then(|camera| camera.parallel_height);
    if let Some(height) = height
        && !settings.options.iter().any(|(name, _)| name == "difference")
    {
        let values = kernel.option_values(&settings.options)?;
        settings.options = gbuffer::in_parallel(&settings.options, &values, height);
    }
    let is_left = |value: &OptionValue| matches!(value, OptionValue::Uniform | OptionValue::Override(_));
    if let Some((name, value)) = asked.iter().find(|(_, value)| is_left(value)) {
        return Err(Failure::Usage(format!(
            "`{name}={value}` leaves the value to a host; here give a number"
        )));
    }
    Ok(settings)
}

/// Rejects a picture with an unsupported extension before any work is done.
fn check_extension(args: &ResolveArgs) -> Result<(), Failure> {
    let extension = args.out.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
    match extension {
        Some(e) if picture::EXTENSIONS.contains(&e.as_str()) => Ok(()),
        _ => Err(Failure::Usage(format!(
            "`{}` is not a kind of picture that can be written: end it in .{}",
            args.out.display(),
            picture::EXTENSIONS.join(" or .")
        ))),
    }
}

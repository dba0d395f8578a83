//! `study error`: methods of antialiasing against references.

use super::{ProgressBars, run_circumstances};
use crate::args::{CommonArgs, ErrorArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use std::collections::BTreeSet;
use std::path::Path;
use straightline_codegen::files;
use straightline_scene::capture::Capture;
use straightline_scene::scene::{self, FURTHER, NAMES, Scene};
use straightline_study::quality::{self, Method, OwnError, QualityError, Setup, Source};
use straightline_study::record::{Gap, QualityRecord, Record, SceneErrors};

/// Frames of the pan.
const FRAMES: u32 = 5;
const QUICK_FRAMES: u32 = 4;

/// Compares, writes the record and prints it.
pub fn compare_methods(common: &CommonArgs, args: &ErrorArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let own = parse_own_methods(args)?;
    check_names(&args.only)?;
    let sources = load_sources(args)?;
    let gpu = Gpu::require(&common.adapter)?;
    let setup = Setup {
        size: common.picture_size(),
        rounds: common.timing_rounds(),
        quick: common.quick,
        // Post-processed pictures are not compared between frames.
        pan_frames: match (args.post, common.quick) {
            (true, _) => 0,
            (_, true) => QUICK_FRAMES,
            _ => FRAMES,
        },
        post_processed: args.post,
        timed_scenes: if common.quick { 1 } else { usize::MAX },
        pictures: true,
        only: match args.presets {
            true => [quality::preset_names(), args.only.clone()].concat(),
            false => args.only.clone(),
        },
        own,
    };
    let mut circumstances = run_circumstances(common, &gpu);
    // A capture has its own size, which a record of captures alone states.
    let sizes: Vec<_> = sources.iter().map(|source| source.size(setup.size)).collect();
    if let Some(first) = sizes.first().filter(|first| sizes.iter().all(|size| size == *first)) {
        circumstances.size = first.to_array();
    }
    let mut outcome = quality::study_quality(&gpu.bench(), sources, &setup, progress).map_err(to_failure)?;
    circumstances.complete = outcome.complete;
    let record = QualityRecord {
        circumstances,
        timed_on: std::mem::take(&mut outcome.timed_on),
        pan_frames: setup.pan_frames,
        scenes: std::mem::take(&mut outcome.scenes),
    };
    // Record and pictures are one set.
    let mut set = std::mem::take(&mut outcome.pictures);
    set.extend(record.to_files(QualityRecord::STEM).map_err(Failure::from_error)?);
    files::write_all(&common.out, &set).map_err(Failure::from_error)?;
    print(&record, &common.out);
    Ok(())
}

/// Rejects names of unknown methods.
fn check_names(names: &[String]) -> Result<(), Failure> {
    let known = quality::list_methods(false);
    match names
        .iter()
        .find(|name| !known.iter().any(|method| method.name == **name))
    {
        Some(name) => Err(Failure::Usage(unknown_method(name, &known))),
        None => Ok(()),
    }
}

/// Returns the error message for an unknown method name.
pub fn unknown_method(name: &str, known: &[Method]) -> String {
    let mut said = format!("there is no method `{name}`; there are:");
    let mut width = usize::MAX;
    for method in known {
        // Names contain commas.
        let (own, fits) = (method.name.as_str(), width < WIDTH);
        said += if fits { "; " } else { "\n  " };
        said += own;
        width = if fits { width } else { 0 } + own.len() + 2;
    }
    said
}

/// Maximum width of a line of names, without the last name.
const WIDTH: usize = 80;

/// Parses the user's methods. Fails if a name is not unique.
fn parse_own_methods(args: &ErrorArgs) -> Result<Vec<Method>, Failure> {
    let mut stems: BTreeSet<String> = quality::list_methods(false).iter().map(Method::file_stem).collect();
    let mut own = Vec::new();
    for text in &args.methods {
        let method = parse_method(text)?;
        if !stems.insert(method.file_stem()) {
            return Err(Failure::Usage(format!(
                "there is a method `{}` already: give yours another name",
                method.name
            )));
        }
        own.push(method);
    }
    Ok(own)
}

/// Parses one method of the user's.
pub fn parse_method(text: &str) -> Result<Method, Failure> {
    Method::parse_own(text).map_err(|error| match error {
        OwnError::Kernel(errors) => Failure::Kernel(errors),
        other => Failure::Usage(other.to_string()),
    })
}

/// Converts errors, keeping the source location of kernel errors.
pub fn to_failure(error: QualityError) -> Failure {
    match error {
        QualityError::Kernel(errors) => Failure::Kernel(errors),
        other => Failure::from_error(other),
    }
}

/// Returns the requested sources; by default all scenes.
fn load_sources(args: &ErrorArgs) -> Result<Vec<Source>, Failure> {
    let mut sources = Vec::new();
    for name in &args.scene {
        let scene = Scene::from_name(name).map_err(|error| Failure::Usage(error.to_string()))?;
        sources.push(scene_source(name, scene));
    }
    for path in &args.mesh {
        let scene = scene::load_scene(path).map_err(Failure::from_error)?;
        sources.push(Source::Scene {
            name: path.display().to_string(),
            purpose: "a model".to_owned(),
            scene: Box::new(scene),
        });
    }
    for path in &args.capture {
        let capture = Capture::read(path).map_err(Failure::from_error)?;
        if capture.reference.is_none() {
            return Err(Failure::Failed(format!(
                "{} has no reference.exr to compare with: write one, shaded at many places of each pixel (docs/captures.md), \
                 or capture with --reference 256",
                path.display()
            )));
        }
        sources.push(Source::Capture {
            name: path.display().to_string(),
            capture: Box::new(capture),
        });
    }
    if args.wide || sources.is_empty() {
        let further = if args.wide { &FURTHER[..] } else { &[] };
        for (name, _) in NAMES.iter().chain(further) {
            sources.push(scene_source(name, Scene::from_name(name).map_err(Failure::from_error)?));
        }
    }
    Ok(sources)
}

fn scene_source(name: &str, scene: Scene) -> Source {
    let purpose = NAMES.iter().chain(&FURTHER).find(|(known, _)| *known == name);
    Source::Scene {
        name: name.to_owned(),
        purpose: purpose.map_or(String::new(), |(_, purpose)| (*purpose).to_owned()),
        scene: Box::new(scene),
    }
}

fn print(record: &QualityRecord, out: &Path) {
    for scene in &record.scenes {
        print_scene(record, scene);
    }
    let circumstances = &record.circumstances;
    if !circumstances.complete {
        outln!("Interrupted: only the scenes above were finished.\n");
    }
    let size = circumstances.size;
    outln!("{}x{} pixels, on {}.", size[0], size[1], circumstances.adapter);
    outln!(
        "All pictures and references at 8 bits of sRGB; PSNR in dB over linear colour clamped to 0..1; edges of geometry: pixels whose samples see several surfaces; edges of \
         shading: pixels of one surface whose sRGB colour varies by more than {:.0} of 255.",
        quality::STEP * 255.0
    );
    if !record.timed_on.is_empty() {
        outln!(
            "Times: medians of filters in turn, {} rounds, on {}.",
            circumstances.rounds,
            record.timed_on.join(" and ")
        );
    }
    outln!("error.json, error.csv and pictures are in {}.", out.display());
}

fn print_scene(record: &QualityRecord, scene: &SceneErrors) {
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let shares = &scene.shares;
    outln!("{}: {}", scene.scene, scene.purpose);
    outln!(
        "{} of the pixels have an edge of geometry, {} of shading; in {} a surface was seen by no shading sample.\n",
        percent(shares.geometry),
        percent(shares.shading),
        percent(shares.unseen)
    );
    outln!("{}", record.tabulate([scene]).without(&["scene", "options"]).to_text());
    for gap in &scene.gaps {
        outln!("{}", gap_in_words(gap));
    }
    for loss in quality::list_losses(scene) {
        outln!("{loss}");
    }
    for (method, reason) in &scene.absent {
        outln!("without {method}: {reason}");
    }
    outln!();
}

fn gap_in_words(gap: &Gap) -> String {
    let seen = match (gap.psnr_seen, gap.bound_psnr_seen) {
        (Some(own), Some(bound)) => format!("; where all surfaces were seen {:.2} dB", bound - own),
        _ => String::new(),
    };
    format!(
        "{} is {:.2} dB below {}: {:.2} dB for surfaces that no shading sample saw, {:.2} dB for borrowed colours{seen}; {:.0} % of \
         its squared error is in pixels with unseen surfaces",
        gap.method,
        gap.bound_psnr - gap.psnr,
        gap.bound,
        gap.bound_psnr - gap.ideal_psnr,
        gap.ideal_psnr - gap.psnr,
        100.0 * gap.error_unseen
    )
}

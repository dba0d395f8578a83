//! What variants read, on the device: once for each set of geometry samples.

use crate::tune::features::Static;
use crate::tune::space::{Offer, SampleSet, Space};
use crate::tune::steps::depth_scale;
use crate::tune::{Question, Subject, Term, TuneError};
use straightline_codegen::{Compiled, Kernel, Manifest, Settings, Stage};
use straightline_runtime::Pass;
use straightline_testbed::capture::Capture;
use straightline_testbed::execute::{Bench, ExecuteError, Inputs, Uploaded};
use straightline_testbed::gbuffer;
use straightline_testbed::render::{PLACED_BY, Placed};

/// Bytes of a geometry sample: depth as `r32float`, a normal as `rgba16float`, as `straightline budget` counts; albedo as
/// `rgba8unorm`.
const DEPTH_BYTES: u64 = 4;
const NORMAL_BYTES: u64 = 8;
const ALBEDO_BYTES: u64 = 4;

/// Bytes of a pixel: direct light and what does not follow the albedo as `rgba16float`, where it is shaded as `r8uint`.
const LIGHT_BYTES: u64 = 2 * 8;
const PLACE_BYTES: u64 = 1;

/// What the variants of one set of samples read, on the device.
#[derive(Debug)]
pub(super) struct Ground {
    /// The view, shaded at the pixels' centres or where a capture has it.
    pub uploaded: Uploaded,
    /// Uniforms; the images are on the device.
    pub inputs: Inputs,
    /// Geometry samples, and the centre's.
    pub layers: u64,
    /// The view shaded where the kernel `sraa_place` says.
    pub placing: Option<Placing>,
}

/// The pass that says where pixels are shaded, and what was shaded there.
#[derive(Debug)]
pub(in crate::tune) struct Placing {
    pub compiled: Compiled,
    pub known: Static,
    pub pass: Pass,
    /// What that pass reads.
    pub reads: Uploaded,
    /// What the filter then reads.
    pub uploaded: Uploaded,
    /// The pass's cycles, where a compiler was asked.
    pub cycles: Option<f64>,
}

impl Ground {
    /// The ground of the set of samples at `place` in the space.
    pub(super) fn new(
        bench: &Bench,
        (kernel, space): (&Kernel, &Space),
        place: usize,
        (capture, placed): (&Capture, Option<&Placed>),
    ) -> Result<Ground, TuneError> {
        let light = space.values(Term::Light).len() - 1;
        let richest = space.general().with(Term::Samples, place).with(Term::Light, light);
        let settings = space.settings(richest);
        let centred = shaded(settings.clone(), "centre");
        let (compiled, manifest) = manifest_of(bench, kernel, &centred)?;
        let inputs = gbuffer::inputs(capture, &compiled.options)?;
        let uploaded = bench.upload(&manifest, &inputs)?;
        let inputs = Inputs {
            images: Vec::new(),
            buffers: Vec::new(),
            ..inputs
        };
        let placing = placed.map(|placed| -> Result<Placing, TuneError> {
            let (_, manifest) = manifest_of(bench, kernel, &shaded(settings, "placed"))?;
            let moved = moved(&inputs, placed);
            let filter = bench.upload_onto(&manifest, &moved, &uploaded)?;
            let options = place_options(space, space.value(richest, Term::Samples));
            let settings = Settings {
                options,
                ..Settings::default()
            };
            let (compiled, manifest) = manifest_of(bench, &Kernel::builtin("sraa_place")?, &settings)?;
            let (pass, _) = bench.pass(&compiled, Stage::Compute)?;
            // Normals may be what no filter reads.
            let mut own = gbuffer::inputs(capture, &compiled.options)?;
            let is_there = |name: &str| uploaded.resources().iter().any(|(known, _)| *known == name);
            own.images.retain(|(name, _)| !is_there(name));
            own.buffers.retain(|(name, _)| !is_there(name));
            Ok(Placing {
                reads: bench.upload_onto(&manifest, &own, &uploaded)?,
                known: Static::of(&compiled),
                compiled,
                pass,
                uploaded: filter,
                cycles: None,
            })
        });
        Ok(Ground {
            placing: placing.transpose()?,
            uploaded,
            inputs,
            layers: capture.layer_count() as u64,
        })
    }

    /// Bytes that a variant reads a pixel, by its metric, and whether it is placed and borrows light apart.
    pub(super) fn bytes(&self, metric: &str, is_placed: bool, is_apart: bool) -> u64 {
        let geometry = match metric {
            _ if is_placed => DEPTH_BYTES + NORMAL_BYTES,
            "normals" => NORMAL_BYTES,
            "depth" => DEPTH_BYTES,
            _ => DEPTH_BYTES + NORMAL_BYTES,
        };
        let light = match is_apart {
            true => ALBEDO_BYTES * self.layers + LIGHT_BYTES,
            false => 0,
        };
        geometry * self.layers + light + if is_placed { PLACE_BYTES } else { 0 }
    }
}

fn manifest_of(bench: &Bench, kernel: &Kernel, settings: &Settings) -> Result<(Compiled, Manifest), TuneError> {
    let compiled = kernel.compile(settings)?;
    let emitted = compiled
        .emit(&bench.options(Stage::Compute))
        .map_err(ExecuteError::from)?;
    Ok((compiled, emitted.manifest))
}

/// The same where shading is searched, with one place of it.
fn shaded(mut settings: Settings, place: &str) -> Settings {
    for (name, value) in &mut settings.options {
        if name == "shading" && ["centre", "placed"].contains(&value.as_str()) {
            place.clone_into(value);
        }
    }
    settings
}

/// Options of `sraa_place`: the samples, what is fixed for all, and what tells surfaces apart as where the picture was placed, not as
/// the filter does.
fn place_options(space: &Space, samples: &crate::tune::Value) -> Vec<(String, String)> {
    let own = |name: &str| PLACED_BY.iter().any(|(known, _)| *known == name);
    let given = space.fixed.iter().chain(&samples.options);
    let mut options: Vec<(String, String)> = given.filter(|(name, _)| !own(name)).cloned().collect();
    options.extend(PLACED_BY.map(|(name, value)| (name.to_owned(), value.to_owned())));
    options
}

/// What a filter reads of what was placed.
fn moved(inputs: &Inputs, placed: &Placed) -> Inputs {
    let mut moved = inputs.clone().image("color", placed.color.clone());
    for (name, frame) in [("direct", &placed.direct), ("rest", &placed.rest)] {
        if let Some(frame) = frame {
            moved = moved.image(name, frame.clone());
        }
    }
    moved.integers("place", vec![gbuffer::places(&placed.place)])
}

/// What may be searched of a subject.
pub(super) fn offer(kernel: &Kernel, subject: &Subject, question: &Question) -> Offer {
    let first = subject.captures.first();
    let mut offer = Offer {
        samples: subject.captures.iter().map(sample_set).collect(),
        normals: first.is_some_and(|capture| capture.normal.is_some()),
        camera: first.is_some_and(|capture| capture.camera.is_some()),
        depth_scale: first.and_then(depth_scale),
        no_half: question.no_half.clone(),
        fixed: question.fixed.clone(),
        ..Offer::default()
    };
    let is_placed = ("shading".to_owned(), "placed".to_owned());
    offer.no_placing = match () {
        () if offer.fixes("shading") && !offer.fixed.contains(&is_placed) => Some("shading is set".to_owned()),
        () if subject.placed.len() < subject.captures.len() => {
            Some("only what a renderer draws can be shaded elsewhere".to_owned())
        }
        () if offer.fixes("unseen") => Some("`unseen` is set, and scenes are placed with its default".to_owned()),
        () => None,
    };
    let blind = subject.reference.is_none();
    let blind = blind.then(|| "without a reference it cannot be judged by what computes less".to_owned());
    let refused = |more: &[(&str, &str)]| {
        let mut options = offer.fixed.clone();
        options.retain(|(name, _)| more.iter().all(|(own, _)| own != name));
        options.extend(
            more.iter()
                .map(|(name, value)| ((*name).to_owned(), (*value).to_owned())),
        );
        let sampled = offer.samples.first().map_or(&[][..], |set| &set.options);
        let sampled = sampled.iter().filter(|(name, _)| !offer.fixes(name));
        options.extend(sampled.cloned());
        let settings = Settings {
            options,
            ..Settings::default()
        };
        let errors = kernel.compile(&settings).err()?;
        errors.diagnostics.into_iter().next().map(|first| first.message)
    };
    let no_search = blind.clone().or_else(|| refused(&[("search", "five")]));
    let has_rest = |capture: &Capture| capture.rest.is_some() || offer.fixes("rest");
    let has_light = first.is_some_and(|c| c.albedo.is_some() && c.direct.is_some() && has_rest(c));
    let no_light = match has_light {
        true => blind.or_else(|| refused(&[("demodulate", "albedo-shadow")])),
        false => Some("there is no albedo, direct light and rest (`capture --albedo` writes them)".to_owned()),
    };
    Offer {
        no_search,
        no_light,
        ..offer
    }
}

pub(super) fn sample_set(capture: &Capture) -> SampleSet {
    SampleSet {
        count: capture.samples.len(),
        options: gbuffer::sampled_at(capture),
    }
}

//! Inputs of variants, on the device: once for each set of geometry samples.

use crate::builtin::{Setting, parse_settings, spell_settings};
use crate::tune::features::Static;
use crate::tune::space::{Offer, Preset, SampleSet, Space, Variant};
use crate::tune::steps::depth_scale;
use crate::tune::{Question, Subject, Term, TuneError};
use straightline_bench::execute::{Bench, ExecuteError, Inputs, Uploaded};
use straightline_codegen::{Compiled, Kernel, Manifest, Settings, Stage};
use straightline_kernels::{OptionText, OptionValue};
use straightline_manifest::{Binding, BindingKind};
use straightline_runtime::Pass;
use straightline_scene::capture::Capture;
use straightline_scene::gbuffer;
use straightline_scene::render::{Placed, PlacedBy};

/// Bytes of a geometry sample: depth as `r32float`, a normal as `rgba16float`, as `straightline budget` counts; albedo as
/// `rgba8unorm`.
const DEPTH_BYTES: u64 = 4;
const NORMAL_BYTES: u64 = 8;
const ALBEDO_BYTES: u64 = 4;

/// Bytes of a pixel: direct light and what does not follow the albedo as `rgba16float`, where it is shaded as `r8uint`.
const LIGHT_BYTES: u64 = 2 * 8;
const PLACE_BYTES: u64 = 1;

/// Input that places the shading of pixels.
const PLACE: &str = "place";

/// Inputs of the variants of one set of samples, on the device.
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
    /// Inputs of that pass.
    pub reads: Uploaded,
    /// Inputs of the filter after it.
    pub uploaded: Uploaded,
    /// The pass's cycles, where a compiler was asked.
    pub cycles: Option<f64>,
}

impl Ground {
    /// The ground of a set of samples, by its place in the space.
    pub(super) fn new(
        bench: &Bench,
        (kernel, space): (&Kernel, &Space),
        samples: usize,
        (capture, placed): (&Capture, Option<&Placed>),
    ) -> Result<Ground, TuneError> {
        let reads = |place: &str| -> Result<Vec<(Compiled, Manifest)>, TuneError> {
            // A capture that is shaded elsewhere stays so.
            let settings = richest_variants(space, samples).into_iter().map(|v| match placed {
                Some(_) => shading_settings(space, v, place),
                None => space.variant_settings(v),
            });
            settings.map(|settings| manifest_of(bench, kernel, &settings)).collect()
        };
        let mut all = reads("centre")?;
        let mut inputs = Inputs::new(capture.size);
        if let Some((compiled, _)) = all.last() {
            inputs = gbuffer::sraa_inputs(capture, &compiled.options)?;
        }
        let place = placed.map(|_| {
            let options = place_options(
                space,
                space.variant_value(space.general().with_value(Term::Samples, samples), Term::Samples),
            );
            let settings = Settings::new().set_all(options);
            manifest_of(bench, &Kernel::builtin("sraa_place")?, &settings)
        });
        let place = place.transpose()?;
        if let Some((compiled, manifest)) = &place {
            // Normals and the camera's rays may be what no filter reads.
            let own = gbuffer::sraa_inputs(capture, &compiled.options)?;
            let is_known = |name: &str| inputs.images.iter().any(|(known, _)| known == name);
            let images: Vec<_> = own.images.into_iter().filter(|(name, _)| !is_known(name)).collect();
            inputs.images.extend(images);
            let is_known = |name: &str| inputs.uniforms.iter().any(|(known, _)| known == name);
            let uniforms: Vec<_> = own.uniforms.into_iter().filter(|(name, _)| !is_known(name)).collect();
            inputs.uniforms.extend(uniforms);
            all.push((compiled.clone(), manifest.clone()));
            all.extend(reads("placed")?);
        }
        let wide = merge_bindings(all.iter().map(|(_, manifest)| manifest));
        let here = Manifest {
            bindings: wide
                .iter()
                .filter(|binding| binding.name != PLACE || placed.is_none())
                .cloned()
                .collect(),
            ..all[0].1.clone()
        };
        let uploaded = bench.upload(&here, &inputs)?;
        let inputs = Inputs {
            images: Vec::new(),
            buffers: Vec::new(),
            ..inputs
        };
        let placing = place
            .zip(placed)
            .map(|((compiled, manifest), placed)| -> Result<Placing, TuneError> {
                let there = Manifest { bindings: wide, ..here };
                let (pass, _) = bench.compile_pass(&compiled, Stage::Compute)?;
                Ok(Placing {
                    reads: bench.share_inputs(&manifest, &inputs, &uploaded)?,
                    known: Static::from_compiled(&compiled),
                    compiled,
                    pass,
                    uploaded: bench.upload_onto(&there, &placed_inputs(&inputs, placed), &uploaded)?,
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
    pub(super) fn bytes_per_pixel(&self, metric: &str, is_placed: bool, is_apart: bool) -> u64 {
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

/// Variants that together read all that any of one set of samples does, and of each texture as many components: what a loop
/// chooses a sample by is read whole. The last reads every texture.
fn richest_variants(space: &Space, samples: usize) -> Vec<Variant> {
    let general = space.general().with_value(Term::Samples, samples);
    let most = |v: Variant, term: Term| v.with_value(term, space.term_values(term).len() - 1);
    let searched = most(general, Term::Search);
    let mut all = vec![general];
    all.extend(
        space
            .preset_variants()
            .into_iter()
            .filter(|v| v.value_index(Term::Samples) == samples),
    );
    all.extend([searched, most(searched, Term::Light)]);
    all.dedup();
    all
}

/// The bindings of several kernels, each with all components that one of them reads.
fn merge_bindings<'a>(manifests: impl Iterator<Item = &'a Manifest>) -> Vec<Binding> {
    let mut all: Vec<Binding> = Vec::new();
    for binding in manifests.flat_map(|manifest| &manifest.bindings) {
        match all.iter_mut().find(|known| known.name == binding.name) {
            None => all.push(binding.clone()),
            Some(known) => {
                if let BindingKind::Texture { components, .. } = &mut known.kind
                    && let BindingKind::Texture { components: own, .. } = &binding.kind
                {
                    *components = (*components).max(*own);
                }
            }
        }
    }
    all
}

fn manifest_of(bench: &Bench, kernel: &Kernel, settings: &Settings) -> Result<(Compiled, Manifest), TuneError> {
    let compiled = kernel.compile(settings)?;
    let emitted = compiled
        .emit(&bench.emit_options(Stage::Compute))
        .map_err(ExecuteError::from)?;
    Ok((compiled, emitted.manifest))
}

/// Settings of a variant, with one place of shading where that is searched.
fn shading_settings(space: &Space, variant: Variant, place: &str) -> Settings {
    let mut options = space.variant_options(variant);
    for (name, value) in &mut options {
        if name == "shading" && matches!(value.choice(), Some("centre" | "placed")) {
            *value = OptionValue::Choice(place.to_owned());
        }
    }
    let mut settings = space.variant_settings(variant);
    settings.options = spell_settings(&options);
    settings
}

/// Options of `sraa_place`: the samples, what is fixed for all, and what tells surfaces apart as where the picture was
/// placed, not as the filter does.
fn place_options(space: &Space, samples: &crate::tune::Value) -> Vec<OptionText> {
    let given: Vec<_> = space.fixed.iter().chain(&samples.options).cloned().collect();
    PlacedBy::Planes.instead_of(&spell_settings(&given))
}

/// Returns the inputs of a filter of placed shading.
fn placed_inputs(inputs: &Inputs, placed: &Placed) -> Inputs {
    let mut moved = inputs.clone().with_image("color", placed.color.clone());
    for (name, frame) in [("direct", &placed.direct), ("rest", &placed.rest)] {
        if let Some(frame) = frame {
            moved = moved.with_image(name, frame.clone());
        }
    }
    moved.with_integers(PLACE, vec![gbuffer::encode_places(&placed.place)])
}

/// Returns the variants of a subject that may be searched.
///
/// # Errors
///
/// If an option that all variants are to have is wrong.
pub(super) fn build_offer(kernel: &Kernel, subject: &Subject, question: &Question) -> Result<Offer, TuneError> {
    let first = subject.captures.first();
    let samples = subject.captures.iter().map(|capture| sample_set(kernel, capture));
    if question.fixed.iter().any(|(name, _)| name == "preset") {
        let why = "the search starts from every preset: set single options, such as `search=five`";
        return Err(TuneError::Space(why.to_owned()));
    }
    let preset = |preset: &straightline_kernels::Preset| {
        let options = preset
            .options()
            .map(|(name, value)| (name.to_owned(), value.to_owned()));
        Ok::<_, TuneError>(Preset {
            name: preset.name.to_owned(),
            options: parse_settings(kernel, &options.collect::<Vec<_>>())?,
        })
    };
    let mut offer = Offer {
        presets: kernel.presets().iter().map(preset).collect::<Result<_, _>>()?,
        defaults: kernel.option_values(&[])?,
        samples: samples.collect::<Result<_, _>>()?,
        normals: first.is_some_and(|capture| capture.normal.is_some()),
        camera: first.is_some_and(|capture| capture.camera.is_some()),
        depth_scale: first.and_then(depth_scale),
        no_half: question.no_half.clone(),
        fixed: parse_settings(kernel, &question.fixed)?,
        ..Offer::default()
    };
    let is_placed = |(name, value): &Setting| name == "shading" && value.choice() == Some("placed");
    offer.no_placing = match () {
        () if offer.fixes("shading") && !offer.fixed.iter().any(is_placed) => Some("shading is set".to_owned()),
        () if subject.placed.len() < subject.captures.len() => {
            Some("only what a renderer draws can be shaded elsewhere".to_owned())
        }
        () if offer.fixes("unseen") => Some("`unseen` is set, and scenes are placed with its default".to_owned()),
        () => None,
    };
    let blind = subject.reference.is_none();
    let blind = blind.then(|| "without a reference it cannot be judged by what computes less".to_owned());
    let refused = |more: &[(&str, &str)]| {
        let mut options = spell_settings(&offer.fixed);
        options.retain(|(name, _)| more.iter().all(|(own, _)| own != name));
        options.extend(
            more.iter()
                .map(|(name, value)| ((*name).to_owned(), (*value).to_owned())),
        );
        let sampled = offer.samples.first().map_or(&[][..], |set| &set.options);
        let mut sampled = spell_settings(sampled);
        sampled.retain(|(name, _)| !offer.fixes(name));
        options.extend(sampled);
        let settings = Settings::new().set_all(options);
        compile_refusal(kernel, &settings)
    };
    let no_search = blind.clone().or_else(|| refused(&[("search", "five")]));
    let has_rest = |capture: &Capture| capture.rest.is_some() || offer.fixes("rest");
    let has_light = first.is_some_and(|c| c.albedo.is_some() && c.direct.is_some() && has_rest(c));
    let no_light = match has_light {
        true => blind.or_else(|| refused(&[("demodulate", "albedo-shadow")])),
        false => Some("there is no albedo, direct light and rest (`capture --albedo` writes them)".to_owned()),
    };
    Ok(Offer {
        no_search,
        no_light,
        ..offer
    })
}

/// Why there can be no blocks, if so: they take no branch, and what all variants have may bring one.
pub(super) fn no_blocks(kernel: &Kernel, space: &Space) -> Option<String> {
    let last = |term: Term| space.term_values(term).len() - 1;
    let cheapest = space
        .general()
        .with_value(Term::Samples, last(Term::Samples))
        .with_value(Term::Metric, last(Term::Metric));
    // Errors of single pixels, too, are reported elsewhere.
    match compile_refusal(kernel, &space.variant_settings(cheapest)) {
        None => compile_refusal(
            kernel,
            &space.variant_settings(cheapest.with_value(Term::Block, last(Term::Block))),
        ),
        Some(_) => None,
    }
}

/// Returns the kernel's objection to options.
fn compile_refusal(kernel: &Kernel, settings: &Settings) -> Option<String> {
    let errors = kernel.compile(settings).err()?;
    Some(errors.first_message().to_owned())
}

/// The geometry samples of a capture.
///
/// # Errors
///
/// If the kernel takes no such samples.
pub(super) fn sample_set(kernel: &Kernel, capture: &Capture) -> Result<SampleSet, TuneError> {
    Ok(SampleSet {
        count: capture.samples.len(),
        options: parse_settings(kernel, &gbuffer::sampled_at(capture))?,
    })
}

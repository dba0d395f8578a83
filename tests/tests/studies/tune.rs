//! `tune` on a real driver: what it chooses is within the budget by another's account, and reads only what it needs.

use crate::common;

use common::bench;
use glam::{UVec2, Vec4};
use std::sync::{Mutex, OnceLock};
use straightline_bench::execute::{Clock, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Kernel, Manifest, Settings, Stage};
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics;
use straightline_runtime::Pass;
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::render::{CpuRenderer, capture_scene, render_reference};
use straightline_scene::scene::Scene;
use straightline_study::progress::{Progress, Silent};
use straightline_study::record::{Candidate, Circumstances, IntervalKind, TuneRecord};
use straightline_study::tune::{
    Beyond, ErrorMetric, Gauge, Outcome, PATTERNS, Question, Subject, TuneError, tune_subject,
};
use straightline_tests::impatient::StopsAfter;

const SIZE: UVec2 = UVec2::new(128, 72);

fn circumstances() -> Circumstances {
    Circumstances {
        command: "a test".to_owned(),
        date: String::new(),
        adapter: "any".to_owned(),
        processor: String::new(),
        clock: Clock::WallClock,
        size: SIZE.to_array(),
        rounds: 3,
        intervals: IntervalKind::Blocks,
        complete: true,
    }
}

/// A part of the space, so that the test is short: one falloff, one way to compare depths, whole floats, nothing beyond the
/// paper.
fn question(metric: ErrorMetric, max_error: f64) -> Question {
    let fixed = [
        ("falloff", "tent"),
        ("difference", "absolute"),
        ("non-finite", "skip"),
        ("search", "none"),
    ];
    Question {
        metric,
        max_error,
        rounds: 3,
        no_half: Some("this is a short test".to_owned()),
        fixed: fixed.map(|(n, v)| (n.to_owned(), v.to_owned())).into(),
    }
}

fn renderer(scene: &str) -> CpuRenderer {
    CpuRenderer::new(&Scene::from_name(scene).expect("a scene"), SIZE).expect("it is drawn")
}

fn tuned(subject: Subject, question: &Question) -> Outcome {
    let found = tune_subject(&bench(), subject, question, Gauge::Device, circumstances(), &mut Silent);
    found.unwrap_or_else(|e| panic!("{e}")).expect("nobody stopped it")
}

fn subject(scene: &str) -> Subject {
    let subject = Subject::of_scene(scene, &renderer(scene), &PATTERNS, Beyond::NONE, &mut Silent);
    subject.unwrap_or_else(|e| panic!("{e}")).expect("nobody stopped it")
}

/// The shader's picture by the interpreter from a capture of its own, and the error of that: nothing of the search is used.
fn judged(scene: &str, manifest: &Manifest) -> f64 {
    type Known = Mutex<Vec<(String, Frame<Vec4>)>>;
    static REFERENCES: OnceLock<Known> = OnceLock::new();
    let renderer = renderer(scene);
    let samples = gbuffer::pattern_offsets(&manifest.options["pattern"]).expect("a pattern");
    let capture = capture_scene(&renderer, &samples, ShadingSample::Centre).expect("captured");
    let settings = Settings::new().set_all(
        manifest
            .options
            .clone()
            .into_iter()
            .filter(|(_, value)| !value.is_empty()),
    );
    let compiled = Kernel::builtin("sraa").and_then(|kernel| kernel.compile(&settings));
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let inputs = gbuffer::sraa_inputs(&capture, &compiled.options).expect("all is captured");
    let picture = interpret_kernel::<f32>(&compiled, &inputs, false)
        .expect("all is bound")
        .frame(&inputs);
    let mut known = REFERENCES
        .get_or_init(Default::default)
        .lock()
        .expect("no panic before");
    if !known.iter().any(|(name, _)| name == scene) {
        let perfect = render_reference(&renderer, 16, &mut |_, _| {}).expect("supersampled");
        known.push((scene.to_owned(), perfect));
    }
    let perfect = &known.iter().find(|(name, _)| name == scene).expect("just put there").1;
    metrics::psnr(&picture, perfect)
}

/// The chosen shader as files, read again as a host would.
fn emitted(outcome: &Outcome) -> (Manifest, String) {
    let chosen = outcome.chosen.as_ref().expect("something is chosen");
    let options = EmitOptions::new().precision(chosen.precision);
    let mut emitted = chosen.compiled.emit(&options).expect("it is emitted");
    emitted.manifest.tuned = Some(chosen.tuned.clone());
    let wgsl = String::from_utf8(emitted.files[&Target::Wgsl].clone()).expect("text");
    let manifest = Manifest::from_json(&emitted.manifest.to_json()).expect("its own manifest is read");
    (manifest, wgsl)
}

fn check(scene: &str, record: &TuneRecord, manifest: &Manifest, wgsl: &str) {
    let bench = bench();
    Pass::new(bench.device(), manifest, wgsl).unwrap_or_else(|e| panic!("{scene}: the shader is refused: {e}"));
    let chosen = &record.candidates[record.chosen.expect("something is chosen")];
    let error = judged(scene, manifest);
    assert!(
        error >= record.best - record.max_error - 0.02,
        "{scene}: {error} dB, the best has {}, and {} may be lost",
        record.best,
        record.max_error
    );
    assert!(
        (error - chosen.error).abs() < 0.02,
        "{scene}: {error}, it says {}",
        chosen.error
    );
    let tuned = manifest.tuned.as_ref().expect("the manifest says what was left out");
    assert_eq!(tuned.left_out.len(), record.left_out.len());
    assert_eq!((tuned.error, tuned.best), (chosen.error, record.best));
    let general = &record.candidates[record.general];
    let ratio = chosen.ratio.expect("it was timed").median;
    println!(
        "{scene}: {} with {error:.2} dB, speedup {ratio:.2} over {} with {:.2} dB",
        chosen.name, general.name, general.error
    );
}

fn reads(manifest: &Manifest, what: &str) -> bool {
    manifest.bindings.iter().any(|binding| binding.name.contains(what))
}

/// Returns whether a variant that reads no normals is within the budget: only a clock can say whether it is also the fastest.
fn does_without_normals(record: &TuneRecord) -> bool {
    record.candidates.iter().any(|candidate| {
        let metric = candidate.options.iter().find(|(name, _)| name == "metric");
        metric.is_some_and(|(_, value)| value == "depth")
            && candidate.non_finite == 0
            && candidate.error >= record.best - record.max_error
    })
}

/// The shader binds and reads what its metric needs, and nothing else.
fn reads_what_it_needs(manifest: &Manifest, wgsl: &str) {
    let metric = manifest.options["metric"].as_str();
    let normals = metric != "depth";
    assert_eq!(reads(manifest, "normal"), normals, "{metric}: {:?}", manifest.bindings);
    assert_eq!(wgsl.contains("textureLoad(normal"), normals, "{metric}: {wgsl}");
    let tuned = manifest.tuned.as_ref().expect("what was left out");
    assert_eq!(
        tuned.left_out.iter().any(|out| out.term == "normals"),
        !normals,
        "{tuned:?}"
    );
}

#[test]
fn terrain_needs_no_normals_and_creases_need_them() {
    let budget = question(ErrorMetric::Psnr, 1.0);
    let terrain = tuned(subject("terrain"), &budget);
    let (manifest, wgsl) = emitted(&terrain);
    check("terrain", &terrain.record, &manifest, &wgsl);
    reads_what_it_needs(&manifest, &wgsl);
    assert!(does_without_normals(&terrain.record));

    let creases = tuned(subject("creases"), &budget);
    let (manifest, wgsl) = emitted(&creases);
    check("creases", &creases.record, &manifest, &wgsl);
    reads_what_it_needs(&manifest, &wgsl);
    assert!(!does_without_normals(&creases.record));
    assert!(reads(&manifest, "normal"), "{:?}", manifest.bindings);
    // The cost of a term is the difference of the variants with and without it.
    let record = &creases.record;
    for out in &record.left_out {
        assert!(out.cost.abs() < 20.0 && out.cost <= record.max_error + 0.02, "{out:?}");
    }
    assert!(
        record.model.tested_on > 0 && record.model.terms.iter().all(|(_, ms)| *ms >= 0.0),
        "{:?}",
        record.model
    );
    assert_eq!(record.candidates[record.general].ratio.expect("timed").median, 1.0);
    assert!(record.terms.iter().any(|term| term.ratio.is_some()));
}

#[test]
fn what_was_measured_before_an_interruption_is_kept() {
    let subject = subject("floor");
    let budget = question(ErrorMetric::Psnr, 1.0);
    // Counts are a step for each variant: then come pictures.
    let variants = tuned_steps(&subject, &budget);
    let run = |steps: usize| {
        tune_subject(
            &bench(),
            subject.clone(),
            &budget,
            Gauge::Device,
            circumstances(),
            &mut StopsAfter(steps),
        )
    };
    assert!(
        run(1).unwrap_or_else(|e| panic!("{e}")).is_none(),
        "nothing was measured"
    );
    let outcome = run(variants + 3)
        .unwrap_or_else(|e| panic!("{e}"))
        .expect("some pictures were measured");
    assert!(outcome.chosen.is_none() && outcome.record.chosen.is_none() && !outcome.record.circumstances.complete);
    let seen = outcome.record.candidates.len();
    assert!(seen > 0 && seen < variants, "{seen} of {variants}");
    let text = serde_json::to_string(&outcome.record).expect("JSON");
    let again: TuneRecord = serde_json::from_str(&text).expect("it is read again");
    let names = |record: &TuneRecord| record.candidates.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&again), names(&outcome.record));
}

/// Steps of a search before its first picture.
fn tuned_steps(subject: &Subject, question: &Question) -> usize {
    struct Steps(Vec<(String, usize)>);
    impl Progress for Steps {
        fn begin(&mut self, what: &str, steps: usize) {
            self.0.push((what.to_owned(), steps));
        }
        fn step(&mut self) {}
        fn is_stopped(&self) -> bool {
            self.0.len() > 1
        }
    }
    let mut steps = Steps(Vec::new());
    let stopped = tune_subject(
        &bench(),
        subject.clone(),
        question,
        Gauge::Device,
        circumstances(),
        &mut steps,
    );
    assert!(stopped.unwrap_or_else(|e| panic!("{e}")).is_none());
    steps.0[0].1
}

#[test]
fn a_capture_without_normals_camera_and_reference_is_tuned_too() {
    let renderer = renderer("tubes");
    let samples = gbuffer::pattern_offsets("latin16").expect("a pattern");
    let whole = capture_scene(&renderer, &samples, ShadingSample::Centre).expect("captured");
    let bare = Capture {
        normal: None,
        camera: None,
        ..whole
    };
    let outcome = tuned(Subject::of_capture("frame", bare), &question(ErrorMetric::Flip, 0.01));
    let record = &outcome.record;
    assert!(record.reference.contains("most general"), "{}", record.reference);
    assert!(
        record.not_searched.iter().any(|line| line.contains("normals")),
        "{:?}",
        record.not_searched
    );
    assert_eq!(record.candidates[record.general].error, 0.0);
    let chosen = &record.candidates[record.chosen.expect("something is chosen")];
    assert!(chosen.error <= 0.01, "{}", chosen.error);
    let (manifest, wgsl) = emitted(&outcome);
    assert!(!reads(&manifest, "normal"));
    Pass::new(bench().device(), &manifest, &wgsl).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn a_budget_that_nothing_keeps_says_what_comes_closest() {
    let renderer = renderer("floor");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let mut broken = capture_scene(&renderer, &samples, ShadingSample::Centre).expect("captured");
    // An infinite colour that every variant of this part of the space spreads.
    let mut texels = broken.color.texels().to_vec();
    texels[40] = Vec4::INFINITY;
    broken.color = Frame::new(broken.color.size(), texels);
    let mut budget = question(ErrorMetric::Psnr, 1.0);
    budget.fixed.retain(|(name, _)| name != "non-finite");
    budget.fixed.push(("non-finite".to_owned(), "spread".to_owned()));
    let found = tune_subject(
        &bench(),
        Subject::of_capture("frame", broken),
        &budget,
        Gauge::Device,
        circumstances(),
        &mut Silent,
    );
    match found {
        Err(error @ TuneError::NothingWithin { .. }) => {
            let message = error.to_string();
            for text in ["1.00 dB", "not finite", "closest is 4 samples"] {
                assert!(message.contains(text), "no `{text}` in: {message}");
            }
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn half_precision_is_searched_where_the_device_has_it() {
    let has_half = bench().device().features().contains(wgpu::Features::SHADER_F16);
    let mut budget = question(ErrorMetric::Psnr, 1.0);
    budget.no_half = (!has_half).then(|| "the device has none".to_owned());
    budget.fixed.push(("pattern".to_owned(), "latin4".to_owned()));
    budget.fixed.push(("mask".to_owned(), "none".to_owned()));
    let renderer = renderer("creases");
    let subject = Subject::of_scene("creases", &renderer, &["latin4"], Beyond::NONE, &mut Silent);
    let outcome = tuned(
        subject.unwrap_or_else(|e| panic!("{e}")).expect("nobody stopped it"),
        &budget,
    );
    let halves: Vec<_> = outcome
        .record
        .candidates
        .iter()
        .filter(|c| c.precision == "f16")
        .collect();
    if !has_half {
        assert!(halves.is_empty());
        let said = &outcome.record.not_searched;
        assert!(said.iter().any(|line| line.contains("the device has none")), "{said:?}");
        return;
    }
    let slower = outcome
        .record
        .not_searched
        .iter()
        .any(|line| line.contains("times as long as f32"));
    match slower {
        true => assert_eq!(halves.len(), 1),
        // Of the variants beside presets not each has another precision.
        false => assert!(halves.len() * 3 > outcome.record.candidates.len()),
    }
    let term = outcome
        .record
        .terms
        .iter()
        .find(|term| term.instead == "f16")
        .expect("what f16 is worth");
    assert_eq!(slower, term.ratio.expect("it was timed").median < 1.0);
}

/// A part of the space in which a scene shows what it needs beyond the paper.
fn beyond() -> Question {
    let mut question = question(ErrorMetric::Psnr, 0.5);
    question.fixed = [
        ("falloff", "gaussian"),
        ("difference", "relative"),
        ("depth-scale", "3"),
        ("non-finite", "skip"),
        ("mask", "none"),
    ]
    .map(|(name, value)| (name.to_owned(), value.to_owned()))
    .into();
    question
}

#[test]
fn painted_scenes_need_light_apart_and_fine_ones_placing_and_a_search() {
    for (scene, needs, option) in [
        (
            "posters",
            "light apart from paint and shadow",
            ("demodulate", "albedo-shadow"),
        ),
        ("railings", "placing", ("shading", "placed")),
    ] {
        let renderer = renderer(scene);
        let subject = Subject::of_scene(scene, &renderer, &PATTERNS, Beyond::ALL, &mut Silent);
        let subject = subject.unwrap_or_else(|e| panic!("{e}")).expect("nobody stopped it");
        let captures = subject.captures.clone();
        let placed = subject.placed.clone();
        let outcome = tuned(subject, &beyond());
        let record = &outcome.record;
        let needed = |term: &str| record.needed.iter().find(|needed| needed.term == term);
        let gain = needed(needs).unwrap_or_else(|| panic!("{scene} needs {needs}: {:?}", record.needed));
        assert!(gain.cost > 0.0, "{scene}: {gain:?}");
        // No variant keeps the budget without it, whatever it takes.
        let keeps = |c: &&Candidate| c.non_finite == 0 && c.error >= record.best - record.max_error;
        let has = |c: &Candidate| c.options.contains(&(option.0.to_owned(), option.1.to_owned()));
        let without = record.candidates.iter().filter(keeps).find(|c| !has(c));
        assert!(without.is_none(), "{scene}: {without:?}");
        // The search starts from the presets: each is judged, timed and named.
        for preset in ["paper", "fast", "edges", "full"] {
            let named = |c: &&Candidate| c.preset.as_deref() == Some(preset) && c.name.starts_with(preset);
            let own: Vec<&Candidate> = record.candidates.iter().filter(named).collect();
            for name in [preset.to_owned(), format!("{preset} with 16 samples")] {
                let found = own.iter().find(|c| c.name == name);
                assert!(found.is_some_and(|c| c.ratio.is_some()), "{scene}: {name}");
            }
            println!("{scene}: {} variants of {preset}", own.len());
        }
        assert!(
            record
                .not_searched
                .iter()
                .any(|line| line == "preset guided: guide=add is not searched")
        );
        // Each term is reported exactly once, present or not.
        let terms = ["placing", "search", "light apart from paint and shadow"];
        for term in terms {
            let left_out = record.left_out.iter().filter(|out| out.term == term).count();
            assert_eq!(left_out + usize::from(needed(term).is_some()), 1, "{scene}: {term}");
        }
        let (manifest, _) = emitted(&outcome);
        let tuned = manifest.tuned.as_ref().expect("what was left out");
        assert_eq!(tuned.needed.len(), record.needed.len());
        assert_eq!(manifest.options[option.0], option.1);
        for term in &record.terms {
            assert!(term.cost.is_finite() && term.ratio.is_some(), "{scene}: {term:?}");
        }
        let chosen = outcome.chosen.as_ref().expect("something is chosen");
        assert_eq!(chosen.place.is_some(), manifest.options["shading"] == "placed");
        let Some(place) = &chosen.place else { continue };
        // The kernel that goes with it says where the picture was shaded.
        let is_own = |capture: &&Capture| gbuffer::sampled_at(capture)[0].1 == manifest.options["pattern"];
        let k = captures
            .iter()
            .position(|capture| is_own(&capture))
            .expect("its samples");
        let inputs = gbuffer::sraa_inputs(&captures[k], &place.options).expect("all is captured");
        let said = bench().run_targets(place, Stage::Compute, &inputs).expect("it runs");
        let own = said[0].texels.iter().map(|texel| texel[0] as u32);
        let off = own.zip(placed[k].place.texels()).filter(|(a, b)| a != *b).count();
        assert!(
            off * 1000 < said[0].texels.len(),
            "{scene}: {off} pixels are placed elsewhere"
        );
    }
}

//! The study of unroll against loop: its forms of every kernel by the interpreter, and the whole of it on a GPU.

use crate::common;

use common::{bench, same_bits};
use glam::uvec2;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use straightline_bench::execute::{Inputs, interpret_kernel, sampler_state, test_inputs};
use straightline_codegen::emit::Target;
use straightline_codegen::interp::{Bindings, Image, Interpreter, Texels};
use straightline_codegen::{Branches, Compiled, EmitOptions, Kernel, Settings, Unroll};
use straightline_runtime::{Error, Pass, PassOptions};
use straightline_study::loops::{LoopsError, Setup, Subject, list_subjects, study_loops};
use straightline_study::progress::Silent;
use straightline_study::record::{Circumstances, FormKind, IntervalKind, LoopsRecord, Record};
use straightline_tests::impatient::StopsAfter;

/// Every built-in kernel with its default options, and the ten of `kernels/filters`.
fn kernels() -> Vec<Kernel> {
    let builtin = straightline_kernels::CATALOGUE.iter().map(|entry| entry.name);
    let mut all: Vec<Kernel> = builtin.map(|name| Kernel::builtin(name).expect("built in")).collect();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kernels/filters");
    for entry in std::fs::read_dir(examples).expect("kernels/filters") {
        let path = entry.expect("an entry").path();
        all.push(Kernel::from_file(&path, None).unwrap_or_else(|e| panic!("{e}")));
    }
    assert!(all.len() >= 20);
    all
}

/// Kernels whose loops are all unrolled: some of `sraa_place`, `sraa_extra` and `sraa_fit` stay, and the number of their reads is not known.
fn kernels_with_a_floor() -> Vec<Kernel> {
    let (with, without): (Vec<Kernel>, Vec<Kernel>) = kernels()
        .into_iter()
        .partition(|kernel| compile(kernel, &Settings::default()).counts.loops == 0);
    let names: Vec<&str> = without.iter().map(Kernel::name).collect();
    assert_eq!(
        names,
        ["sraa_place", "sraa_extra", "sraa_fit_sums", "sraa_fit_rows", "sraa_fit"]
    );
    for kernel in &without {
        let refused = compile(kernel, &Settings::default()).floor();
        assert!(refused.is_err_and(|errors| errors.to_string().contains("has no floor")));
    }
    with
}

fn compile(kernel: &Kernel, settings: &Settings) -> Compiled {
    kernel
        .compile(settings)
        .unwrap_or_else(|e| panic!("{}: {e}", kernel.name()))
}

#[test]
fn the_floor_has_the_reads_of_the_full_form() {
    for kernel in kernels_with_a_floor() {
        let full = compile(&kernel, &Settings::default());
        let floor = full.floor().unwrap_or_else(|e| panic!("{}: {e}", kernel.name()));
        for (full, floor) in [(&full, &floor), (&*full.in_blocks(), &*floor.in_blocks())] {
            assert_eq!(full.counts.reads, floor.counts.reads, "{}", kernel.name());
            assert!(full.counts.reads.values().sum::<u32>() > 0, "{}", kernel.name());
            assert_eq!(floor.counts.transcendentals, 0, "{}", kernel.name());
            assert_eq!(floor.graph.outputs().len(), full.graph.outputs().len());
        }
        let text = floor.emit(&EmitOptions::new());
        text.unwrap_or_else(|e| panic!("{}: {e}", kernel.name()));
    }
}

/// An image of which one of the texels that are read, by number, is another than it is.
struct Tampered<'a> {
    image: Image,
    reads: &'a AtomicUsize,
    tampered: usize,
}

impl Texels for Tampered<'_> {
    fn extent(&self, level: u32) -> [u32; 3] {
        self.image.extent(level)
    }

    fn texel(&self, x: u32, y: u32, layer: u32, level: u32) -> [u32; 4] {
        let own = self.image.texel(x, y, layer, level);
        match self.reads.fetch_add(1, Ordering::Relaxed) == self.tampered {
            // Beyond all depths that it is compared with, to either side.
            true => own.map(|v| if f32::from_bits(v) > 0.5 { -64.0_f32 } else { 64.0 }.to_bits()),
            false => own,
        }
    }
}

/// The colours of the pixels that one invocation in the middle computes, and how many texels it read; of those the number
/// `tampered` is another than it is.
fn tampered(compiled: &Compiled, inputs: &Inputs, tampered: usize) -> (Vec<[f32; 4]>, usize) {
    let reads = AtomicUsize::new(0);
    let images: Vec<(&str, Tampered<'_>)> = inputs
        .images
        .iter()
        .map(|(name, layers)| {
            let size = layers[0].size().to_array();
            let texels = layers.iter().map(|l| l.texels().iter().map(|t| t.to_array()).collect());
            let image = Image::new(size, texels.collect()).expect("layers of one size");
            let reads = &reads;
            let image = Tampered { image, reads, tampered };
            (name.as_str(), image)
        })
        .collect();
    let mut bindings = Bindings::new();
    for (name, image) in &images {
        bindings = bindings.texture(name, image);
    }
    for (name, state) in &inputs.samplers {
        bindings = bindings.sampler(name, sampler_state(*state));
    }
    for (name, elements) in &inputs.buffers {
        bindings = bindings.buffer(name, elements);
    }
    for (name, lanes) in &inputs.uniforms {
        bindings = bindings.uniform(name, lanes);
    }
    let frame = inputs.size.to_array();
    let interpreter = Interpreter::new(&compiled.graph, &compiled.schedule, frame, &bindings).expect("all is bound");
    let mut scratch = interpreter.new_scratch();
    let colours = interpreter
        .run_invocation(frame[0] / 2, frame[1] / 2, &mut scratch)
        .to_vec();
    (colours, reads.load(Ordering::Relaxed))
}

/// Every texel of every read changes the result: no driver can drop a read. Of texels that a filter interpolates, one of weight 0 may have
/// no effect, so that as many reads must count as there are.
#[test]
fn no_read_of_the_floor_can_be_dropped() {
    for kernel in kernels_with_a_floor() {
        let full = compile(&kernel, &Settings::default());
        let inputs = test_inputs(&full.in_blocks().graph, uvec2(32, 18));
        let floor = full.floor().unwrap_or_else(|e| panic!("{}: {e}", kernel.name()));
        let floor = floor.in_blocks();
        let (own, texels) = tampered(&floor, &inputs, usize::MAX);
        let changed = (0..texels).filter(|k| tampered(&floor, &inputs, *k).0 != own).count();
        let textures = floor.graph.textures.iter().map(|t| t.name.as_str());
        let of_textures: u32 = textures.filter_map(|name| floor.counts.reads.get(name)).sum();
        assert!(
            changed >= of_textures as usize && texels >= changed,
            "{}: of {texels} texels of {of_textures} reads, {changed} count",
            kernel.name()
        );
        let filters = floor.graph.samplers.iter().any(|_| true);
        assert!(filters || changed == texels, "{}: {changed} of {texels}", kernel.name());
    }
}

#[test]
fn reads_that_are_not_shared_change_no_bit() {
    let mut more = 0;
    for kernel in kernels() {
        let forms = [true, false].map(|share_loads| compile(&kernel, &Settings::new().repeat_loads(!share_loads)));
        let inputs = test_inputs(&forms[0].in_blocks().graph, uvec2(32, 18));
        let found = forms.each_ref().map(|form| {
            interpret_kernel::<f32>(form, &inputs, false).unwrap_or_else(|e| panic!("{}: {e}", kernel.name()))
        });
        same_bits(&found[0].texels, &found[1].texels).unwrap_or_else(|e| panic!("{}: {e}", kernel.name()));
        let [shared, unshared] = forms.each_ref().map(|form| form.counts.reads.values().sum::<u32>());
        assert!(unshared >= shared, "{}", kernel.name());
        more += u32::from(unshared > shared);
    }
    assert!(more >= 5, "only {more} kernels read something twice");
}

/// Hand-optimised kernels agree with the generated ones: bit for bit where the order of operations was kept.
#[test]
fn kernels_by_hand_agree() {
    let mut checked = 0;
    for subject in list_subjects(false).unwrap_or_else(|e| panic!("{e}")) {
        let Ok(by_hand) = &subject.by_hand else { continue };
        let settings = |unroll, options: &[(String, String)]| Settings::new().unroll(unroll).set_all(options.to_vec());
        let full = compile(&subject.kernel, &settings(Unroll::Full, &subject.options));
        let hand = compile(&by_hand.kernel, &settings(Unroll::None, &by_hand.options));
        assert!(hand.counts.loops > 0, "{}: no loop is left", subject.name);
        let bindings = |compiled: &Compiled| -> BTreeSet<String> {
            compiled.graph.textures.iter().map(|t| t.name.clone()).collect()
        };
        assert!(bindings(&hand).is_subset(&bindings(&full)), "{}", subject.name);
        let inputs = test_inputs(&full.graph, uvec2(96, 64));
        let [expected, found] = [&full, &hand].map(|form| {
            interpret_kernel::<f32>(form, &inputs, false)
                .unwrap_or_else(|e| panic!("{e}"))
                .texels
        });
        // Share of pixels that may be off by more than a few roundings.
        let unsure = match subject.name.as_str() {
            "bilateral" => Some(0.0),
            // By hand the falloff is multiplied with: its logarithm, a constant once unrolled, would cost a loop one a tap.
            name if name.starts_with("SRAA") => Some(0.0),
            // Of two quarters that vary alike, a rounding chooses.
            "kuwahara" => Some(0.01),
            _ => None,
        };
        match unsure {
            None => same_bits(&expected, &found).unwrap_or_else(|e| panic!("{}: {e}", subject.name)),
            Some(unsure) => {
                let off = |(a, b): &(&[f32; 4], &[f32; 4])| (0..4).any(|k| (a[k] - b[k]).abs() > 2.0e-6);
                let off = expected.iter().zip(&found).filter(off).count();
                let most = (unsure * expected.len() as f64) as usize;
                assert!(off <= most, "{}: {off} pixels are off", subject.name);
            }
        }
        checked += 1;
    }
    assert_eq!(checked, 9);
}

/// Kept branches and loops of all kernels, too: their loops are shown to end, so that wgpu's bound can go; SPIR-V is smaller.
#[test]
fn every_kept_loop_is_shown_to_end() {
    let gpu = bench();
    let options = |unbounded| {
        EmitOptions::new()
            .targets([Target::Wgsl, Target::Spirv])
            .unbounded_loops(unbounded)
    };
    let mut with_loops = 0;
    for kernel in kernels() {
        for unroll in [Unroll::None, Unroll::Partial(3)] {
            let settings = Settings::new().unroll(unroll).branches(Branches::AsLoops);
            let compiled = compile(&kernel, &settings);
            let compiled = compiled.in_blocks();
            if compiled.counts.loops == 0 {
                continue;
            }
            with_loops += 1;
            let [bounded, unbounded] = [false, true].map(|unbounded| {
                let emitted = compiled.emit(&options(unbounded));
                emitted.unwrap_or_else(|e| panic!("{}: {e}", kernel.name()))
            });
            // The bound is a matter of the SPIR-V, whose blocks the header counts.
            let [with, without] = [&bounded, &unbounded].map(|e| {
                let text = String::from_utf8_lossy(&e.files[&Target::Wgsl]).into_owned();
                let lines = text.lines().filter(|line| !line.contains("basic block"));
                lines.map(str::to_owned).collect::<Vec<_>>()
            });
            assert_eq!(with, without);
            let [longer, shorter] = [&bounded, &unbounded].map(|e| e.files[&Target::Spirv].len());
            assert!(shorter < longer, "{}: {shorter} and {longer} bytes", kernel.name());
            gpu.create_pass(&unbounded, &PassOptions::default().unbounded_loops(true))
                .unwrap_or_else(|e| panic!("{} {unroll}: {e}", kernel.name()));
        }
    }
    assert!(with_loops >= 10, "{with_loops}");
}

/// A text of the caller's whose loop may not end keeps wgpu's bound, or is refused.
#[test]
fn a_loop_that_may_not_end_keeps_its_bound() {
    let gpu = bench();
    let text = "pub fn k(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {\n    let mut sum = Vec4::ZERO;\n    for x in 0..taps {\n        sum += color.load(pixel + ivec2(x, 0));\n    }\n    sum\n}\n";
    let compiled = compile(&Kernel::from_text("k.rs", text, "k"), &Settings::default());
    let emitted = compiled.emit(&EmitOptions::new()).expect("a shader");
    let wgsl = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]).into_owned();
    let unbounded = PassOptions::default().unbounded_loops(true);
    Pass::with_options(gpu.device(), &emitted.manifest, &wgsl, &unbounded).expect("its loop ends");
    let endless = wgsl.replace("x++", "x += 0");
    assert_ne!(endless, wgsl);
    let mut manifest = emitted.manifest.clone();
    manifest.hashes.clear();
    let refused = Pass::with_options(gpu.device(), &manifest, &endless, &unbounded);
    let why = refused.expect_err("it does not end");
    assert!(matches!(why, Error::UnboundedLoop { .. }), "{why}");
    assert!(why.to_string().contains("`k`") && why.to_string().contains("does not count up by one"));
    Pass::new(gpu.device(), &manifest, &endless).expect("wgpu bounds it");
}

const SETUP: Setup = Setup {
    size: uvec2(64, 36),
    rounds: 2,
    least: Duration::ZERO,
    pipelines: 1,
};

/// Kernels of every kind, small.
#[test]
fn every_form_is_there_or_says_why_not() {
    let mut subjects = list_subjects(false).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(subjects.len(), 15);
    subjects
        .retain(|subject| ["SRAA 4", "stalker", "fxaa", "kuwahara", "convolution"].contains(&subject.name.as_str()));
    assert_eq!(subjects.len(), 5);
    let studied = study_loops(&bench(), &subjects, &SETUP, &mut Silent).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(studied.len(), subjects.len());
    for studied in &studied {
        let kernel = &studied.forms;
        let kinds: BTreeSet<FormKind> = kernel.forms.iter().map(|form| form.kind).collect();
        let absent: BTreeSet<FormKind> = kernel.absent.iter().map(|(kind, _)| *kind).collect();
        assert!(kinds.is_disjoint(&absent));
        assert_eq!(
            kinds.len() + absent.len(),
            FormKind::ALL.len(),
            "{}: {kinds:?} {absent:?}",
            kernel.kernel
        );
        assert!(kernel.absent.iter().all(|(_, why)| !why.is_empty()));
        assert_eq!(kernel.forms[0].kind, FormKind::Looped);
        assert_eq!(kernel.forms[0].ratio.median, 1.0);
        for always in [FormKind::Full, FormKind::FullBlock, FormKind::Floor] {
            assert!(kinds.contains(&always), "{}: {:?}", kernel.kernel, kernel.absent);
        }
        for form in &kernel.forms {
            let what = format!("{} {:?}", kernel.kernel, form.kind);
            assert!(
                form.spirv_bytes > 100 && form.statements > 0 && form.reads > 0,
                "{what}"
            );
            assert!(
                form.time.median_ms > 0.0 && form.time.rounds == 2 && form.pipeline_ms > 0.0,
                "{what}"
            );
            assert!(
                form.ratio.low <= form.ratio.median && form.ratio.median <= form.ratio.high,
                "{what}"
            );
            // FXAA filters texels, which a GPU weighs in steps of 1/256.
            let bound = match (form.kind, kernel.kernel.as_str()) {
                // Measures the error; `hard` says where it is too large.
                (FormKind::FullHalf, _) => 1.0,
                (_, "fxaa") => 2.0e-2,
                _ => 1.0e-4,
            };
            assert_eq!(form.difference.is_none(), form.kind == FormKind::Floor, "{what}");
            assert!(
                form.difference_999.unwrap_or(0.0) <= bound,
                "{what}: {:?}",
                form.difference_999
            );
            assert!(form.difference_999 <= form.difference, "{what}");
        }
        let (full, floor) = (kernel.form(FormKind::Full), kernel.form(FormKind::Floor));
        if let Some(half) = kernel.form(FormKind::FullHalf) {
            println!("{}: f16 is off by {:?}", kernel.kernel, half.difference_999);
            assert!(half.difference > full.and_then(|f| f.difference), "{}", kernel.kernel);
        }
        assert_eq!(full.map(|f| f.reads), floor.map(|f| f.reads), "{}", kernel.kernel);
        assert_eq!(full.map(|f| f.loops), Some(0), "{}", kernel.kernel);
    }
    let record = LoopsRecord {
        circumstances: Circumstances {
            command: "test".to_owned(),
            date: "2000-01-01T00:00:00Z".to_owned(),
            adapter: "any".to_owned(),
            processor: "any".to_owned(),
            clock: straightline_bench::execute::Clock::WallClock,
            size: SETUP.size.to_array(),
            rounds: SETUP.rounds,
            intervals: IntervalKind::Blocks,
            complete: true,
        },
        kernels: studied.iter().map(|studied| studied.forms.clone()).collect(),
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("loops");
    record.write(&folder).unwrap_or_else(|e| panic!("{e}"));
    let again = LoopsRecord::read(&folder.join("loops.json")).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again, record);
    let rows: usize = record.kernels.iter().map(|kernel| kernel.forms.len()).sum();
    let csv = std::fs::read_to_string(folder.join("loops.csv")).expect("loops.csv");
    assert_eq!(csv.lines().count(), rows + 1);
}

#[test]
fn what_was_measured_is_kept() {
    let kernel = || {
        Kernel::from_text(
            "k.rs",
            "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let mut sum = Vec4::ZERO;\n    for x in -2..=2 {\n        sum += color.load(pixel + ivec2(x, 0)) + color.load(pixel);\n    }\n    sum / 10.0\n}\n",
            "k",
        )
    };
    let subjects = [
        Subject::from_kernel(kernel(), None),
        Subject::from_kernel(kernel(), None),
    ];
    let setup = Setup { rounds: 5, ..SETUP };
    let gpu = bench();
    let study = |steps| {
        let mut stops = StopsAfter(steps);
        study_loops(&gpu, &subjects, &setup, &mut stops).unwrap_or_else(|e| panic!("{e}"))
    };
    // The picture in f64 is a step, and so are forms and rounds.
    let all = study(usize::MAX);
    assert_eq!(all.len(), 2);
    let forms = all[0].forms.forms.len();
    assert_eq!(study(forms).len(), 0, "stopped before the last form");
    assert_eq!(
        study(1 + forms)[0].forms.forms[0].time.rounds,
        1,
        "a round is carried through"
    );
    let stopped = study(1 + forms + 2);
    assert_eq!(stopped.len(), 1);
    assert!(stopped[0].forms.forms.iter().all(|form| form.time.rounds == 2));
    assert_eq!(study(1 + forms + 5 + 3).len(), 1, "the second is not there in part");
}

#[test]
fn what_is_refused_is_named() {
    let refused = |subject: Subject| study_loops(&bench(), &[subject], &SETUP, &mut Silent).expect_err("a refusal");
    let broken = Kernel::from_text("k.rs", "pub fn k(pixel: IVec2) -> Vec4 { 1.0 }", "k");
    let error = refused(Subject::from_kernel(broken.clone(), None));
    assert!(matches!(error, LoopsError::Kernel { .. }), "{error}");
    let kernel = Kernel::from_text(
        "k.rs",
        "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) }",
        "k",
    );
    let error = refused(Subject::from_kernel(kernel.clone(), Some(broken)));
    assert!(matches!(error, LoopsError::Kernel { .. }), "{error}");
    // By hand it reads what the kernel does not.
    let other = Kernel::from_text(
        "other.rs",
        "pub fn other(colour: &Frame<Vec4>, pixel: IVec2) -> Vec4 { colour.load(pixel) }",
        "other",
    );
    let error = refused(Subject::from_kernel(kernel, Some(other))).to_string();
    assert!(
        error.contains("`k`, looped-by-hand") && error.contains("`colour`"),
        "{error}"
    );
}

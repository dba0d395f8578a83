//! Random kernels, computed in every way there is, and texts that are nearly kernels. `agree` does the same for as
//! long as one likes.

use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use straightline_codegen::{EmitOptions, Kernel};
use straightline_tests::random::forms::FORMS;
use straightline_tests::random::make::{Features, make};
use straightline_tests::random::oracle::coverage::{Missing, missing};
use straightline_tests::random::oracle::same::{CHANGES, apply, same_bits};
use straightline_tests::random::oracle::{self, Compared, Driver, Rustc, Tally, Text, Ways, World, computed};
use straightline_tests::random::{Random, Texts, survives};

/// First seed; each test takes those that follow.
const SEED: u64 = 10_440;

/// Kernels that rustc compiles at once.
const BATCH: u64 = 150;

/// Every form computes the values of rustc's program.
#[test]
fn every_form_agrees_with_rustc() {
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    let outcomes: Vec<_> = (0..4u64)
        .into_par_iter()
        .map(|k| {
            let first = SEED + k * BATCH;
            oracle::batch(&rustc, first..first + BATCH, Features::all()).unwrap_or_else(|why| panic!("{why}"))
        })
        .collect();
    let mut total = Tally::default();
    for (tally, failures) in outcomes {
        total.add(&tally);
        if let Some(failure) = failures.first() {
            panic!("{}\nworld {}: {}", failure.text, failure.world, failure.difference);
        }
    }
    let unusable: u64 = total.unusable.values().map(|r| r.kernels).sum();
    assert!(unusable * 20 < total.compared, "most texts are Rust: {total:?}");
    assert!(
        total.refusals() * 5 < total.compared,
        "most kernels are taken: {total:?}"
    );
    assert!(total.empty * 10 < total.pixels, "most pixels are numbers: {total:?}");
    assert!(
        total.overridden > total.pixels / 100,
        "options are overridden: {total:?}"
    );
    // Work is an oracle beside bits.
    if let Some(outlier) = total.works.outliers().first() {
        panic!("{}\n{outlier}", make(outlier.seed, Features::all()));
    }
}

#[test]
fn what_rustc_refuses_is_refused() {
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    let (verdicts, lenient) =
        oracle::judge_changed(&rustc, SEED..SEED + 300, Features::all()).unwrap_or_else(|why| panic!("{why}"));
    for case in &lenient {
        println!("{}: {}", case.line, case.error);
    }
    if let Some(case) = lenient.first() {
        panic!("{}\nchanged line: {}\nrustc: {}", case.text, case.line, case.error);
    }
    assert!(verdicts.refused > 50, "many changes are mistakes: {verdicts:?}");
}

/// A construct that the front end has or the page names is generated: else nothing would show that it is right.
#[test]
fn random_kernels_have_every_construct() {
    let missing = missing(0..3000).unwrap_or_else(|why| panic!("{why}"));
    assert_eq!(missing, Missing::default());
}

/// Each line in which `tests/mutants/run` puts a defect stands once in its file.
#[test]
fn lines_of_mutants_stand_once() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let list = std::fs::read_to_string(root.join("tests/mutants/list.txt")).expect("the list");
    for block in list.split("\n\n") {
        let lines: Vec<&str> = block.lines().filter(|line| !line.starts_with('#')).collect();
        let [file, old, _] = lines[..] else { continue };
        let text = std::fs::read_to_string(root.join(file)).unwrap_or_default();
        let old = old.trim_start_matches("- ");
        let count = text.lines().filter(|line| line.trim() == old).count();
        assert_eq!(count, 1, "{file}: {old}");
    }
}

/// Changes that leave a kernel's meaning leave its bits.
#[test]
fn changes_without_meaning_change_no_bit() {
    let counts: Vec<Mutex<u32>> = CHANGES.iter().map(|_| Mutex::new(0)).collect();
    (SEED..SEED + 200).into_par_iter().for_each(|seed| {
        let text = make(seed, Features::all());
        let world = World::new(seed);
        for (change, count) in CHANGES.iter().zip(&counts) {
            let Some(other) = apply(*change, &text.source, &mut Random(seed)) else {
                continue;
            };
            match same_bits(&text, &other, &world) {
                Ok(compared) => *count.lock().expect("no thread panics with it") += u32::from(compared),
                Err(why) => panic!("{text}\n{change:?}\n{other}\n{why}"),
            }
        }
    });
    for (change, count) in CHANGES.iter().zip(&counts) {
        let count = *count.lock().expect("no thread panicked");
        assert!(count > 3, "{change:?} changes {count} kernels");
    }
}

/// Shaders compute the values of rustc's program, for operations in which all drivers agree.
#[test]
fn shaders_agree_with_rustc() {
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    let driver = Driver::new().unwrap_or_else(|why| panic!("{why}"));
    let texts: Vec<Text> = (SEED..SEED + 40)
        .map(|seed| make(seed, Features::exact_on_drivers()))
        .collect();
    let world = World::for_drivers(SEED);
    let natives = oracle::run(&rustc, &texts, &world).unwrap_or_else(|why| panic!("{why}"));
    let shaders = driver.shaders(&texts, Ways::Forms);
    let shaders = shaders.unwrap_or_else(|why| panic!("{why}"));
    let mut total = Compared::default();
    for ((text, shaders), native) in texts.iter().zip(shaders).zip(natives) {
        if let Ok(native) = native
            && let Err(off) = driver.compare(&shaders, &world, &native, &mut total)
        {
            panic!("{text}\nworld {SEED}: {off}");
        }
    }
    assert!(total.kernels > 30, "most kernels are compared: {total:?}");
    assert!(total.unsure * 5 < total.pixels, "most pixels are compared: {total:?}");
    assert!(total.rounded * 5 < total.pixels, "most pixels are exact: {total:?}");
}

#[test]
fn no_text_makes_the_front_end_panic() {
    let texts = Texts::of_repository();
    (SEED..SEED + 2000).into_par_iter().for_each(|seed| {
        let (text, function) = texts.text(seed);
        if let Err(why) = survives(&text, function) {
            panic!("{text}\ntext {seed}: {why}");
        }
    });
}

/// Kernels that once disagreed: every form computes what rustc makes of them, gives what a line `// expect x y: r g b a`
/// says, and can be emitted.
#[test]
fn the_corpus_agrees() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let entries = std::fs::read_dir(&folder).expect("the corpus");
    let paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "rs"))
        .collect();
    let texts: Vec<Text> = (0..)
        .zip(&paths)
        .map(|(seed, path)| Text {
            seed,
            source: std::fs::read_to_string(path).expect("a text"),
        })
        .collect();
    for (path, text) in paths.iter().zip(&texts) {
        if let Err(why) = kept_promise(text) {
            panic!("{}: {why}", path.display());
        }
    }
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    for world in 0..4 {
        let (tally, failures) = oracle::check(&rustc, &texts, world).unwrap_or_else(|why| panic!("{why}"));
        if let Some(failure) = failures.first() {
            let path = paths[failure.text.seed as usize].display();
            panic!("{path}: world {world}: {}", failure.difference);
        }
        assert_eq!(tally.compared, texts.len() as u64, "all are compared: {tally:?}");
    }
}

fn kept_promise(text: &Text) -> Result<(), String> {
    let kernel = Kernel::from_text("corpus.rs", &text.file(), "k");
    let pixels: Vec<[u32; 2]> = World::pixels().collect();
    for form in FORMS {
        let compiled = kernel
            .compile(&form.settings())
            .map_err(|errors| format!("{form}: {errors}"))?;
        let found = computed::<f32>(&compiled, &World::new(0))?;
        for line in text.source.lines() {
            let Some(promise) = line.strip_prefix("// expect ") else {
                continue;
            };
            let number = |word: &str| word.parse().ok().map(f32::into);
            let numbers: Vec<f64> = promise.split([' ', ':']).filter_map(number).collect();
            let at = pixels
                .iter()
                .position(|[x, y]| numbers.starts_with(&[f64::from(*x), f64::from(*y)]));
            let (Some(at), [_, _, color @ ..]) = (at, numbers.as_slice()) else {
                return Err(format!("not a pixel and a colour: {promise}"));
            };
            let found = found.pixels[at].as_ref().map_or([f64::NAN; 4], |targets| targets[0]);
            if found.as_slice() != color {
                return Err(format!("{form} gives {found:?}, not {promise}"));
            }
        }
        compiled.emit(&EmitOptions::new()).map_err(|e| format!("{form}: {e}"))?;
    }
    Ok(())
}

/// Texts that once took all memory, or for ever: refused, or compiled, at once.
#[test]
fn heavy_texts_are_answered() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus/heavy");
    for entry in std::fs::read_dir(&folder).expect("the corpus") {
        let path = entry.expect("an entry").path();
        let text = std::fs::read_to_string(&path).expect("a text");
        survives(&text, "k").unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    }
}

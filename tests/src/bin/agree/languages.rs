//! Kernels in every language, read by the compilers of the languages.

use super::options::Options;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Mutex;
use std::time::Instant;
use straightline_codegen::diagnostic::{Code, Errors};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Compiled, EmitOptions, Form, Kernel, Stage};
use straightline_tests::compilers;
use straightline_tests::random::forms::FORMS;
use straightline_tests::random::make::make;

/// Kernels whose texts lie in a folder at once.
const BATCH: u64 = 64;

/// Outcomes of the kernels.
#[derive(Default)]
struct Counts {
    kernels: u64,
    refused: u64,
    texts: BTreeMap<Target, u64>,
    failures: u64,
}

/// Emits kernels in every language, each in one of the forms, and compiles every text.
pub fn languages(options: &Options) -> Result<(), String> {
    if options.languages == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let end = options.seed + options.languages;
    let starts: Vec<u64> = (options.seed..end).step_by(BATCH as usize).collect();
    let total = Mutex::new(Counts::default());
    starts.par_iter().try_for_each(|start| {
        let folder = std::env::temp_dir().join(format!("straightline-languages-{}-{start}", std::process::id()));
        let outcome = batch(options, *start..(start + BATCH).min(end), &folder, &total);
        // A folder that cannot be removed stays among the temporary files.
        let _ = std::fs::remove_dir_all(&folder);
        outcome
    })?;
    let total = total.into_inner().expect("no thread panicked");
    let texts: Vec<String> = total.texts.iter().map(|(target, n)| format!("{n} {target}")).collect();
    println!(
        "{} kernels in every language in {:.1} s, all texts accepted but {}: {}; {} kernels refused",
        total.kernels,
        begin.elapsed().as_secs_f64(),
        total.failures,
        texts.join(", "),
        total.refused
    );
    match total.failures {
        0 => Ok(()),
        n => Err(format!("{n} texts are refused")),
    }
}

fn batch(options: &Options, seeds: std::ops::Range<u64>, folder: &Path, total: &Mutex<Counts>) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut counts = Counts::default();
    let mut opengl: Vec<PathBuf> = Vec::new();
    let (mut glsl, mut hlsl) = (Vec::new(), Vec::new());
    for seed in seeds {
        let text = make(seed, options.features);
        let form = FORMS[(seed % FORMS.len() as u64) as usize];
        let Ok(compiled) = Kernel::from_text("random.rs", &text.file(), "k").compile(&form.settings()) else {
            counts.refused += 1;
            continue;
        };
        counts.kernels += 1;
        for (target, emitted) in texts(&compiled, &mut |target, error| {
            println!("seed {seed}: {target} with {form}: {error}");
            counts.failures += 1;
        }) {
            let stage = emitted.manifest.stage;
            *counts.texts.entry(target).or_default() += 1;
            let path = folder.join(format!("{seed}.{}", target.extension(stage, Form::Entry)));
            std::fs::write(&path, &emitted.files[&target]).map_err(|e| format!("{}: {e}", path.display()))?;
            let read = match target {
                Target::Wgsl => compilers::tint(&path),
                Target::Spirv => compilers::spirv(&path),
                Target::Glsl450 => {
                    glsl.push((path, "main".to_owned()));
                    Ok(())
                }
                Target::Hlsl => {
                    hlsl.push((path, emitted.manifest.entry_point.clone()));
                    Ok(())
                }
                Target::Msl => Ok(()),
                _ => {
                    opengl.push(path);
                    Ok(())
                }
            };
            if let Err(why) = read {
                println!("seed {seed}: {target} with {form}: {}", first_lines(&why));
                counts.failures += 1;
            }
        }
    }
    // glslang reads many of these at once.
    glsl.append(&mut hlsl);
    if compilers::all(folder, &glsl).is_err() {
        for shader in &glsl {
            let (path, entry) = shader;
            // glslc also asks spirv-val of what glslang makes of HLSL, which makes no valid gather that compares.
            let read = compilers::all(folder, std::slice::from_ref(shader)).or_else(|_| compilers::vulkan(path, entry));
            if let Err(why) = read {
                println!("{}: {}", path.display(), first_lines(&why));
                counts.failures += 1;
            }
        }
    }
    if compilers::opengl_all(&opengl).is_err() {
        for path in &opengl {
            if let Err(why) = compilers::opengl(path) {
                println!(
                    "{}: {}",
                    path.file_name().unwrap_or_default().display(),
                    first_lines(&why)
                );
                counts.failures += 1;
            }
        }
    }
    let mut total = total.lock().expect("no thread panics with it");
    total.kernels += counts.kernels;
    total.refused += counts.refused;
    total.failures += counts.failures;
    for (target, n) in counts.texts {
        *total.texts.entry(target).or_default() += n;
    }
    eprintln!("{} kernels", total.kernels);
    Ok(())
}

/// Emits a kernel in every supported language; all languages of a stage in one call where possible.
fn texts(compiled: &Compiled, failed: &mut impl FnMut(Target, Errors)) -> Vec<(Target, Rc<Emitted>)> {
    let (fragment, compute): (Vec<Target>, Vec<Target>) = Target::ALL
        .into_iter()
        .partition(|target| matches!(target, Target::Glsl330 | Target::Essl300));
    let mut texts = Vec::new();
    for (stage, targets) in [(Stage::Compute, compute), (Stage::Fragment, fragment)] {
        let emit =
            |targets: &[Target]| compiled.emit(&EmitOptions::new().stage(stage).targets(targets.iter().copied()));
        if let Ok(emitted) = emit(&targets) {
            let emitted = Rc::new(emitted);
            texts.extend(targets.into_iter().map(|target| (target, Rc::clone(&emitted))));
            continue;
        }
        for target in targets {
            match emit(&[target]) {
                Ok(emitted) => texts.push((target, Rc::new(emitted))),
                Err(error) if has_no_such_text(&error) => {}
                Err(error) => failed(target, error),
            }
        }
    }
    texts
}

/// Returns whether the kernel is rejected because a language or a stage lacks such shaders, whatever it computes.
fn has_no_such_text(error: &Errors) -> bool {
    matches!(error.first_code(), Some(Code::NotInTarget | Code::StageUnfit))
}

/// Messages of a compiler, without the text that it compiled.
fn first_lines(text: &str) -> String {
    text.lines().take(6).collect::<Vec<_>>().join("\n  ")
}

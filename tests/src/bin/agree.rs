//! Looks for random kernels on which two ways to compute them disagree, and for texts that the front end does not
//! stand. Prints the first, made as small as it can be, and exits with 1.

use rayon::prelude::*;
use std::process::ExitCode;
use std::time::{Duration, Instant};
use straightline_tests::random::check::{Failure, check, picture};
use straightline_tests::random::generate::{Profile, generate};
use straightline_tests::random::gpu::{Compared, Gpu};
use straightline_tests::random::{Texts, print, shrink, survives};

const USAGE: &str = "\
usage: agree [--kernels N] [--seed S] [--gpu N] [--front-minutes M] [--keep-going] [--print]
  --kernels N        random kernels to compare on the CPU (1000)
  --seed S           number of the first (1)
  --gpu N            random kernels to run on the GPU too (0)
  --front-minutes M  time for mutated texts (0)
  --keep-going       list every disagreement by its seed, instead of making the first smaller
  --print            only print the kernel of the seed";

/// Kernels between two reports.
const CHUNK: u64 = 2000;

struct Options {
    kernels: u64,
    seed: u64,
    gpu: u64,
    front_minutes: f64,
    keep_going: bool,
    print: bool,
}

fn options() -> Option<Options> {
    let mut options = Options {
        kernels: 1000,
        seed: 1,
        gpu: 0,
        front_minutes: 0.0,
        keep_going: false,
        print: false,
    };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--kernels" => options.kernels = words.next()?.parse().ok()?,
            "--seed" => options.seed = words.next()?.parse().ok()?,
            "--gpu" => options.gpu = words.next()?.parse().ok()?,
            "--front-minutes" => options.front_minutes = words.next()?.parse().ok()?,
            "--keep-going" => options.keep_going = true,
            "--print" => options.print = true,
            _ => return None,
        }
    }
    Some(options)
}

fn main() -> ExitCode {
    let Some(options) = options() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    if options.print {
        print!("{}", print(&generate(options.seed, Profile::Exact)));
        return ExitCode::SUCCESS;
    }
    // What panicked and where is part of the report.
    std::panic::set_hook(Box::new(|_| {}));
    let outcome = on_cpu(&options)
        .and_then(|()| on_gpu(&options))
        .and_then(|()| texts(&options));
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(report) => {
            eprintln!("{report}");
            ExitCode::FAILURE
        }
    }
}

fn on_cpu(options: &Options) -> Result<(), String> {
    let begin = Instant::now();
    let (first, end) = (options.seed, options.seed + options.kernels);
    let mut failures = 0;
    let mut done = first;
    while done < end {
        let chunk: Vec<u64> = (done..(done + CHUNK).min(end)).collect();
        let outcomes: Vec<(u64, Result<(), Failure>)> = chunk
            .par_iter()
            .map(|seed| (*seed, check(&generate(*seed, Profile::Exact), &picture(*seed))))
            .collect();
        done += chunk.len() as u64;
        for (seed, outcome) in outcomes {
            match outcome {
                Ok(()) => {}
                Err(failure) if options.keep_going => {
                    println!("seed {seed}: {failure}");
                    failures += 1;
                }
                Err(failure) => return Err(smallest(seed, &failure)),
            }
        }
        eprintln!("{} kernels, {:.1} s", done - first, begin.elapsed().as_secs_f64());
    }
    println!(
        "{} kernels agree on the CPU in {:.1} s",
        options.kernels - failures,
        begin.elapsed().as_secs_f64()
    );
    if failures > 0 {
        return Err(format!("{failures} kernels disagree"));
    }
    Ok(())
}

/// The report of a failing kernel.
fn smallest(seed: u64, failure: &Failure) -> String {
    eprintln!("seed {seed}: {failure}; making it smaller");
    let picture = picture(seed);
    let small = shrink(&generate(seed, Profile::Exact), &|candidate| {
        check(candidate, &picture).is_err_and(|now| now.like(failure))
    });
    let failure = check(&small, &picture).err().unwrap_or_else(|| failure.clone());
    format!("{}\nseed {seed}: {failure}", print(&small))
}

fn on_gpu(options: &Options) -> Result<(), String> {
    if options.gpu == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let gpu = Gpu::new()?;
    let mut total = Compared::default();
    let mut failures = 0;
    for k in 0..options.gpu {
        let seed = options.seed + k;
        let program = generate(seed, Profile::Gpu);
        let picture = picture(seed);
        match gpu.check(&program, &picture) {
            Ok(compared) => {
                total.pixels += compared.pixels;
                total.unsure += compared.unsure;
                total.refused += compared.refused;
            }
            Err(failure) if options.keep_going => {
                println!("seed {seed}: {failure}");
                failures += 1;
            }
            Err(failure) => {
                eprintln!("seed {seed}: {failure}; making it smaller");
                let small = shrink(&program, &|candidate| {
                    gpu.check(candidate, &picture).is_err_and(|now| now.like(&failure))
                });
                let failure = gpu.check(&small, &picture).err().unwrap_or(failure);
                return Err(format!("{}\nseed {seed}: {failure}", print(&small)));
            }
        }
        if (k + 1) % 200 == 0 {
            eprintln!("{} kernels on the GPU, {:.1} s", k + 1, begin.elapsed().as_secs_f64());
        }
    }
    println!(
        "{} kernels agree on the GPU in {:.1} s: {} pixels compared, {} not sure, {} shaders refused",
        options.gpu - failures,
        begin.elapsed().as_secs_f64(),
        total.pixels,
        total.unsure,
        total.refused
    );
    if failures > 0 {
        return Err(format!("{failures} kernels disagree on the GPU"));
    }
    Ok(())
}

fn texts(options: &Options) -> Result<(), String> {
    let time = Duration::from_secs_f64(options.front_minutes * 60.0);
    if time.is_zero() {
        return Ok(());
    }
    let begin = Instant::now();
    let texts = Texts::of_repository();
    let (mut next, mut accepted) = (options.seed, 0);
    while begin.elapsed() < time {
        let outcomes: Vec<_> = (next..next + CHUNK)
            .into_par_iter()
            .map(|seed| {
                let (text, function) = texts.text(seed);
                (survives(&text, function), seed)
            })
            .collect();
        next += CHUNK;
        for (outcome, seed) in outcomes {
            let why = match outcome {
                Ok(kernel) => {
                    accepted += u64::from(kernel);
                    continue;
                }
                Err(why) => why,
            };
            return Err(format!("{}\ntext {seed}: {why}", texts.text(seed).0));
        }
        eprintln!("{} texts, {:.1} s", next - options.seed, begin.elapsed().as_secs_f64());
    }
    println!(
        "{} texts in {:.1} s, {accepted} of them kernels{}",
        next - options.seed,
        begin.elapsed().as_secs_f64(),
        peak_memory().map_or(String::new(), |peak| format!("; peak memory of all {peak}"))
    );
    Ok(())
}

/// The most memory that this process had, where the system tells.
fn peak_memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line["VmHWM:".len()..].trim().to_owned())
}

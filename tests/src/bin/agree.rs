//! Looks for random kernels on which two ways to compute them disagree, and for texts that the front end does not
//! stand. Prints the first, made as small as it can be, and exits with 1.

use rayon::prelude::*;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use straightline_codegen::{Kernel, Settings};
use straightline_tests::random::check::{Failure, check, picture};
use straightline_tests::random::generate::{Profile, generate};
use straightline_tests::random::gpu::{self, Gpu};
use straightline_tests::random::make::{Feature, Features, make};
use straightline_tests::random::oracle::{self, Compared, Driver, Rustc, Tally, Verdicts, World, reduce};
use straightline_tests::random::{Texts, print, shrink, survives};

const USAGE: &str = "\
usage: agree [--kernels N] [--seed S] [--threads T] [--batch N] [--without FEATURE]... [--accepts N] [--tree N]
             [--gpu N] [--front-minutes M] [--keep-going] [--print]
  --kernels N        random kernels to compare with what rustc makes of them (1000)
  --seed S           number of the first (1)
  --threads T        threads (one for each core)
  --world W          number of the inputs (that of a batch's first kernel)
  --batch N          kernels that rustc compiles at once (400)
  --without FEATURE  leave out a group of constructs
  --accepts N        kernels with a mistake in them, which rustc and the generator must both refuse (0)
  --tree N           random kernels to compare with a tree walker (0)
  --gpu N            random kernels to run on the default adapter, against rustc (0)
  --tree-gpu N       random kernels to run on the default adapter, against a tree walker (0)
  --front-minutes M  time for mutated texts (0)
  --keep-going       list every disagreement by its seed, instead of making the first smaller
  --print            only print the kernel of the seed, and why it is refused if it is";

/// Kernels between two reports.
const CHUNK: u64 = 2000;

struct Options {
    kernels: u64,
    seed: u64,
    threads: usize,
    batch: u64,
    world: Option<u64>,
    features: Features,
    accepts: u64,
    tree: u64,
    gpu: u64,
    tree_gpu: u64,
    front_minutes: f64,
    keep_going: bool,
    print: bool,
}

fn options() -> Option<Options> {
    let mut options = Options {
        kernels: 1000,
        seed: 1,
        threads: 0,
        batch: 400,
        world: None,
        features: Features::all(),
        accepts: 0,
        tree: 0,
        gpu: 0,
        tree_gpu: 0,
        front_minutes: 0.0,
        keep_going: false,
        print: false,
    };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--kernels" => options.kernels = words.next()?.parse().ok()?,
            "--seed" => options.seed = words.next()?.parse().ok()?,
            "--threads" => options.threads = words.next()?.parse().ok()?,
            "--world" => options.world = Some(words.next()?.parse().ok()?),
            "--batch" => options.batch = words.next()?.parse().ok().filter(|n| *n > 0)?,
            "--without" => options.features = options.features.without(Features::named(&words.next()?)?),
            "--accepts" => options.accepts = words.next()?.parse().ok()?,
            "--tree" => options.tree = words.next()?.parse().ok()?,
            "--tree-gpu" => options.tree_gpu = words.next()?.parse().ok()?,
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
        let text = make(options.seed, options.features).file();
        print!("{text}");
        if let Err(errors) = Kernel::from_text("random.rs", &text, "k").compile(&Settings::default()) {
            eprintln!("{errors}");
        }
        return ExitCode::SUCCESS;
    }
    // What panicked and where is part of the report.
    std::panic::set_hook(Box::new(|_| {}));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build_global();
    if let Err(why) = pool {
        eprintln!("{why}");
        return ExitCode::FAILURE;
    }
    let outcome = against_rustc(&options)
        .and_then(|()| on_driver(&options))
        .and_then(|()| mistakes(&options))
        .and_then(|()| on_cpu(&options))
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

/// Batches of random kernels against rustc.
fn against_rustc(options: &Options) -> Result<(), String> {
    if options.kernels == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let rustc = Rustc::find()?;
    let end = options.seed + options.kernels;
    let starts: Vec<u64> = (options.seed..end).step_by(options.batch as usize).collect();
    let total = Mutex::new(Tally::default());
    let failures = Mutex::new(0u64);
    starts.par_iter().try_for_each(|start| {
        let seeds = *start..(start + options.batch).min(end);
        let (tally, found) = {
            let world = options.world.unwrap_or(*start);
            let texts: Vec<_> = seeds.map(|seed| make(seed, options.features)).collect();
            oracle::check(&rustc, &texts, world)?
        };
        let compared = {
            let mut total = total.lock().expect("no thread panics with it");
            total.add(&tally);
            total.compared
        };
        eprintln!("{compared} kernels, {:.1} s", begin.elapsed().as_secs_f64());
        for failure in found {
            if !options.keep_going {
                eprintln!("{}\n{}; making it smaller", failure.text, failure.difference);
                let small = reduce(&rustc, &failure);
                return Err(format!("{}\nworld {}: {}", small.text, small.world, small.difference));
            }
            println!(
                "seed {}, world {}: {}",
                failure.text.seed, failure.world, failure.difference
            );
            *failures.lock().expect("no thread panics with it") += 1;
        }
        Ok(())
    })?;
    let (total, failures) = (
        total.into_inner().expect("no thread panicked"),
        failures.into_inner().expect("no thread panicked"),
    );
    for (what, reasons) in [("refused", &total.refused), ("not Rust", &total.unusable)] {
        let mut reasons: Vec<_> = reasons.iter().collect();
        reasons.sort_by_key(|(_, reason)| std::cmp::Reverse(reason.kernels));
        for (why, reason) in reasons {
            println!("{what}: {} such as seed {}: {why}", reason.kernels, reason.seed);
        }
    }
    println!(
        "{} kernels agree with rustc in every form in {:.1} s: {} pixels compared, {} empty, {} panic natively; \
         {} kernels refused, {} texts not Rust",
        total.compared,
        begin.elapsed().as_secs_f64(),
        total.pixels,
        total.empty,
        total.panics,
        total.refusals(),
        total.unusable.values().map(|r| r.kernels).sum::<u64>()
    );
    if failures > 0 {
        return Err(format!("{failures} kernels disagree"));
    }
    Ok(())
}

fn on_cpu(options: &Options) -> Result<(), String> {
    if options.tree == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let (first, end) = (options.seed, options.seed + options.tree);
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
        "{} kernels agree with the tree in {:.1} s",
        options.tree - failures,
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

/// Batches of random kernels on the default adapter, against rustc.
fn on_driver(options: &Options) -> Result<(), String> {
    if options.gpu == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let (rustc, driver) = (Rustc::find()?, Driver::new()?);
    let features = options.features.without(Feature::Coarse);
    let end = options.seed + options.gpu;
    let (mut total, mut failures) = (Compared::default(), 0);
    for start in (options.seed..end).step_by(options.batch as usize) {
        let texts: Vec<_> = (start..(start + options.batch).min(end))
            .map(|seed| make(seed, features))
            .collect();
        let world = World::new(start);
        for (text, native) in texts.iter().zip(oracle::run(&rustc, &texts, &world)?) {
            let Ok(native) = native else { continue };
            if let Err(off) = driver.compare(text, &world, &native, &mut total) {
                if !options.keep_going {
                    return Err(format!("{text}\nworld {start}: {off}"));
                }
                println!("seed {}, world {start}: {off}", text.seed);
                failures += 1;
            }
        }
        eprintln!(
            "{} kernels on the driver, {:.1} s",
            total.kernels,
            begin.elapsed().as_secs_f64()
        );
    }
    println!(
        "{} kernels agree with rustc on {} in {:.1} s: {} pixels compared, {} not sure, {} forms refused",
        total.kernels,
        driver.name,
        begin.elapsed().as_secs_f64(),
        total.pixels,
        total.unsure,
        total.refused
    );
    if failures > 0 {
        return Err(format!("{failures} kernels disagree on the driver"));
    }
    Ok(())
}

/// Kernels with a mistake in them: what rustc refuses must be refused.
fn mistakes(options: &Options) -> Result<(), String> {
    if options.accepts == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let rustc = Rustc::find()?;
    let end = options.seed + options.accepts;
    let mut total = Verdicts::default();
    let mut failures = 0;
    for start in (options.seed..end).step_by(options.batch as usize) {
        let seeds = start..(start + options.batch).min(end);
        let (verdicts, lenient) = oracle::judge_changed(&rustc, seeds, options.features)?;
        total.refused += verdicts.refused;
        total.accepted += verdicts.accepted;
        total.ownership += verdicts.ownership;
        for (why, n) in verdicts.stricter {
            *total.stricter.entry(why).or_default() += n;
        }
        for case in lenient {
            if !options.keep_going {
                return Err(format!(
                    "{}\nrustc: {}\nchanged line: {}",
                    case.text, case.error, case.line
                ));
            }
            println!("seed {}: `{}`: {}", case.text.seed, case.line, case.error);
            failures += 1;
        }
    }
    for (why, n) in &total.stricter {
        println!("only the generator refuses: {n} {why}");
    }
    println!(
        "{} changed kernels in {:.1} s: both refuse {}, both accept {}, only rustc accepts {}, \
         rustc alone refuses {} for ownership and {failures} for all else",
        options.accepts,
        begin.elapsed().as_secs_f64(),
        total.refused,
        total.accepted,
        total.stricter.values().sum::<u64>(),
        total.ownership,
    );
    if failures > 0 {
        return Err(format!("{failures} kernels are accepted that rustc refuses"));
    }
    Ok(())
}

fn on_gpu(options: &Options) -> Result<(), String> {
    if options.tree_gpu == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let device = Gpu::new()?;
    let mut total = gpu::Compared::default();
    let mut failures = 0;
    for k in 0..options.tree_gpu {
        let seed = options.seed + k;
        let program = generate(seed, Profile::Gpu);
        let picture = picture(seed);
        match device.check(&program, &picture) {
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
                    device.check(candidate, &picture).is_err_and(|now| now.like(&failure))
                });
                let failure = device.check(&small, &picture).err().unwrap_or(failure);
                return Err(format!("{}\nseed {seed}: {failure}", print(&small)));
            }
        }
        if (k + 1) % 200 == 0 {
            eprintln!("{} kernels on the GPU, {:.1} s", k + 1, begin.elapsed().as_secs_f64());
        }
    }
    println!(
        "{} kernels agree on the GPU in {:.1} s: {} pixels compared, {} not sure, {} shaders refused",
        options.tree_gpu - failures,
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

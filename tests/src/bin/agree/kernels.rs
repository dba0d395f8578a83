//! Random kernels against rustc, on the CPU.

use super::options::Options;
use rayon::prelude::*;
use std::sync::Mutex;
use std::time::Instant;
use straightline_tests::random::make::make;
use straightline_tests::random::oracle::{self, Rustc, Tally, reduce};

/// Batches of random kernels against rustc.
pub fn against_rustc(options: &Options) -> Result<(), String> {
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
    let outliers = total.works.outliers();
    for outlier in &outliers {
        println!("work: {outlier}");
    }
    let failures = failures + outliers.len() as u64;
    for (what, reasons) in [("refused", &total.refused), ("not Rust", &total.unusable)] {
        let mut reasons: Vec<_> = reasons.iter().collect();
        reasons.sort_by_key(|(_, reason)| std::cmp::Reverse(reason.kernels));
        for (why, reason) in reasons {
            println!("{what}: {} such as seed {}: {why}", reason.kernels, reason.seed);
        }
    }
    println!(
        "{} kernels agree with rustc in every form in {:.1} s: {} values of pixels and {} of buffers compared, \
         {} empty, {} panic natively; \
         {} kernels refused, {} texts not Rust",
        total.compared,
        begin.elapsed().as_secs_f64(),
        total.pixels,
        total.written,
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

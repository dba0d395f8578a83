//! Mutated texts for the front end.

use super::options::Options;
use rayon::prelude::*;
use std::time::{Duration, Instant};
use straightline_tests::random::{Texts, survives};

/// Texts between two reports.
const CHUNK: u64 = 2000;

/// Tests mutated kernel texts, for some minutes.
pub fn texts(options: &Options) -> Result<(), String> {
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

/// Returns the peak memory of this process, if the system reports it.
fn peak_memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line["VmHWM:".len()..].trim().to_owned())
}

//! Random chains of passes.

use super::options::Options;
use rayon::prelude::*;
use std::time::Instant;
use straightline_tests::random::oracle::Rustc;
use straightline_tests::random::oracle::chains::{ChainTally, compare_chains};

/// Chains that rustc compiles at once: fewer than kernels, each of which is one function.
const BATCH: u64 = 100;

/// Compares random chains with rustc.
pub fn against_rustc(options: &Options) -> Result<(), String> {
    if options.chains == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let rustc = Rustc::find()?;
    let end = options.seed + options.chains;
    let starts: Vec<u64> = (options.seed..end).step_by(BATCH as usize).collect();
    let tallies = starts
        .into_par_iter()
        .map(|start| compare_chains(&rustc, start..(start + BATCH).min(end)));
    let tallies: Vec<ChainTally> = tallies.collect::<Result<_, String>>()?;
    println!(
        "{} chains in {:.1} s compute the bits of rustc; in {} a picture is fused, in {} one is shared",
        tallies.iter().map(|tally| tally.compared).sum::<usize>(),
        begin.elapsed().as_secs_f64(),
        tallies.iter().map(|tally| tally.fused).sum::<usize>(),
        tallies.iter().map(|tally| tally.shared).sum::<usize>(),
    );
    Ok(())
}

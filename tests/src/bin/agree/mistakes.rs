//! Kernels with a mistake in them.

use super::options::Options;
use std::time::Instant;
use straightline_tests::random::oracle::{self, Rustc, Verdicts};

/// Tests kernels with a mistake: the generator must reject whatever rustc rejects.
pub fn mistakes(options: &Options) -> Result<(), String> {
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

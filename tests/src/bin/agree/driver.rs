//! Random kernels on a GPU driver, against rustc.

use super::options::Options;
use std::time::Instant;
use straightline_tests::random::make::make;
use straightline_tests::random::oracle::{self, Compared, Driver, Rustc, World};

/// Batches of random kernels on the default adapter, against rustc.
pub fn on_driver(options: &Options) -> Result<(), String> {
    if options.gpu == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let (rustc, driver) = (Rustc::find()?, Driver::new()?);
    let features = options.features.on_drivers();
    let end = options.seed + options.gpu;
    let (mut total, mut failures) = (Compared::default(), 0);
    for start in (options.seed..end).step_by(options.batch as usize) {
        let texts: Vec<_> = (start..(start + options.batch).min(end))
            .map(|seed| make(seed, features))
            .collect();
        let number = options.world.unwrap_or(start);
        let world = World::new(number);
        for (text, native) in texts.iter().zip(oracle::run(&rustc, &texts, &world)?) {
            let Ok(native) = native else { continue };
            if let Err(off) = driver.compare(text, &world, &native, &mut total) {
                if !options.keep_going {
                    eprintln!("{text}\n{off}; making it smaller");
                    let small = oracle::reduce_on_driver(&rustc, &driver, text, number);
                    return Err(format!("{small}\nworld {number}: {off}"));
                }
                println!("seed {}, world {number}: {off}", text.seed);
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
        "{} kernels agree with rustc on {} in {:.1} s: {} values compared, {} of them off by rounding, {} not sure, \
         {} forms refused",
        total.kernels,
        driver.name,
        begin.elapsed().as_secs_f64(),
        total.pixels,
        total.rounded,
        total.unsure,
        total.refused
    );
    if failures > 0 {
        return Err(format!("{failures} kernels disagree on the driver"));
    }
    Ok(())
}

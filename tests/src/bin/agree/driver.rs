//! Random kernels on a GPU driver, against rustc.

use super::options::Options;
use rayon::prelude::*;
use std::sync::Mutex;
use std::time::Instant;
use straightline_tests::random::make::make;
use straightline_tests::random::oracle::{self, Compared, Driver, Rustc, Ways, World};

/// Batches of random kernels on a Vulkan adapter, against rustc.
pub fn on_driver(options: &Options) -> Result<(), String> {
    if options.gpu == 0 {
        return Ok(());
    }
    let begin = Instant::now();
    let (rustc, driver) = (Rustc::find()?, Driver::new()?);
    let features = options.features.on_drivers();
    let end = options.seed + options.gpu;
    let starts: Vec<u64> = (options.seed..end).step_by(options.batch as usize).collect();
    let total = Mutex::new((Compared::default(), 0u64));
    starts.par_iter().try_for_each(|start| {
        let seeds = *start..(start + options.batch).min(end);
        let texts: Vec<_> = seeds.map(|seed| make(seed, features)).collect();
        let number = options.world.unwrap_or(*start);
        let world = World::for_drivers(number);
        let (mut compared, mut failures) = (Compared::default(), 0);
        let natives = oracle::run(&rustc, &texts, &world)?;
        let shaders = driver.shaders(&texts, options.ways)?;
        for ((text, shaders), native) in texts.iter().zip(shaders).zip(natives) {
            let Ok(native) = native else { continue };
            let outcome = driver.compare(&shaders, &world, &native, &mut compared);
            if let Err(off) = outcome {
                if !options.keep_going {
                    eprintln!("{text}\n{off}; making it smaller");
                    let small = oracle::reduce_on_driver(&rustc, &driver, options.ways, text, number);
                    return Err(format!("{small}\nworld {number}: {off}"));
                }
                println!("seed {}, world {number}: {off}", text.seed);
                failures += 1;
            }
        }
        let mut total = total.lock().expect("no thread panics with it");
        total.0.add(&compared);
        total.1 += failures;
        eprintln!(
            "{} kernels on the driver, {:.1} s",
            total.0.kernels,
            begin.elapsed().as_secs_f64()
        );
        Ok(())
    })?;
    let (total, failures) = total.into_inner().expect("no thread panicked");
    let how = match options.ways {
        Ways::Forms => "in every form, as WGSL,",
        Ways::Languages => "in one form each, as WGSL and as GLSL,",
    };
    println!(
        "{} kernels {how} agree with rustc on {} in {:.1} s: {} values compared, {} of them off by rounding, {} not sure, \
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

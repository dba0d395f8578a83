//! Searches for random kernels on which two executions disagree, and for texts that crash the front end. Prints the first
//! one, minimised, and exits with 1.

mod chains;
mod driver;
mod kernels;
mod languages;
mod mistakes;
mod options;
mod texts;

use options::{USAGE, options};
use std::process::ExitCode;
use straightline_codegen::{Kernel, Settings};
use straightline_tests::random::make::make;

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
    // Message and place of the generator's panics are part of the report.
    if options.gpu == 0 {
        std::panic::set_hook(Box::new(|_| {}));
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build_global();
    if let Err(why) = pool {
        eprintln!("{why}");
        return ExitCode::FAILURE;
    }
    let outcome = kernels::against_rustc(&options)
        .and_then(|()| chains::against_rustc(&options))
        .and_then(|()| driver::on_driver(&options))
        .and_then(|()| languages::languages(&options))
        .and_then(|()| mistakes::mistakes(&options))
        .and_then(|()| texts::texts(&options));
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(report) => {
            eprintln!("{report}");
            ExitCode::FAILURE
        }
    }
}

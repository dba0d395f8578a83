//! `straightline`: emit, explain, run and measure straight-line shaders.

mod args;
mod commands;
mod failure;
mod gpu;
mod scene;
mod table;

use args::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match arguments.command.unwrap_or_else(|| Command::Demo(Default::default())) {
        Command::Demo(args) => commands::demo::run(&args),
        Command::List(args) => commands::list::run(&args),
        Command::Emit(args) => commands::emit::run(&args),
        Command::Explain(args) => commands::explain::run(&args),
        Command::Run(args) => commands::run::run(&args),
        Command::Budget(args) => commands::budget::run(&args),
        Command::Quads(args) => commands::quads::run(&args),
        Command::Study(args) => commands::study::run(&args),
        Command::Tune(args) => commands::tune::run(&args),
        Command::Resolve(args) => commands::resolve::run(&args),
        Command::Capture(args) => commands::capture::run(&args),
        Command::Scenes(args) => commands::scenes::run(&args),
        Command::Adapters(args) => commands::adapters::run(&args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

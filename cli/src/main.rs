//! `straightline`: emit, explain, run and measure straight-line shaders.
#![deny(clippy::print_stdout, clippy::print_stderr)] // `output` writes, and never panics

#[macro_use]
mod output;
mod args;
mod commands;
mod failure;
mod gpu;
mod interrupt;
mod scene;
mod table;

use args::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::io::IsTerminal;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(said) => return report(&said),
    };
    match interrupt::listen()
        .and_then(|()| run(arguments))
        .and_then(|()| output::finish())
    {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.command.unwrap_or_else(|| Command::Demo(Default::default())) {
        Command::Demo(args) => commands::demo::run(&args),
        Command::List(args) => commands::list::run(&args),
        Command::Emit(args) => commands::emit::run(&args),
        Command::Check(args) => commands::check::run(&args),
        Command::Explain(args) => commands::explain::run(&args),
        Command::Run(args) => commands::run::run(&args),
        Command::Watch(args) => commands::watch::run(&args),
        #[cfg(feature = "study")]
        Command::Budget(args) => commands::budget::run(&args),
        #[cfg(feature = "study")]
        Command::Quads(args) => commands::quads::run(&args),
        #[cfg(feature = "study")]
        Command::Figures(args) => commands::figures::run(&args),
        #[cfg(feature = "study")]
        Command::Study(args) => commands::study::run(&args),
        #[cfg(feature = "study")]
        Command::Tune(args) => commands::tune::run(&args),
        Command::Page(args) => commands::page::run(&args),
        Command::Resolve(args) => commands::resolve::run(&args),
        Command::Capture(args) => commands::capture::run(&args),
        Command::Compare(args) => commands::compare::run(&args),
        Command::Scenes(args) => commands::scenes::run(&args),
        #[cfg(not(feature = "study"))]
        Command::Budget(args)
        | Command::Quads(args)
        | Command::Figures(args)
        | Command::Study(args)
        | Command::Tune(args) => Err(args.refusal()),
        #[cfg(feature = "study")]
        Command::ServeIsa => straightline_isa::serve().map_err(Failure::of),
        Command::Completions(args) => commands::shell::completions(&args),
        Command::Man(args) => commands::shell::man(&args),
        Command::Adapters(args) => commands::adapters::run(&args),
    }
}

/// Prints the help that was asked for, or what is wrong with the arguments.
fn report(said: &clap::Error) -> ExitCode {
    let text = |colour: bool| {
        let text = said.render();
        if colour {
            text.ansi().to_string()
        } else {
            text.to_string()
        }
    };
    if said.use_stderr() {
        output::note(format_args!(
            "{}",
            output::limited(&text(std::io::stderr().is_terminal()))
        ));
        return ExitCode::from(2);
    }
    out!("{}", text(std::io::stdout().is_terminal()));
    output::finish().map_or_else(Failure::report, |()| ExitCode::SUCCESS)
}

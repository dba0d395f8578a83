//! `straightline`: emit, explain, run and measure straight-line shaders.
#![deny(clippy::print_stdout, clippy::print_stderr)] // `output` writes, and never panics

#[macro_use]
mod output;
mod args;
mod commands;
mod failure;
mod gpu;
mod interrupt;
mod paragraph;
mod scene;

use args::{Arguments, Command};
use clap::{CommandFactory, Parser};
use failure::Failure;
use std::io::IsTerminal;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(said) => return print_usage(&said),
    };
    match interrupt::listen_for_interrupt()
        .and_then(|()| run_command(arguments))
        .and_then(|()| output::flush_output())
    {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

fn run_command(arguments: Arguments) -> Result<(), Failure> {
    let Some(command) = arguments.command.or_else(command_of_a_checkout) else {
        out!("{}", Arguments::command().render_help());
        return Ok(());
    };
    match command {
        Command::Demo(args) => commands::demo::run_demo(&args),
        Command::List(args) => commands::list::print_list(&args),
        Command::Emit(args) => commands::emit::emit_kernel(&args),
        Command::Check(args) => commands::check::check_kernels(&args),
        Command::Explain(args) => commands::explain::explain_kernel(&args),
        Command::Run(args) => commands::run::run_kernel(&args),
        Command::Test(args) => commands::test::run_tests(&args),
        Command::Watch(args) => commands::watch::watch_kernel(&args),
        #[cfg(feature = "study")]
        Command::Budget(args) => commands::budget::measure_budget(&args),
        #[cfg(feature = "study")]
        Command::Quads(args) => commands::quads::measure_quads(&args),
        #[cfg(feature = "study")]
        Command::Figures(args) => commands::figures::write_figures(&args),
        #[cfg(feature = "study")]
        Command::Study(args) => commands::study::run_study(&args),
        #[cfg(feature = "study")]
        Command::Isa(args) => commands::compilers::list_compilers(&args),
        #[cfg(feature = "study")]
        Command::Tune(args) => commands::tune::tune_shader(&args),
        #[cfg(feature = "study")]
        Command::Choose(args) => commands::choose::choose_candidates(&args),
        Command::Page(args) => commands::page::write_page(&args),
        Command::Resolve(args) => commands::resolve::resolve_capture(&args),
        Command::Capture(args) => commands::capture::render_capture(&args),
        Command::Compare(args) => commands::compare::compare_pictures(&args),
        Command::Scenes(args) => commands::scenes::print_scenes(&args),
        #[cfg(not(feature = "study"))]
        Command::Budget(args)
        | Command::Quads(args)
        | Command::Figures(args)
        | Command::Study(args)
        | Command::Isa(args)
        | Command::Choose(args)
        | Command::Tune(args) => Err(args.refusal()),
        #[cfg(feature = "study")]
        Command::ServeIsa => straightline_isa::serve().map_err(Failure::from_error),
        Command::Completions(args) => commands::shell::print_completions(&args),
        Command::Man(args) => commands::shell::write_manual(&args),
        Command::Adapters(args) => commands::adapters::print_adapters(&args),
    }
}

/// Returns the command of a bare `cargo run`, for which cargo sets variables: the demo.
fn command_of_a_checkout() -> Option<Command> {
    std::env::var_os("CARGO_MANIFEST_DIR").map(|_| Command::Demo(Default::default()))
}

/// Prints the requested help, or the usage error.
fn print_usage(said: &clap::Error) -> ExitCode {
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
            output::limit_lines(&text(std::io::stderr().is_terminal()))
        ));
        return ExitCode::from(2);
    }
    out!("{}", text(std::io::stdout().is_terminal()));
    output::flush_output().map_or_else(Failure::report, |()| ExitCode::SUCCESS)
}

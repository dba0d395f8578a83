//! Commands, one module for each. Commands that measure kernels and scenes need the feature `study`.

pub mod adapters;
mod at;
#[cfg(feature = "study")]
pub mod budget;
pub mod capture;
mod chain;
pub mod check;
#[cfg(feature = "study")]
pub mod choose;
pub mod compare;
#[cfg(feature = "study")]
pub mod compilers;
pub mod demo;
pub mod emit;
pub mod explain;
#[cfg(feature = "study")]
pub mod figures;
mod footprint;
pub mod list;
#[cfg_attr(not(feature = "study"), path = "without_machine.rs")]
mod machine;
mod notes;
pub mod page;
mod paper;
#[cfg(feature = "study")]
pub mod quads;
pub mod resolve;
pub mod run;
pub mod scenes;
pub mod shell;
#[cfg(feature = "study")]
pub mod study;
pub mod test;
#[cfg(feature = "study")]
pub mod tune;
pub mod watch;

use crate::failure::Failure;
use straightline_codegen::ir::Invocation;
use straightline_codegen::{Compiled, Stage};

/// Returns the stage for which a kernel's graph needs no change: fragment, if quads swap values.
fn natural_stage(compiled: &Compiled) -> Stage {
    match compiled.graph.invocation {
        Invocation::Lane => Stage::Fragment,
        _ => Stage::Compute,
    }
}

/// Returns the command line as given, with the program's name instead of its path.
pub fn command_line() -> String {
    let arguments = std::env::args_os().skip(1);
    std::iter::once("straightline".to_owned())
        .chain(arguments.map(|argument| argument.to_string_lossy().into_owned()))
        .collect::<Vec<_>>()
        .join(" ")
}

/// Returns the failure of a command in a build that lacks its feature, with the remedy.
pub fn lacking_feature(feature: &str) -> Failure {
    Failure::Usage(refusal_text(&command_line(), feature))
}

fn refusal_text(command: &str, feature: &str) -> String {
    let arguments = command.strip_prefix("straightline").unwrap_or_default();
    format!(
        "`{command}` needs the feature `{feature}`, which this build lacks\n  \
         help: `cargo run --release --features {feature} --{arguments}`, or `cargo install --path cli --features {feature}`"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_build_lacks_is_said_with_the_command_that_has_it() {
        let text = refusal_text("straightline study loops --quick", "study");
        assert!(
            text.starts_with("`straightline study loops --quick` needs the feature `study`"),
            "{text}"
        );
        assert!(
            text.contains("`cargo run --release --features study -- study loops --quick`"),
            "{text}"
        );
    }
}

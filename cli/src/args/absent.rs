//! Placeholders for commands that are not built in: they parse, and explain how to get the command.
#![cfg_attr(feature = "study", allow(dead_code, reason = "its tests run where all is built in"))]

use crate::commands::lacking_feature;
use crate::failure::Failure;
use clap::Args;
use std::ffi::OsString;
use std::str::FromStr;

/// Note below the list of commands in the help.
pub const ABOUT: &str = "This build lacks budget, quads, figures, study, tune and isa: they need `--features study`.";

// All arguments of the command, `--help` included: every call gets the same answer.
#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub struct AbsentArgs {
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    pub given: Vec<OsString>,
}

impl AbsentArgs {
    /// Returns the reason why the command does nothing, and the remedy.
    pub fn refusal(&self) -> Failure {
        lacking_feature("study")
    }
}

/// A GPU to compile for. Empty: compiling for another GPU needs the feature too.
#[derive(Clone, Copy, Debug)]
pub enum Gpu {}

impl FromStr for Gpu {
    type Err = &'static str;

    fn from_str(_: &str) -> Result<Self, Self::Err> {
        Err("compilers of GPUs are asked by builds with `--features study`")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Parser, Subcommand};

    #[derive(Debug, Parser)]
    struct Whole {
        #[command(subcommand)]
        command: Command,
    }

    #[derive(Debug, Subcommand)]
    enum Command {
        Study(AbsentArgs),
    }

    #[test]
    fn whatever_it_is_given_it_says_what_helps() {
        for given in [
            &[][..],
            &["loops", "--quick", "--size", "8x8"],
            &["--help"],
            &["-h"],
            &["--", "-x"],
        ] {
            let arguments = ["straightline", "study"].iter().chain(given);
            let Command::Study(absent) = Whole::try_parse_from(arguments).expect("all is taken").command;
            assert!(
                absent.given.len() >= given.len().saturating_sub(1),
                "{given:?}: {absent:?}"
            );
        }
        assert!(
            "navi21"
                .parse::<Gpu>()
                .is_err_and(|text| text.contains("--features study"))
        );
    }
}

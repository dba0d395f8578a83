//! One module for each command.

pub mod adapters;
pub mod budget;
pub mod capture;
pub mod check;
pub mod compare;
pub mod demo;
pub mod emit;
pub mod explain;
pub mod figures;
pub mod list;
pub mod page;
pub mod quads;
pub mod resolve;
pub mod run;
pub mod scenes;
pub mod shell;
pub mod study;
pub mod tune;
pub mod watch;

use straightline_codegen::ir::Invocation;
use straightline_codegen::{Compiled, Stage};

/// The stage in which a kernel's graph is as it stands: quads swap values in fragment shaders.
fn natural_stage(compiled: &Compiled) -> Stage {
    match compiled.graph.invocation {
        Invocation::Lane => Stage::Fragment,
        _ => Stage::Compute,
    }
}

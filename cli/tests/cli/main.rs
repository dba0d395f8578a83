//! The command, as a user runs it.

mod all;
mod at;
mod budget;
mod captions;
mod capture;
mod chains;
mod check;
mod choose;
#[path = "../common/mod.rs"]
mod common;
mod compare;
mod draw;
mod emit;
mod features;
mod figures;
mod gpu;
mod knobs;
mod output;
mod page;
mod pictures;
mod precision;
mod run;
mod sources;
mod study;
mod sweep;
mod testing;
mod tune;
mod watch;
mod words;

//! The generator as a build script uses it: configuration, emission, bindings, rules of graphs and of imports.

mod bindings;
mod codes;
#[path = "../../../tests/src/compilers.rs"]
mod compilers;
mod config;
mod emission;
mod floor;
mod front;
mod imports;
mod knobs;
mod option_values;
mod places;
mod syn_variants;
mod verify;

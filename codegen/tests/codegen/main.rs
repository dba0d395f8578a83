//! The generator as a build script uses it: configuration, messages, limits, emission, bindings, rules of graphs and of imports.

mod bindings;
#[path = "../../../evaluator/tests/evaluator/cases.rs"]
mod cases;
mod codes;
#[path = "../../../tests/src/compilers.rs"]
mod compilers;
mod config;
mod emission;
mod filetests;
mod floor;
mod front;
mod imports;
mod option_values;
mod places;
mod syn_variants;

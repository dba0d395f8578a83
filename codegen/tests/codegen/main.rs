//! The generator as a build script uses it: configuration, messages, limits, emission, bindings, rules of imports.

mod bindings;
#[path = "../../../evaluator/tests/evaluator/cases.rs"]
mod cases;
mod codes;
#[path = "../../../tests/src/compilers.rs"]
mod compilers;
mod config;
mod coverage;
mod drawing;
mod emission;
mod errors;
mod filetests;
mod floor;
mod front;
mod guards;
mod imports;
mod knobs;
mod limits;
mod one_mistake;
mod option_values;
mod overrides;
mod places;
mod source_map;
mod syn_variants;
mod testing;
mod validated;

//! Every value of every option, stage and unroll policy emits in every language: naga validates each text on the way, and
//! two other compilers read the GLSL and SPIR-V.

use crate::common;

use common::Shaders;
use std::collections::BTreeSet;
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Stage, Unroll};
use straightline_tests::sraa::compiled;
use straightline_tests::sraa::options::{one_at_a_time, random, refusal};

#[test]
fn all_options_emit_in_all_languages() {
    let mut shaders = Shaders::new("every-option");
    let targets: BTreeSet<Target> = Target::MODERN.into();
    let sets = one_at_a_time().into_iter().chain(random(24, 3));
    let mut emitted_sets = 0;
    for (k, options) in sets.filter(|options| refusal(options).is_none()).enumerate() {
        emitted_sets += 1;
        for unroll in [Unroll::Full, Unroll::None] {
            let compiled = compiled(&options, unroll).unwrap_or_else(|errors| panic!("{options:?}:\n{errors}"));
            for stage in [Stage::Compute, Stage::Fragment] {
                let emitted = compiled
                    .emit(&EmitOptions::new().stage(stage).targets(targets.clone()))
                    .unwrap_or_else(|e| panic!("{options:?} {unroll}: {e}"));
                assert_eq!(emitted.files.len(), targets.len());
                let stem = format!("{k}-{}-{}", unroll, stage.name());
                shaders.write(&emitted, &stem);
            }
        }
    }
    let (glsl, spirv) = (shaders.glsl.len(), shaders.spirv.len());
    assert_eq!((glsl, spirv), (4 * emitted_sets, 4 * emitted_sets));
    shaders.read();
}

//! Presets of SRAA: sets of options with a name.

use straightline_codegen::{Kernel, Settings};
use straightline_tests::sraa::options::options;

const KERNELS: [&str; 4] = ["sraa", "sraa_place", "sraa_guide", "sraa_residual"];

#[test]
fn a_preset_is_its_options() {
    for name in KERNELS {
        let kernel = Kernel::builtin(name).expect("a kernel");
        let names: Vec<&str> = kernel.presets().iter().map(|preset| preset.name).collect();
        assert_eq!(names, ["paper", "fast", "edges", "full", "guided"]);
        for preset in kernel.presets() {
            let compile = |set: &[(&str, &str)]| {
                let compiled = kernel.compile(&Settings::new().set_all(options(set)));
                compiled.unwrap_or_else(|errors| panic!("{name}, {set:?}:\n{errors}"))
            };
            let (named, listed) = (
                compile(&[("preset", preset.name)]),
                compile(&preset.options().collect::<Vec<_>>()),
            );
            assert_eq!(named.options, listed.options, "{name}, {}", preset.name);
            assert_eq!(named.changed, listed.changed, "{name}, {}", preset.name);
            assert!(
                preset
                    .options()
                    .all(|(option, _)| named.changed.contains(&option.to_owned()))
            );
        }
    }
}

#[test]
fn an_option_beside_a_preset_overrides_it() {
    let kernel = Kernel::builtin("sraa").expect("a kernel");
    for set in [
        [("preset", "full"), ("search", "seven")],
        [("search", "seven"), ("preset", "full")],
    ] {
        let values = kernel.option_values(&options(&set)).expect("values");
        assert_eq!(values.choice("search"), Some("seven"));
        assert_eq!(values.choice("shading"), Some("placed"));
    }
}

#[test]
fn a_preset_that_is_none_is_refused_with_those_that_are() {
    let kernel = Kernel::builtin("sraa").expect("a kernel");
    let refused = |set: &[(&str, &str)]| kernel.option_values(&options(set)).expect_err("refused").to_string();
    let unknown = refused(&[("preset", "fastest")]);
    assert!(
        unknown.contains("`fastest` is not a preset of the kernel `sraa`"),
        "{unknown}"
    );
    assert!(
        unknown.contains("use one of paper, fast, edges, full, guided"),
        "{unknown}"
    );
    let twice = refused(&[("preset", "full"), ("preset", "guided")]);
    assert!(twice.contains("two presets are set, `full` and `guided`"), "{twice}");
    // A kernel without presets has no such option.
    let other = Kernel::builtin("stalker").expect("a kernel");
    let refused = other
        .option_values(&options(&[("preset", "full")]))
        .expect_err("refused")
        .to_string();
    assert!(refused.contains("no option `preset`"), "{refused}");
}

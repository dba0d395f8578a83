//! Overridden options: every built-in kernel computes the bits of the kernel with the constant set, in the interpreter.

use glam::uvec2;
use straightline_bench::execute::{interpret_kernel, test_inputs};
use straightline_codegen::{Compiled, Kernel, OptionInfo, OptionKind, OptionValue, Overridable, Settings};
use straightline_kernels::CATALOGUE;

/// Three values of an option, the default among them.
fn values(option: &OptionInfo) -> Vec<OptionValue> {
    let OptionKind::Number(of) = &option.kind else {
        return vec![
            OptionValue::Flag(false),
            OptionValue::Flag(true),
            option.default.clone(),
        ];
    };
    let default = option.default.number().expect("a number");
    // Ranges may be long, and loops run as often as an option says.
    let low = of.min.unwrap_or(0.0).max(default - 9.0);
    let high = of.max.unwrap_or(default + 2.0).min(default + 9.0);
    let middle = match of.is_integer() {
        true => ((low + high) / 2.0).floor(),
        false => f64::from((low + high) as f32 / 2.0),
    };
    [low, middle, high].map(OptionValue::Number).to_vec()
}

/// Bits of the pixels of a kernel.
fn picture(compiled: &Compiled, set: &[(String, Vec<f64>)]) -> Vec<[u32; 4]> {
    // The interpreter computes whole quads, and reads from textures what a fragment shader interpolates.
    let compiled = &*compiled.in_blocks();
    let mut inputs = test_inputs(&compiled.graph, uvec2(7, 5));
    inputs.uniforms.extend(set.iter().cloned());
    let result =
        interpret_kernel::<f32>(compiled, &inputs, false).unwrap_or_else(|e| panic!("{}: {e}", compiled.kernel));
    result.texels.iter().map(|texel| texel.map(f32::to_bits)).collect()
}

#[test]
fn overridden_kernels_have_the_bits_of_constants() {
    let (mut compared, mut kernels) = (0, 0);
    for entry in CATALOGUE {
        let kernel = Kernel::builtin(entry.name).unwrap_or_else(|e| panic!("{e}"));
        let options = kernel.options().unwrap_or_else(|e| panic!("{e}"));
        let before = compared;
        for option in &options {
            if !matches!(option.kind, OptionKind::Number(_) | OptionKind::Flag) {
                continue;
            }
            if kernel.overridable(&option.name).unwrap_or_else(|e| panic!("{e}")) != Overridable::Yes {
                continue;
            }
            let overridden = kernel.compile(&Settings::new().override_options([&option.name]));
            let overridden = overridden.unwrap_or_else(|e| panic!("{e}"));
            for value in values(option) {
                let number = value
                    .number()
                    .or(value.flag().map(|on| f64::from(u8::from(on))))
                    .expect("a value");
                let constant = kernel.compile(&Settings::new().set(&option.name, &value));
                let Ok(constant) = constant else { continue };
                let set = vec![(overridden.graph.overrides[0].name.clone(), vec![number])];
                let what = format!("{} {}={value}", entry.name, option.name);
                assert_eq!(picture(&overridden, &set), picture(&constant, &[]), "{what}");
                compared += 1;
            }
        }
        kernels += usize::from(compared > before);
    }
    println!("{compared} values, of {kernels} kernels");
    assert!(
        compared >= 100 && kernels >= 5,
        "{compared} values of {kernels} kernels"
    );
}

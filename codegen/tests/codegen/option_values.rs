//! Spellings of option values: each gives the shader, the manifest and the verdicts of the canonical one, to the byte.

use straightline_codegen::diagnostic::Errors;
use straightline_codegen::{
    Compiled, EmitOptions, Kernel, Numeric, OptionInfo, OptionKind, OptionValue, Precision, Settings, Transport, Unroll,
};
use straightline_kernels::{CATALOGUE, HalfPrecision};

fn compile(kernel: &Kernel, options: &[(&str, &str)]) -> Result<Compiled, Errors> {
    let settings = |transport| {
        Settings::new()
            .set_all(options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())))
            .unroll(Unroll::None)
            .transport(transport)
    };
    let compiled = kernel.compile(&settings(None))?;
    match compiled.quad {
        Some(_) => kernel.compile(&settings(Some(Transport::Block))),
        None => Ok(compiled),
    }
}

/// The shader's text and manifest.
fn emitted(compiled: &Compiled) -> (String, String) {
    let emitted = compiled
        .emit(&EmitOptions::new())
        .unwrap_or_else(|error| panic!("{error}"));
    let text = emitted.files.into_values().next().expect("a shader");
    (String::from_utf8(text).expect("WGSL"), emitted.manifest.to_json())
}

/// Other spellings of a number; some of the canonical one's value as an `f32` alone.
fn spellings(number: f64, of: &Numeric) -> Vec<String> {
    let mut all = vec![format!("{number}e0"), format!("{number:e}"), format!("{number:E}")];
    if number.fract() == 0.0 {
        all.push(format!("{number}.0"));
        all.push(format!("{number}."));
    } else {
        all.push(format!("{number}000"));
        all.push(format!("{:?}", f64::from(number as f32)));
    }
    if number >= 0.0 {
        all.push(format!("+{number}"));
        all.push(format!("00{number}"));
    }
    if number == 0.0 {
        all.extend(["-0", "-0.0", "0e9"].map(str::to_owned));
    }
    if !of.is_integer() && number == 0.0 {
        // No f32 is nearer to it.
        all.push("1e-60".to_owned());
    }
    all
}

/// A number beside the default, within the range.
fn another(default: f64, of: &Numeric) -> f64 {
    let candidates = [default / 2.0, 0.0, default + 1.0, default - 1.0];
    let (low, high) = (of.min.unwrap_or(f64::MIN), of.max.unwrap_or(f64::MAX));
    let fits = |n: &f64| *n != default && (low..=high).contains(n) && (!of.is_integer() || n.fract() == 0.0);
    candidates.into_iter().find(fits).unwrap_or(default)
}

/// Canonical texts of an option, each with other spellings of the same value.
fn cases(info: &OptionInfo) -> Vec<(String, Vec<String>)> {
    match (&info.kind, &info.default) {
        (OptionKind::Number(of), OptionValue::Number(default)) => {
            let numbers = [*default, another(*default, of)];
            numbers.map(|number| (number.to_string(), spellings(number, of))).into()
        }
        (OptionKind::List { of, .. }, OptionValue::Numbers(default)) => {
            let numbers = match default.is_empty() {
                true => vec![0.0, 0.0, another(0.0, of), 0.0],
                false => default.clone(),
            };
            let canonical = OptionValue::Numbers(numbers.clone()).to_string();
            let spaced = canonical.replace(',', " , ");
            let others: Vec<String> = numbers.iter().map(|number| spellings(*number, of)[0].clone()).collect();
            vec![(canonical, vec![spaced, format!(" {} ", others.join(", "))])]
        }
        // A flag and a choice have one spelling.
        _ => Vec::new(),
    }
}

#[test]
fn every_spelling_gives_the_same_bytes() {
    let mut compared = 0;
    for entry in CATALOGUE {
        let kernel = Kernel::builtin(entry.name).expect("it is built in");
        let unset = emitted(&compile(&kernel, &[]).unwrap_or_else(|errors| panic!("{}:\n{errors}", entry.name)));
        for info in kernel.options().expect("options") {
            let name = info.name.as_str();
            for (canonical, others) in cases(&info) {
                // Some values need another option's.
                let Ok(expected) = compile(&kernel, &[(name, &canonical)]) else {
                    continue;
                };
                assert_eq!(expected.options.spelled()[name], canonical, "{} {name}", entry.name);
                let texts = emitted(&expected);
                if expected.options.get(name) == Some(&info.default_value()) {
                    assert_eq!(texts, unset, "{} {name}={canonical}: the default", entry.name);
                }
                for other in others {
                    let said = format!("{} {name}={other}", entry.name);
                    let found =
                        compile(&kernel, &[(name, &other)]).unwrap_or_else(|errors| panic!("{said}:\n{errors}"));
                    assert_eq!(found.options, expected.options, "{said}");
                    assert_eq!(found.changed, expected.changed, "{said}");
                    assert_eq!(found.half_precision(), expected.half_precision(), "{said}");
                    assert_eq!(found.paper_counts(), expected.paper_counts(), "{said}");
                    assert_eq!(emitted(&found), texts, "{said}");
                    let parsed = kernel.option_values(&[(name.to_owned(), other)]).expect("values");
                    assert_eq!(parsed, expected.options, "{said}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn defaults_have_one_spelling_and_uniforms_are_none() {
    for entry in CATALOGUE {
        let kernel = Kernel::builtin(entry.name).expect("it is built in");
        let unset = compile(&kernel, &[]).unwrap_or_else(|errors| panic!("{}:\n{errors}", entry.name));
        for info in kernel.options().expect("options") {
            let found = compile(&kernel, &[(&info.name, &info.default_value().to_string())]);
            let found = found.unwrap_or_else(|errors| panic!("{} {}:\n{errors}", entry.name, info.name));
            assert!(found.changed.is_empty(), "{} {}", entry.name, info.name);
            assert_eq!(emitted(&found), emitted(&unset), "{} {}", entry.name, info.name);
        }
    }
    // At run time a uniform may be what it is until it is set; in the shader it is no constant.
    let stalker = Kernel::builtin("stalker").expect("it is built in");
    let known = compile(&stalker, &[("normal-barrier", "0.80")]).expect("a number");
    assert_eq!(known.changed, ["normal-barrier"]);
    assert_eq!(known.options.number("normal-barrier"), Some(0.8));
}

#[test]
fn verdicts_are_of_values() {
    let sraa = Kernel::builtin("sraa").expect("it is built in");
    let normals = |history: &str| compile(&sraa, &[("metric", "normals"), ("history", history)]).expect("a number");
    for history in ["0", "0.0", "-0", "+0"] {
        let compiled = normals(history);
        assert_eq!(compiled.half_precision(), HalfPrecision::Kept, "{history}");
        assert_eq!(compiled.changed, ["metric"], "{history}");
        compiled
            .emit(&EmitOptions::new().precision(Precision::F16))
            .unwrap_or_else(|e| panic!("{history}: {e}"));
    }
    let convolution = Kernel::builtin("quad_convolution").expect("it is built in");
    let paper = |radius: &str| {
        let values = convolution.option_values(&[("radius".to_owned(), radius.to_owned())]);
        let entry = straightline_kernels::find("quad_convolution").expect("it is built in");
        (entry.paper)(&values.expect("a number")).expect("counts").texture_reads
    };
    assert_eq!((paper("1"), paper("1.0"), paper("2e0")), (4, 4, 9));
}

#[test]
fn settings_are_refused_as_by_compiling() {
    let sraa = Kernel::builtin("sraa").expect("it is built in");
    for set in [
        &[("tau", " 1")][..],
        &[("tau", "-1"), ("metric", "normal")],
        &[("history", "0.5")],
        &[("history", "uniform5"), ("taau", "1")],
        &[("offsets", "0,uniform")],
        &[("extra", "True")],
        &[("tau", "1"), ("tau", "1.0")],
    ] {
        let owned: Vec<_> = set.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect();
        let parsed = sraa.option_values(&owned).expect_err("a refusal").to_string();
        let compiled = compile(&sraa, set).expect_err("a refusal").to_string();
        assert_eq!(parsed, compiled);
    }
}

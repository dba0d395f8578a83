//! How long generating takes, in seconds of CPU time: `cargo run --profile dist -p straightline-tests --bin generate`.

use cpu_time::ProcessTime;
use std::process::ExitCode;
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Kernel, Settings, Unroll};

/// A kernel of so many taps that it has 10 000 statements.
const LARGE: &str = "
pub fn large(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for y in -29..=29 {
        for x in -29..=29 {
            let tap = color.load(pixel + ivec2(x, y));
            let away = tap.distance_squared(Vec4::ONE);
            let weight = (-away).exp();
            sum += weight * tap;
        }
    }
    sum
}
";

fn main() -> ExitCode {
    match variants().and_then(|()| large()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// A hundred variants of SRAA: every pattern, metric, falloff, normalisation and shading sample, unrolled, and some of
/// them looped.
fn variants() -> Result<(), String> {
    let kernel = Kernel::builtin("sraa").map_err(|e| e.to_string())?;
    let choices: [(&str, &[&str]); 5] = [
        ("pattern", &["ordered4", "latin4", "ordered16", "latin16"]),
        ("metric", &["depth-normals", "depth"]),
        ("falloff", &["none", "tent"]),
        ("normalisation", &["paper", "shifted"]),
        ("shading", &["centre", "sample0"]),
    ];
    let begin = ProcessTime::now();
    let (mut count, mut statements) = (0, 0);
    for k in 0..100 {
        let mut rest = k;
        let mut options = Vec::new();
        for (name, values) in choices {
            options.push((name.to_owned(), values[rest % values.len()].to_owned()));
            rest /= values.len();
        }
        let unroll = if rest == 0 { Unroll::Full } else { Unroll::None };
        let settings = Settings::new().set_all(options).unroll(unroll);
        let compiled = kernel.compile(&settings).map_err(|e| e.to_string())?;
        let emitted = compiled.emit(&EmitOptions::new()).map_err(|e| e.to_string())?;
        statements += emitted.manifest.counts.statements;
        count += 1;
    }
    println!(
        "{count} variants of SRAA, {statements} statements of validated WGSL: {:.2} s",
        begin.elapsed().as_secs_f64()
    );
    Ok(())
}

fn large() -> Result<(), String> {
    let begin = ProcessTime::now();
    let compiled = Kernel::from_text("large.rs", LARGE, "large")
        .compile(&Settings::default())
        .map_err(|e| e.to_string())?;
    let evaluated = begin.elapsed();
    let emitted = compiled.emit(&EmitOptions::new()).map_err(|e| e.to_string())?;
    let emission = begin.elapsed() - evaluated;
    let wgsl = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
    let begin = ProcessTime::now();
    naga::front::wgsl::parse_str(&wgsl).map_err(|e| e.emit_to_string(&wgsl))?;
    println!(
        "a kernel of {} statements: {:.2} s to evaluate, {:.2} s to emit and validate, of which naga reads the WGSL for {:.2} s",
        emitted.manifest.counts.statements,
        evaluated.as_secs_f64(),
        emission.as_secs_f64(),
        begin.elapsed().as_secs_f64()
    );
    Ok(())
}

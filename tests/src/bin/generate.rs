//! Duration of generating, in seconds of CPU time: `cargo run --profile dist -p straightline-tests --bin generate`.

use cpu_time::ProcessTime;
use std::process::ExitCode;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Settings, Unroll};
use straightline_table::Table;

/// A kernel of taps in a square, each with an exponential, of so many statements as the option says.
const SQUARE: &str = "
options! {
    pub struct Size {
        /// Taps to each side.
        pub radius: i32 [1..=100] = 1,
    }
}

pub fn square(cfg: &Size, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for y in -cfg.radius..=cfg.radius {
        for x in -cfg.radius..=cfg.radius {
            let tap = color.load(pixel + ivec2(x, y));
            let away = tap.distance_squared(Vec4::ONE);
            let weight = (-away).exp();
            sum += weight * tap;
        }
    }
    sum
}
";

/// Radii of the square, for some hundred to some hundred thousand statements.
const RADII: [u32; 7] = [2, 5, 9, 15, 28, 50, 91];

/// Statements beyond which naga takes minutes to read a function.
const MOST_EMITTED: u32 = 40_000;

fn main() -> ExitCode {
    match variants().and_then(|()| sizes()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Generates a hundred variants of SRAA: every pattern, metric, falloff, normalisation and shading sample, unrolled, and
/// some of them looped.
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

/// Time and memory of one kernel by its size.
fn sizes() -> Result<(), String> {
    let mut rows = Vec::new();
    let limits = |settings: Settings| {
        let time = std::time::Duration::from_secs(600);
        settings.budget(u32::MAX).time_limit(time).memory_limit(8 << 30)
    };
    for radius in RADII {
        let begin = ProcessTime::now();
        let compiled = Kernel::from_text("square.rs", SQUARE, "square")
            .compile(&limits(Settings::new().set("radius", radius)))
            .map_err(|e| e.to_string())?;
        let compile = begin.elapsed().as_secs_f64();
        let begin = ProcessTime::now();
        let counts = compiled
            .describe(&EmitOptions::new())
            .map_err(|e| e.to_string())?
            .counts;
        let describe = begin.elapsed().as_secs_f64();
        let each = 1e3 * (compile + describe) / f64::from(counts.statements);
        let (emit, read) = match counts.statements {
            ..=MOST_EMITTED => emission(&compiled)?,
            _ => ("–".to_owned(), "–".to_owned()),
        };
        rows.push((
            counts.statements,
            [compile, describe, each],
            [emit, read, peak_memory()],
        ));
    }
    let table = Table::of(&rows)
        .column("statements", |(statements, ..)| *statements)
        .fixed("compiled, s", 2, |(_, times, _)| times[0])
        .fixed("described, s", 2, |(_, times, _)| times[1])
        .fixed("a statement, ms", 3, |(_, times, _)| times[2])
        .column("emitted as WGSL, s", |(.., rest)| &rest[0])
        .column("of which naga reads, s", |(.., rest)| &rest[1])
        .column("memory at most, MB", |(.., rest)| &rest[2])
        .finish();
    println!("\n{}", table.to_markdown());
    Ok(())
}

/// Seconds that emission takes, and of these what naga takes to read the WGSL.
fn emission(compiled: &Compiled) -> Result<(String, String), String> {
    let begin = ProcessTime::now();
    let emitted = compiled.emit(&EmitOptions::new()).map_err(|e| e.to_string())?;
    let emission = begin.elapsed().as_secs_f64();
    let wgsl = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
    let begin = ProcessTime::now();
    naga::front::wgsl::parse_str(&wgsl).map_err(|e| e.emit_to_string(&wgsl))?;
    Ok((
        format!("{emission:.2}"),
        format!("{:.2}", begin.elapsed().as_secs_f64()),
    ))
}

/// Returns the peak memory of the process in MB, if the system reports it.
fn peak_memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes: Option<u64> = line.and_then(|line| line.trim_end_matches("kB").trim().parse().ok());
    kilobytes.map_or_else(|| "–".to_owned(), |kb| (kb / 1000).to_string())
}

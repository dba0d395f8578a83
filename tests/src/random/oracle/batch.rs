//! Running many kernels natively.

use super::rustc::{modules, refuse};
use super::{Rustc, Text, Verdict, World};
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// The colour of each pixel as rustc's program computes it; `None` where it panics, so that Rust says nothing.
pub type Native = Vec<Option<[u32; 4]>>;

/// Compiles the texts as one program and gives the pixels of each, or why rustc refuses it.
///
/// # Errors
///
/// rustc cannot be run, or the program does not end well: what was said.
pub fn run(rustc: &Rustc, texts: &[Text], world: &World) -> Result<Vec<Result<Native, String>>, String> {
    let mut verdicts = vec![Verdict::Accepted; texts.len()];
    let program = loop {
        let (modules, lines) = modules(texts, &verdicts);
        if lines.is_empty() {
            break None;
        }
        let numbers: Vec<usize> = lines.iter().map(|(_, k)| *k).collect();
        let source = program(modules, texts, &numbers, world);
        match rustc.compile(&source, &["--crate-type=bin", "-Ccodegen-units=1"]) {
            Ok(program) => break Some((program, numbers)),
            Err(errors) => refuse(&errors, &lines, &mut verdicts)?,
        }
    };
    let mut natives = match program {
        Some((program, numbers)) => execute(&program, numbers.len())?,
        None => Vec::new(),
    }
    .into_iter();
    let each = verdicts.into_iter().map(|verdict| match verdict {
        Verdict::Accepted => Ok(natives.next().unwrap_or_default()),
        Verdict::Refused(why) => Err(why),
    });
    Ok(each.collect())
}

/// Runs a program of some kernels.
fn execute(program: &Path, kernels: usize) -> Result<Vec<Native>, String> {
    let output = Command::new(program).output();
    let _ = std::fs::remove_file(program);
    let output = output.map_err(|e| format!("{}: {e}", program.display()))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(format!("the native kernels end with {}: {said}", output.status));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let mut all = Vec::new();
    for line in text.lines() {
        let mut pixels = Vec::new();
        for pixel in line.split(';').filter(|pixel| !pixel.is_empty()) {
            let words: Vec<u32> = pixel
                .split(',')
                .filter_map(|w| u32::from_str_radix(w, 16).ok())
                .collect();
            pixels.push(words.try_into().ok());
        }
        all.push(pixels);
    }
    if all.len() == kernels {
        Ok(all)
    } else {
        Err(format!("{kernels} kernels gave {} lines", all.len()))
    }
}

/// The crate of a batch.
fn program(modules: String, texts: &[Text], numbers: &[usize], world: &World) -> String {
    let mut source = modules;
    source += &world.native();
    source += "type Kernel = fn(&World, straightline_kernels::prelude::IVec2) -> straightline_kernels::prelude::Vec4;\n\
               static KERNELS: &[Kernel] = &[\n";
    for k in numbers {
        let arguments = arguments(&texts[*k].source);
        let _ = writeln!(source, "|w, at| k{k}::k({arguments}),");
    }
    source += MAIN;
    source
}

/// What a kernel is called with, by the first parameters that its text states.
fn arguments(source: &str) -> &'static str {
    if source.contains("pub fn k(cfg: &Cfg") {
        "&Default::default(), &w.a, &w.b, P, Q, R, at"
    } else if source.contains("pub fn k(a: &Frame<Vec4>, pixel") {
        "&w.a, at"
    } else {
        "&w.a, &w.b, P, Q, R, at"
    }
}

const MAIN: &str = r#"];
struct World {
    a: straightline_kernels::prelude::Frame<straightline_kernels::prelude::Vec4>,
    b: straightline_kernels::prelude::Buffer<f32>,
}
fn main() {
    use straightline_kernels::prelude::*;
    use std::io::Write;
    std::panic::set_hook(Box::new(|_| {}));
    // A text that is being made smaller may never end.
    std::thread::spawn(|| {
        std::thread::sleep(std::time::Duration::from_secs(30));
        std::process::exit(3);
    });
    let texels = TEXELS.chunks(4).map(|t| vec4(t[0], t[1], t[2], t[3])).collect();
    let world = World { a: Frame::new(uvec2(SIZE[0], SIZE[1]), texels), b: Buffer::new(BUFFER.to_vec()) };
    let mut out = Vec::new();
    for kernel in KERNELS {
        for y in 0..SIZE[1] as i32 {
            for x in 0..SIZE[0] as i32 {
                let run = std::panic::AssertUnwindSafe(|| kernel(&world, ivec2(x, y)));
                match std::panic::catch_unwind(run) {
                    Ok(c) => {
                        let [r, g, b, a] = c.to_array().map(f32::to_bits);
                        let _ = write!(out, "{r:x},{g:x},{b:x},{a:x};");
                    }
                    Err(_) => out.extend_from_slice(b"-;"),
                }
            }
        }
        out.push(b'\n');
    }
    std::io::stdout().write_all(&out).unwrap();
}
"#;

//! Results of tests, for people or as the JSON of Rust's test programs.

use super::{Done, End};
use crate::output;
use serde_json::{Value, json};
use std::io::IsTerminal;
use std::time::Duration;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::testing::Test;

pub struct Printer {
    pub json: bool,
}

impl Printer {
    pub fn print_start(&self, file: &str, count: usize, by: &str) {
        match self.json {
            true => outln!(
                "{}",
                json!({ "type": "suite", "event": "started", "test_count": count, "file": file, "runners": by })
            ),
            false => {
                let noun = if count == 1 { "test" } else { "tests" };
                outln!("running {count} {noun} of {file} by {by}");
            }
        }
    }

    pub fn print_name(&self, test: &Test) {
        match self.json {
            true => outln!("{}", json!({ "type": "test", "event": "started", "name": test.path })),
            false => out!("test {} ... ", test.path),
        }
    }

    pub fn print_end(&self, done: &Done<'_>) {
        if self.json {
            return outln!("{}", end_json(done));
        }
        outln!(
            "{}",
            match done.end {
                End::Passed { .. } => "ok",
                End::Ignored => "ignored",
                End::Failed(_) | End::Refused(_) => "FAILED",
            }
        );
    }

    /// Prints the failures with their source, and the notes of other tests.
    pub fn print_failures(&self, all: &[Done<'_>]) {
        if self.json {
            return;
        }
        for done in all {
            let note = match &done.end {
                End::Passed { note } => note.as_ref(),
                _ => None,
            };
            if let Some(errors) = done.errors().or(note) {
                outln!("\n{}", rendered(errors, std::io::stdout().is_terminal()).trim_end());
            }
        }
    }

    pub fn print_summary(&self, all: &[Done<'_>], time: Duration) {
        let failed = all.iter().filter(|done| done.has_failed()).count();
        let ignored = all.iter().filter(|done| matches!(done.end, End::Ignored)).count();
        let passed = all.len() - failed - ignored;
        if self.json {
            let event = if failed == 0 { "ok" } else { "failed" };
            return outln!(
                "{}",
                json!({
                    "type": "suite",
                    "event": event,
                    "passed": passed,
                    "failed": failed,
                    "ignored": ignored,
                    "exec_time": time.as_secs_f64(),
                })
            );
        }
        let word = if failed == 0 { "ok" } else { "FAILED" };
        let seconds = time.as_secs_f64();
        outln!("\ntest result: {word}. {passed} passed; {failed} failed; {ignored} ignored; finished in {seconds:.2}s");
    }
}

/// Renders errors with overlong lines shortened.
pub fn rendered(errors: &Errors, colour: bool) -> String {
    output::limit_lines(&errors.render(colour))
}

fn end_json(done: &Done<'_>) -> Value {
    let event = match done.end {
        End::Passed { .. } => "ok",
        End::Ignored => "ignored",
        End::Failed(_) | End::Refused(_) => "failed",
    };
    let mut value = json!({
        "type": "test",
        "event": event,
        "name": done.test.path,
        "exec_time": done.time.as_secs_f64(),
    });
    if let Some(errors) = done.errors() {
        value["stdout"] = json!(rendered(errors, false));
        let span = errors.diagnostics.first().and_then(|first| first.span);
        if let Some((span, file)) = span.and_then(|span| Some((span, errors.files.get(span.file as usize)?))) {
            value["file"] = json!(file.path);
            value["line"] = json!(span.line);
        }
    }
    if let End::Failed(failure) = &done.end {
        value["runner"] = json!(failure.runner);
        value["inputs"] = json!(failure.inputs);
        value["left"] = json!(failure.values[0]);
        value["right"] = json!(failure.values[1]);
        value["ulps"] = json!(failure.ulps);
        value["psnr"] = json!(failure.psnr);
    }
    value
}

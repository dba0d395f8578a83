//! Tests of a kernel's file: each `#[test]` becomes a kernel whose invocations run one case, or draw one pixel, each.
//!
//! The text of the file stays: its tokens keep their places, so that errors and failures name them. In the file,
//! assertions become calls of [`RECORD`], which the evaluator turns into writes to buffers of the test's kernel.

mod arguments;
mod assertions;
mod entry;
mod literals;
mod picture;
mod probes;
mod recorded;

pub use assertions::{Site, SiteKind};
pub use picture::{ImageSource, TestImage, TestPicture};
pub use probes::{Probe, ProbeKind};
pub use recorded::{Kind, Recorded};

use super::{Parsed, add_library, collect_items, purposes, read_syntax, std, syntax_error};
use crate::diagnostic::{Diagnostic, Errors, File, Span};
use ::std::sync::Arc;
use straightline_kernels::properties::{Argument, CLOSE, COLOR};

/// Function that records an assertion: its site, its condition and its values.
pub const RECORD: &str = "straightline_record";

/// Function that counts an execution of a probe.
pub const COUNT: &str = "straightline_count";

/// Buffer with the executions by probe, of a test that is covered.
pub const COUNTS: &str = "straightline_counts";

/// Variables that hold the values of an assertion, left and right.
pub const VALUE_NAMES: [&str; 2] = ["straightline_left", "straightline_right"];

/// Buffer with the cases of a test.
pub const CASES: &str = "straightline_cases";

/// Buffer with two numbers an invocation: how many assertions failed, and which was first with the kinds of its values.
pub const STATE: &str = "straightline_state";

/// Buffer with the values of the first failure of an invocation, left and right, if they are floats.
pub const FLOATS: &str = "straightline_floats";

/// Buffer with the values of the first failure of an invocation, left and right, if they are integers or booleans.
pub const WORDS: &str = "straightline_words";

/// Tests of a file.
#[derive(Clone, Debug)]
pub struct Tests {
    /// The tests in order.
    pub tests: Vec<Test>,
    /// Assertions of all files by number.
    pub sites: Vec<Site>,
}

/// A test.
#[derive(Clone, Debug)]
pub struct Test {
    /// Path of the function: `tests::name`.
    pub path: String,
    /// Name of the kernel that it becomes.
    pub entry: String,
    /// Place of its name.
    pub span: Span,
    /// Arguments of its property by name; empty without `for_all`.
    pub arguments: Vec<(String, Argument)>,
    /// Picture that it draws; `None` without `assert_picture`.
    pub picture: Option<TestPicture>,
    /// `true` if its kernel counts what it executes, by [`list_probes`].
    pub covered: bool,
    /// `true` if it has the attribute `ignore`.
    pub ignored: bool,
    /// Reasons why no kernel can be made of it.
    pub errors: Vec<Diagnostic>,
}

/// Finds the tests of the first of `files`.
///
/// # Errors
///
/// If a file is not Rust.
pub fn list_tests(files: &Arc<Vec<File>>) -> Result<Tests, Errors> {
    let syntax = read_syntax(files)?;
    let mut sites = Vec::new();
    let mut tests = Vec::new();
    for (file, parsed) in syntax {
        let parsed = rewrite(files, file, parsed, &mut sites)?;
        if file == 0 {
            tests = entry::list_tests(file, &parsed);
        }
    }
    Ok(Tests { tests, sites })
}

/// Lists the places of all files whose executions are counted, in the order of their numbers.
///
/// # Errors
///
/// If a file is not Rust.
pub fn list_probes(files: &Arc<Vec<File>>) -> Result<Vec<Probe>, Errors> {
    let mut probes = Vec::new();
    for (file, mut parsed) in read_syntax(files)? {
        probes::insert_probes(file, &mut parsed, &mut probes);
    }
    Ok(probes)
}

/// Reads all files and lowers what the kernel of `test` reaches.
///
/// # Errors
///
/// As of [`parse`](super::parse).
pub fn parse_test(files: &Arc<Vec<File>>, test: &Test) -> Result<Parsed, Errors> {
    let mut sites = Vec::new();
    let mut syntax = Vec::new();
    let mut probes = Vec::new();
    for (file, mut parsed) in read_syntax(files)? {
        if test.covered {
            probes::insert_probes(file, &mut parsed, &mut probes);
        }
        let mut parsed = rewrite(files, file, parsed, &mut sites)?;
        if file == 0 {
            entry::make_kernel(&mut parsed, test);
        }
        syntax.push((file, parsed));
    }
    let mut items = collect_items(&mut syntax);
    let mut mentioned: Vec<File> = files.to_vec();
    for text in [CLOSE, COLOR] {
        match syn::parse_file(text) {
            Ok(mut parsed) => items.add_file(std::FILE, &mut parsed),
            Err(error) => return Err(Errors::from_diagnostic(syntax_error(std::FILE, "", &error))),
        }
        mentioned.push(File {
            path: String::new(),
            text: text.to_owned(),
        });
    }
    add_library(&mut items, &mentioned)?;
    let lowered = items.lower_reached(&test.entry);
    let mut parsed = lowered.map_err(|found| Errors::new(found, files))?;
    parsed.library.purposes = purposes::function_purposes(&parsed.library);
    Ok(parsed)
}

/// A file whose assertions are calls of [`RECORD`], as it is under `cfg(test)`.
fn rewrite(files: &Arc<Vec<File>>, file: u32, parsed: syn::File, sites: &mut Vec<Site>) -> Result<syn::File, Errors> {
    let tokens = assertions::rewrite_tokens(file, quote::ToTokens::into_token_stream(parsed), sites);
    syn::parse2(tokens).map_err(|error| Errors::new(vec![syntax_error(file, "", &error)], files))
}

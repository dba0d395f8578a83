//! `test`: runs the tests of a kernel's file as shaders.

mod coverage;
mod device;
mod junit;
mod picture;
mod print;

use crate::args::TestArgs;
use crate::failure::{Failure, format_count};
use crate::gpu::{Gpu, INSTALL};
use coverage::Covering;
use device::DeviceRunner;
use picture::PictureTest;
use print::Printer;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::testing::{self, Coverage, Plan, Runner, Test, TestFile, TestKernel, Verdict, check_test};
use straightline_codegen::{Settings, files};

/// Result of a test with its duration.
pub struct Done<'t> {
    test: &'t Test,
    end: End,
    time: Duration,
}

/// End of a test.
pub enum End {
    Passed {
        note: Option<Errors>,
    },
    Ignored,
    /// The test fails as a shader.
    Failed(Box<testing::Failure>),
    /// No kernel can be made of the test.
    Refused(Errors),
}

/// Runs the selected tests and prints their results. Fails if one fails, or if there is none.
pub fn run_tests(args: &TestArgs) -> Result<(), Failure> {
    for path in args.junit.iter().chain(&args.coverage) {
        files::try_file(path, false).map_err(Failure::from_error)?;
    }
    let file = TestFile::read(&args.file, args.source.iter().map(PathBuf::as_path))?;
    let shown = args.file.display().to_string();
    let selected = select_tests(&file, &args.names, &shown)?;
    let gpu = open_device(args)?;
    let by = match &gpu {
        Some(gpu) => format!("the interpreter and {}", gpu.describe()),
        None => "the interpreter".to_owned(),
    };
    let printer = Printer { json: args.json };
    printer.print_start(&shown, selected.len(), &by);
    let start = Instant::now();
    let mut coverage = args.coverage.as_ref().map(|_| Coverage::new(&file)).transpose()?;
    let mut all = Vec::new();
    for test in selected {
        printer.print_name(test);
        let begun = Instant::now();
        let mut end = run_test(args, &file, test, gpu.as_ref());
        if let (Some(coverage), false) = (&mut coverage, matches!(end, End::Ignored | End::Refused(_)))
            && let Err(failure) = cover_test(args, &file, test, coverage)
        {
            end = End::Failed(failure);
        }
        let done = Done {
            test,
            end,
            time: begun.elapsed(),
        };
        printer.print_end(&done);
        all.push(done);
    }
    printer.print_failures(&all);
    printer.print_summary(&all, start.elapsed());
    if let Some(path) = &args.junit {
        let text = junit::results_xml(&shown, &file, &all, start.elapsed());
        files::write_file(path, text.as_bytes()).map_err(Failure::from_error)?;
    }
    if let (Some(coverage), Some(path)) = (&coverage, &args.coverage) {
        coverage::write_coverage(coverage, path, args.json)?;
    }
    match all.iter().filter(|done| done.has_failed()).count() {
        0 => Ok(()),
        failed => Err(Failure::Failed(format!(
            "{failed} of {} failed",
            format_count(all.len(), "test")
        ))),
    }
}

impl Done<'_> {
    fn has_failed(&self) -> bool {
        matches!(self.end, End::Failed(_) | End::Refused(_))
    }

    /// The errors of a failure.
    fn errors(&self) -> Option<&Errors> {
        match &self.end {
            End::Failed(failure) => Some(&failure.errors),
            End::Refused(errors) => Some(errors),
            End::Passed { .. } | End::Ignored => None,
        }
    }
}

/// The tests whose paths contain one of the names.
fn select_tests<'f>(file: &'f TestFile, names: &[String], shown: &str) -> Result<Vec<&'f Test>, Failure> {
    if file.tests.is_empty() {
        return Err(Failure::Failed(format!(
            "`{shown}` has no tests\n  help: write one: `#[test] fn is_finite() {{ for_all(|x: f32| assert!(weight(x).is_finite())); }}`"
        )));
    }
    let wanted = |test: &&Test| names.is_empty() || names.iter().any(|name| test.path.contains(name.as_str()));
    let selected: Vec<&Test> = file.tests.iter().filter(wanted).collect();
    if selected.is_empty() {
        let all: Vec<&str> = file.tests.iter().map(|test| test.path.as_str()).collect();
        return Err(Failure::Usage(format!(
            "no test of `{shown}` has such a name; there are {}",
            all.join(", ")
        )));
    }
    Ok(selected)
}

fn open_device(args: &TestArgs) -> Result<Option<Gpu>, Failure> {
    if args.without_gpu {
        return Ok(None);
    }
    let gpu = Gpu::open(&args.adapter)?.ok_or_else(|| {
        Failure::Failed(format!(
            "there is no GPU adapter to run the tests on; {INSTALL}, or run them by the interpreter alone: --without-gpu"
        ))
    })?;
    Ok(Some(gpu))
}

fn run_test(args: &TestArgs, file: &TestFile, test: &Test, gpu: Option<&Gpu>) -> End {
    if test.ignored {
        return End::Ignored;
    }
    let settings = args.options.settings();
    let kernel = match file.compile_with(test, &settings) {
        Ok(kernel) => kernel,
        Err(errors) => return End::Refused(errors),
    };
    let mut device = gpu.map(DeviceRunner::new);
    if let Some(picture) = &test.picture {
        return drawing_of(args, file, &kernel, &settings).run(picture, device.as_mut());
    }
    let device = device.as_mut().map(|device| device as &mut dyn Runner);
    match check_test(&kernel, &plan_of(args), device) {
        Verdict::Passed(passed) => End::Passed { note: passed.note },
        Verdict::Failed(failure) => End::Failed(failure),
    }
}

/// Runs a test once more, and counts what it executes.
fn cover_test(
    args: &TestArgs,
    file: &TestFile,
    test: &Test,
    coverage: &mut Coverage,
) -> Result<(), Box<testing::Failure>> {
    let settings = args.options.settings();
    let kernel = file.compile_covered(test, test.picture.as_ref(), &settings);
    let kernel = kernel.map_err(testing::Failure::from_errors)?;
    let covering = Covering {
        drawing: drawing_of(args, file, &kernel, &settings),
        plan: plan_of(args),
    };
    covering.run(coverage)
}

fn plan_of(args: &TestArgs) -> Plan {
    Plan {
        cases: args.cases as usize,
        seed: args.seed,
        ..Plan::default()
    }
}

fn drawing_of<'a>(
    args: &'a TestArgs,
    file: &'a TestFile,
    kernel: &'a TestKernel,
    settings: &'a Settings,
) -> PictureTest<'a> {
    PictureTest {
        file,
        kernel,
        settings,
        path: &args.file,
        bless: args.bless,
    }
}

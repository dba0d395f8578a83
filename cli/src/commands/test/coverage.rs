//! `test --coverage`: what the tests execute, as LCOV and in words.

use super::picture::PictureTest;
use crate::failure::Failure;
use serde_json::json;
use std::path::Path;
use std::time::Instant;
use straightline_codegen::files;
use straightline_codegen::testing::{
    self, Coverage, ImageSource, Plan, TestKernel, TestPicture, cover_cases, cover_picture, report_not_run,
};

/// A test whose kernel has probes.
pub struct Covering<'a> {
    pub drawing: PictureTest<'a>,
    pub plan: Plan,
}

impl Covering<'_> {
    /// Adds what the test executes.
    pub fn run(&self, coverage: &mut Coverage) -> Result<(), Box<testing::Failure>> {
        let PictureTest { kernel, .. } = self.drawing;
        let deadline = Instant::now() + self.plan.time;
        match &kernel.test.picture {
            Some(picture) => self.run_picture(coverage, picture, deadline),
            None => {
                let counts = cover_cases(kernel, &self.plan.cases_of(&kernel.test), deadline);
                coverage.add(&counts.map_err(|error| report_not_run(kernel, &error))?);
                Ok(())
            }
        }
    }

    fn run_picture(
        &self,
        coverage: &mut Coverage,
        picture: &TestPicture,
        deadline: Instant,
    ) -> Result<(), Box<testing::Failure>> {
        let PictureTest {
            file, kernel, settings, ..
        } = self.drawing;
        let images = self.drawing.make_images(picture, deadline)?;
        let mut add = |kernel: &TestKernel, picture: &TestPicture, count: usize| {
            let counts = cover_picture(kernel, picture, &images[..count], deadline);
            coverage.add(&counts.map_err(|error| report_not_run(kernel, &error))?);
            Ok::<(), Box<testing::Failure>>(())
        };
        for (k, image) in picture.images.iter().enumerate() {
            if let ImageSource::Drawn(drawn) = &image.source {
                let kernel = file.compile_covered(&kernel.test, Some(drawn), settings);
                add(&kernel.map_err(testing::Failure::from_errors)?, drawn, k)?;
            }
        }
        add(kernel, picture, images.len())
    }
}

/// Writes the file, and prints a line for each file of the kernel.
pub fn write_coverage(coverage: &Coverage, path: &Path, json: bool) -> Result<(), Failure> {
    files::write_file(path, coverage.to_lcov().as_bytes()).map_err(Failure::from_error)?;
    for file in coverage.by_file() {
        if !json {
            outln!("{file}");
            continue;
        }
        let [functions, lines, branches] = file.totals().map(|(hit, all)| json!({ "run": hit, "all": all }));
        outln!(
            "{}",
            json!({
                "type": "coverage",
                "file": file.path,
                "functions": functions,
                "lines": lines,
                "branches": branches,
                "not_run": file.missing_lines(),
            })
        );
    }
    Ok(())
}

//! Tests that draw pictures: drawn by interpreter and GPU, and compared with golden files.

use super::End;
use super::device::DeviceRunner;
use std::path::{Path, PathBuf};
use std::time::Instant;
use straightline_codegen::Settings;
use straightline_codegen::diagnostic::{Code, Diagnostic, Errors, Span};
use straightline_codegen::shorten;
use straightline_codegen::testing::{
    Failure, ImageSource, Painted, Plan, RunnerError, TestFile, TestKernel, TestPicture, interpret_picture,
    pixel_inputs, report_not_run, report_pixel,
};
use straightline_kernels::pictures::{Drawn, Mismatch, compare_with_file, picture_path, read_drawn};

/// Requests for a test that draws a picture.
pub struct PictureTest<'a> {
    pub file: &'a TestFile,
    pub kernel: &'a TestKernel,
    pub settings: &'a Settings,
    /// The kernel's file.
    pub path: &'a Path,
    /// `true` if the golden file is to be written.
    pub bless: bool,
}

impl PictureTest<'_> {
    /// Draws the picture by all runners and compares it.
    pub fn run(&self, picture: &TestPicture, device: Option<&mut DeviceRunner>) -> End {
        match self.check(picture, device) {
            Ok(()) => End::Passed { note: None },
            Err(failure) => End::Failed(failure),
        }
    }

    fn check(&self, picture: &TestPicture, device: Option<&mut DeviceRunner>) -> Result<(), Box<Failure>> {
        let deadline = Instant::now() + Plan::default().time;
        let images = self.make_images(picture, deadline)?;
        let golden = self.path_of(&picture.golden);
        let golden = golden.map_err(|error| self.unusable(picture.span, error, "name a PNG"))?;
        let not_run = |error: RunnerError| report_not_run(self.kernel, &error);
        let painted = interpret_picture::<f32>(self.kernel, picture, &images, deadline).map_err(not_run)?;
        self.judge(picture, &golden, "interpreter, f32", &painted, self.bless)?;
        if let Some(device) = device {
            for (runner, painted) in device.draw(self.kernel, picture, &images).map_err(not_run)? {
                self.judge(picture, &golden, &runner, &painted, false)?;
            }
        }
        Ok(())
    }

    /// Reads and draws the textures of a picture.
    pub fn make_images(&self, picture: &TestPicture, deadline: Instant) -> Result<Vec<(String, Drawn)>, Box<Failure>> {
        let mut images = Vec::new();
        for image in &picture.images {
            let made = match &image.source {
                ImageSource::File { name, span, data } => {
                    let read = self.path_of(name).and_then(|path| read_drawn(&path, *data));
                    read.map_err(|error| self.unusable(*span, error, "name a PNG that is there"))?
                }
                ImageSource::Drawn(drawn) => {
                    let kernel = self.file.compile_picture(&self.kernel.test, drawn, self.settings);
                    let kernel = kernel.map_err(Failure::from_errors)?;
                    // It reads those that are made already.
                    let painted = interpret_picture::<f32>(&kernel, drawn, &images, deadline);
                    let painted = painted.map_err(|error| report_not_run(&kernel, &error))?;
                    if let Some((at, violation)) = &painted.violation {
                        return Err(report_pixel(&kernel, "interpreter, f32", *at, violation).into());
                    }
                    painted.drawn
                }
            };
            images.push((image.name.clone(), made));
        }
        Ok(images)
    }

    /// Compares what a runner has drawn.
    fn judge(
        &self,
        picture: &TestPicture,
        golden: &Path,
        runner: &str,
        painted: &Painted,
        bless: bool,
    ) -> Result<(), Box<Failure>> {
        if let Some((at, violation)) = &painted.violation {
            return Err(report_pixel(self.kernel, runner, *at, violation).into());
        }
        let compared = compare_with_file(golden, &painted.drawn, picture.likeness, bless);
        compared.map_err(|mismatch| self.report(picture.span, runner, &mismatch).into())
    }

    fn report(&self, span: Span, runner: &str, mismatch: &Mismatch) -> Failure {
        let path = &self.kernel.test.path;
        let bless = format!(
            "`straightline test {} {path} --bless`",
            shorten(&self.path.display().to_string())
        );
        let (difference, files) = match mismatch {
            Mismatch::Differs { difference, files, .. } => (difference, files),
            Mismatch::Missing(_) => {
                let help = format!("write it by {bless}, and look at it");
                return self.unusable(span, mismatch.to_string(), &help);
            }
            Mismatch::Size { .. } => {
                let help = format!("write the size of the file, or write it anew by {bless}");
                return self.unusable(span, mismatch.to_string(), &help);
            }
            Mismatch::Unusable(text) => {
                return self.unusable(span, text.clone(), "write it anew: remove the file, and add `--bless`");
            }
        };
        let [actual, marked] = files.each_ref().map(|path| path.display().to_string());
        let error = Diagnostic::error_at(
            Code::Assertion,
            span,
            format!("`{path}` draws another picture by the {runner}"),
        );
        let error = error
            .label(mismatch.to_string())
            .note(format!("the picture is in `{actual}`, the difference in `{marked}`"))
            .help(format!("if it is right, write the golden file by {bless}"));
        Failure {
            runner: Some(runner.to_owned()),
            inputs: pixel_inputs(difference.worst),
            values: difference.bytes.map(|bytes| Some(format!("{bytes:?}"))),
            psnr: Some(difference.psnr),
            ..self.failure(error)
        }
    }

    /// The error of a file that cannot be used.
    fn unusable(&self, span: Span, error: String, help: &str) -> Failure {
        self.failure(
            Diagnostic::error_at(Code::UnreadableFile, span, error)
                .label("of this picture")
                .help(help),
        )
    }

    fn failure(&self, error: Diagnostic) -> Failure {
        Failure::from_errors(Errors::new(vec![error], &self.kernel.files))
    }

    /// Path of a picture beside the kernel's file.
    fn path_of(&self, name: &str) -> Result<PathBuf, String> {
        picture_path(self.path.parent().unwrap_or(Path::new("")), name)
    }
}

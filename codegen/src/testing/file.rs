//! The tests of a file, and their kernels.

use crate::compiled::Compiled;
use crate::kernel::{Kernel, deep, read_source};
use crate::spec::Settings;
use std::path::Path;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Errors, File};
use straightline_evaluator::front::testing::{Site, Test, TestPicture, list_probes, list_tests};
use straightline_evaluator::policy::Unroll;

/// A kernel's file with its tests.
#[derive(Clone, Debug)]
pub struct TestFile {
    /// The file, then those that it calls functions of.
    pub files: Arc<Vec<File>>,
    /// The tests in order.
    pub tests: Vec<Test>,
    /// Assertions of all files.
    sites: Arc<Vec<Site>>,
}

/// The kernel of a test.
#[derive(Debug)]
pub struct TestKernel {
    /// The kernel.
    pub compiled: Compiled,
    /// The test.
    pub test: Test,
    /// Assertions of all files.
    pub sites: Arc<Vec<Site>>,
    /// The files.
    pub files: Arc<Vec<File>>,
    /// Number of probes in it.
    pub(super) probes: usize,
}

impl TestFile {
    /// Finds the tests of a text. `path` is only shown.
    ///
    /// # Errors
    ///
    /// If the text is not Rust.
    pub fn from_text(path: &str, text: &str) -> Result<TestFile, Errors> {
        TestFile::from_files(vec![File {
            path: path.to_owned(),
            text: text.to_owned(),
        }])
    }

    /// Finds the tests of a file, which calls functions of `sources`.
    ///
    /// # Errors
    ///
    /// If a file cannot be read or is not Rust.
    pub fn read<'p>(path: &'p Path, sources: impl IntoIterator<Item = &'p Path>) -> Result<TestFile, Errors> {
        let read = |path: &Path| {
            Ok(File {
                path: path.display().to_string(),
                text: read_source(path)?,
            })
        };
        let all = std::iter::once(path).chain(sources);
        TestFile::from_files(all.map(read).collect::<Result<_, Errors>>()?)
    }

    fn from_files(files: Vec<File>) -> Result<TestFile, Errors> {
        let files = Arc::new(files);
        let found = deep(|| list_tests(&files))?;
        Ok(TestFile {
            tests: found.tests,
            sites: Arc::new(found.sites),
            files,
        })
    }

    /// Compiles the kernel of a test.
    ///
    /// # Errors
    ///
    /// If no kernel can be made of the test, or as of [`Kernel::compile`].
    pub fn compile(&self, test: &Test) -> Result<TestKernel, Errors> {
        self.compile_with(test, &Settings::default())
    }

    /// Compiles the kernel of another picture of a test, one that the test reads.
    ///
    /// # Errors
    ///
    /// As of [`TestFile::compile`].
    pub fn compile_picture(
        &self,
        test: &Test,
        picture: &TestPicture,
        settings: &Settings,
    ) -> Result<TestKernel, Errors> {
        let picture = Some(picture.clone());
        self.compile_with(
            &Test {
                picture,
                ..test.clone()
            },
            settings,
        )
    }

    /// Compiles the kernel of a test, or of another picture of it, with probes that count what it executes. Loops stay in the
    /// shader where they can.
    ///
    /// # Errors
    ///
    /// As of [`TestFile::compile`].
    pub fn compile_covered(
        &self,
        test: &Test,
        picture: Option<&TestPicture>,
        settings: &Settings,
    ) -> Result<TestKernel, Errors> {
        let covered = Test {
            covered: true,
            picture: picture.cloned(),
            ..test.clone()
        };
        self.compile_with(&covered, &settings.clone().unroll(Unroll::None))
    }

    /// As [`TestFile::compile`], with settings.
    ///
    /// # Errors
    ///
    /// As of [`TestFile::compile`].
    pub fn compile_with(&self, test: &Test, settings: &Settings) -> Result<TestKernel, Errors> {
        if !test.errors.is_empty() {
            return Err(Errors::new(test.errors.clone(), &self.files));
        }
        let probes = match test.covered {
            true => deep(|| list_probes(&self.files))?.len(),
            false => 0,
        };
        let compiled = Kernel::from_test(&self.files, test).compile(settings)?;
        Ok(TestKernel {
            compiled,
            test: test.clone(),
            sites: Arc::clone(&self.sites),
            files: Arc::clone(&self.files),
            probes,
        })
    }
}

//! Coverage: how often tests execute each function, line and branch of the kernel's files.
//!
//! The kernel of a test is compiled once more with probes, and run by the interpreter ([`probes`]).
//!
//! [`probes`]: straightline_evaluator::front::testing::Probe

use super::file::{TestFile, TestKernel};
use super::picture::run_picture;
use super::run::{Contents, RunnerError, buffers_after};
use crate::kernel::deep;
use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::sync::Arc;
use std::time::Instant;
use straightline_evaluator::diagnostic::{Errors, File};
use straightline_evaluator::front::testing::{COUNTS, Probe, ProbeKind, TestPicture, list_probes};
use straightline_kernels::pictures::Drawn;
use straightline_kernels::properties::Case;

/// Executions of a kernel's files.
#[derive(Clone, Debug)]
pub struct Coverage {
    files: Arc<Vec<File>>,
    probes: Vec<Probe>,
    /// Executions by probe.
    counts: Vec<u64>,
}

/// Coverage of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FileCoverage {
    /// Path of the file, as it was given.
    pub path: String,
    /// Functions with their line and executions, in order.
    pub functions: Vec<(String, u32, u64)>,
    /// Executions by line, of the lines in which a function, a statement or the body of a closure begins.
    pub lines: BTreeMap<u32, u64>,
    /// Branches and loops in order.
    pub branches: Vec<Branch>,
}

/// Sides of a branch, or the body of a loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Branch {
    /// Line of the branch or loop.
    pub line: u32,
    /// Executions of each side; `None` if the branch was never reached.
    pub sides: Vec<Option<u64>>,
}

impl Coverage {
    /// Nothing is executed yet.
    ///
    /// # Errors
    ///
    /// If a file is not Rust.
    pub fn new(file: &TestFile) -> Result<Coverage, Errors> {
        let probes = deep(|| list_probes(&file.files))?;
        Ok(Coverage {
            files: Arc::clone(&file.files),
            counts: vec![0; probes.len()],
            probes,
        })
    }

    /// Adds the executions of a test, by probe.
    pub fn add(&mut self, counts: &[u64]) {
        for (sum, count) in self.counts.iter_mut().zip(counts) {
            *sum += count;
        }
    }

    /// Coverage by file. Files without functions, but those of tests, are left out.
    pub fn by_file(&self) -> Vec<FileCoverage> {
        let all = self
            .files
            .iter()
            .zip(0..)
            .map(|(file, index)| self.cover_file(&file.path, index));
        all.filter(|covered| !covered.functions.is_empty()).collect()
    }

    fn cover_file(&self, path: &str, file: u32) -> FileCoverage {
        let mut covered = FileCoverage {
            path: path.to_owned(),
            ..FileCoverage::default()
        };
        let mut branches: BTreeMap<u32, (u32, Vec<u64>)> = BTreeMap::new();
        for (probe, count) in self.probes.iter().zip(&self.counts) {
            if probe.span.file != file {
                continue;
            }
            let line = probe.span.line;
            match &probe.kind {
                ProbeKind::Side { branch, .. } => {
                    branches.entry(*branch).or_insert((line, Vec::new())).1.push(*count);
                    continue;
                }
                ProbeKind::Function(name) => covered.functions.push((name.clone(), line, *count)),
                ProbeKind::Statement => {}
            }
            let most = covered.lines.entry(line).or_default();
            *most = (*most).max(*count);
        }
        for (line, counts) in branches.into_values() {
            let runs = covered.lines.get(&line).is_some_and(|runs| *runs > 0);
            let reached = runs || counts.iter().any(|count| *count > 0);
            covered.branches.push(Branch {
                line,
                sides: counts.into_iter().map(|count| reached.then_some(count)).collect(),
            });
        }
        covered
    }

    /// The coverage in the format of LCOV, as of geninfo(1).
    pub fn to_lcov(&self) -> String {
        let mut text = String::new();
        for file in self.by_file() {
            file.write_lcov(&mut text);
        }
        text
    }
}

/// Counts what the cases of a test execute, by probe. The kernel is of [`TestFile::compile_covered`].
///
/// # Errors
///
/// As of [`interpret_cases`](super::interpret_cases).
pub fn cover_cases(kernel: &TestKernel, cases: &[Case], deadline: Instant) -> Result<Vec<u64>, RunnerError> {
    buffers_after::<f32>(kernel, cases, deadline).map(|contents| read_counts(&contents))
}

/// Counts what the picture of a test executes, by probe. The kernel is of [`TestFile::compile_covered`].
///
/// # Errors
///
/// As of [`interpret_picture`](super::interpret_picture).
pub fn cover_picture(
    kernel: &TestKernel,
    picture: &TestPicture,
    images: &[(String, Drawn)],
    deadline: Instant,
) -> Result<Vec<u64>, RunnerError> {
    run_picture::<f32>(kernel, picture, images, deadline).map(|(contents, _)| read_counts(&contents))
}

fn read_counts(contents: &Contents) -> Vec<u64> {
    let counts = contents.iter().find(|(name, _)| name == COUNTS);
    let counts = counts.map_or(&[][..], |(_, counts)| counts);
    counts.iter().map(|count| count[0] as u64).collect()
}

impl FileCoverage {
    fn write_lcov(&self, text: &mut String) {
        let _ = writeln!(text, "TN:\nSF:{}", self.path);
        for (name, line, _) in &self.functions {
            let _ = writeln!(text, "FN:{line},{name}");
        }
        for (name, _, count) in &self.functions {
            let _ = writeln!(text, "FNDA:{count},{name}");
        }
        let [functions, lines, branches] = self.totals();
        let _ = writeln!(text, "FNF:{}\nFNH:{}", functions.1, functions.0);
        for (number, branch) in self.branches.iter().enumerate() {
            for (side, count) in branch.sides.iter().enumerate() {
                let taken = count.map_or("-".to_owned(), |count| count.to_string());
                let _ = writeln!(text, "BRDA:{},{number},{side},{taken}", branch.line);
            }
        }
        let _ = writeln!(text, "BRF:{}\nBRH:{}", branches.1, branches.0);
        for (line, count) in &self.lines {
            let _ = writeln!(text, "DA:{line},{count}");
        }
        let _ = writeln!(text, "LF:{}\nLH:{}\nend_of_record", lines.1, lines.0);
    }

    /// Executed and all functions, lines, and sides of branches.
    pub fn totals(&self) -> [(usize, usize); 3] {
        let of = |counts: &mut dyn Iterator<Item = bool>| {
            counts.fold((0, 0), |(hit, all), runs| (hit + usize::from(runs), all + 1))
        };
        let sides = self.branches.iter().flat_map(|branch| &branch.sides);
        [
            of(&mut self.functions.iter().map(|(.., count)| *count > 0)),
            of(&mut self.lines.values().map(|count| *count > 0)),
            of(&mut sides.map(|count| count.is_some_and(|count| count > 0))),
        ]
    }

    /// Ranges of lines that were not executed, without an executed line between.
    pub fn missing_lines(&self) -> Vec<[u32; 2]> {
        let mut ranges: Vec<[u32; 2]> = Vec::new();
        let mut open = false;
        for (line, count) in &self.lines {
            match (ranges.last_mut(), count) {
                (Some(range), 0) if open => range[1] = *line,
                (_, 0) => ranges.push([*line; 2]),
                _ => {}
            }
            open = *count == 0;
        }
        ranges
    }
}

impl fmt::Display for FileCoverage {
    /// `src/lens.rs  18.2 % of lines, 0 of 1 branches; not run: 6-16`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [_, lines, branches] = self.totals();
        let share = 100.0 * lines.0 as f64 / lines.1.max(1) as f64;
        write!(
            f,
            "{}  {share:.1} % of lines, {} of {} branches",
            self.path, branches.0, branches.1
        )?;
        let ranges = self
            .missing_lines()
            .into_iter()
            .map(|[first, last]| match first == last {
                true => first.to_string(),
                false => format!("{first}-{last}"),
            });
        let ranges: Vec<String> = ranges.collect();
        match ranges.is_empty() {
            true => Ok(()),
            false => write!(f, "; not run: {}", ranges.join(", ")),
        }
    }
}

//! Shaders of a record that are emitted otherwise now. Comments of the text count, too.

use crate::loops::forms::{Forms, emit_options};
use crate::loops::{Subject, list_subjects};
use crate::record::{FormKind, LoopsRecord, Record, RecordError, SweepRecord};
use crate::steps::Step;
use crate::sweep::{Axis, Variant};
use std::collections::BTreeMap;
use std::path::Path;
use straightline_codegen::Kernel;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::emit::Target;
use straightline_manifest::hash_of_text;

/// Shaders of a record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// Number of shaders whose hash is in the record.
    pub hashed: usize,
    /// Number of those that have another hash now, or cannot be emitted.
    pub changed: usize,
}

impl Changes {
    fn count(&mut self, hash: &str, now: Option<String>) {
        self.hashed += 1;
        self.changed += usize::from(now.as_deref() != Some(hash));
    }

    /// Emits the shaders of a step's record again. `None` for a study whose records have no hashes. Kernels are read below
    /// `root`, which is that of a checkout.
    ///
    /// # Errors
    ///
    /// If the record cannot be read.
    pub fn since_record(step: &Step, root: &Path, record: &Path) -> Result<Option<Changes>, RecordError> {
        let kernel = |text: &str| read_kernel(root, text);
        Ok(match step.study() {
            "sweep" => {
                let record = SweepRecord::read(record)?;
                let kernel = step.arguments.get(2).map(|text| kernel(text));
                Some(Changes::since_sweep(kernel.and_then(Result::ok).as_ref(), &record))
            }
            "loops" => {
                let words = step.arguments.windows(2).filter(|pair| pair[0] == "--from");
                let from = words.filter_map(|pair| kernel(&pair[1]).ok());
                let own: Vec<Subject> = from.map(|kernel| Subject::from_kernel(kernel, None)).collect();
                let subjects = match own.is_empty() {
                    true => list_subjects(step.arguments.iter().any(|word| word == "--quick")).unwrap_or_default(),
                    false => own,
                };
                Some(Changes::since_loops(&subjects, &LoopsRecord::read(record)?))
            }
            _ => None,
        })
    }

    /// Emits the shaders of a sweep again, without the hand-written ones.
    pub fn since_sweep(kernel: Option<&Kernel>, record: &SweepRecord) -> Changes {
        let mut changes = Changes::default();
        for swept in record.variants.iter().filter(|swept| swept.rival.is_none()) {
            let Some(measured) = &swept.measured else { continue };
            let emit = |kernel: &Kernel| Changes::hash_of_variant(kernel, &record.axes, &swept.settings).ok();
            changes.count(&measured.hash, kernel.and_then(emit));
        }
        changes
    }

    /// Emits a variant of a sweep, and returns the hash of its WGSL.
    ///
    /// # Errors
    ///
    /// The reason why there is no such shader.
    pub fn hash_of_variant(
        kernel: &Kernel,
        axes: &[Axis],
        settings: &BTreeMap<String, String>,
    ) -> Result<String, String> {
        let variant = Variant::from_settings(kernel, axes, settings)?;
        let compiled = variant.spec()?.compile(kernel);
        let emitted = variant.emit(&compiled.map_err(|errors| errors.first_message().to_owned())?)?;
        let wgsl = emitted.files.get(&Target::Wgsl).ok_or("there is no WGSL")?;
        Ok(hash_of_text(&String::from_utf8_lossy(wgsl)))
    }

    /// Emits the forms of kernels again.
    pub fn since_loops(subjects: &[Subject], record: &LoopsRecord) -> Changes {
        let mut changes = Changes::default();
        for kernel in &record.kernels {
            if kernel.forms.iter().all(|form| form.hash.is_none()) {
                continue;
            }
            let subject = subjects.iter().find(|subject| subject.name == kernel.kernel);
            let half = kernel.form(FormKind::FullHalf).is_some();
            let forms = subject.and_then(|subject| Forms::from_subject(subject, half).ok());
            for form in &kernel.forms {
                let emit = |forms: &Forms| {
                    let (_, compiled) = forms.made.iter().find(|(kind, _)| *kind == form.kind)?;
                    let emitted = compiled.emit(&emit_options(form.kind)).ok()?;
                    emitted.manifest.hashes.get("wgsl").cloned()
                };
                if let Some(hash) = &form.hash {
                    changes.count(hash, forms.as_ref().and_then(emit));
                }
            }
        }
        changes
    }
}

/// Reads a kernel as the command line does from `root`: comments of its shaders have the path as given.
fn read_kernel(root: &Path, text: &str) -> Result<Kernel, Errors> {
    let Some((path, _)) = text.split_once(".rs") else {
        return Kernel::from_argument(text);
    };
    let read = Kernel::from_argument(&root.join(text).display().to_string())?;
    let source = read.files().first().map_or("", |file| &file.text);
    Ok(Kernel::from_text(&format!("{path}.rs"), source, read.name()))
}

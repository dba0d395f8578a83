//! A shader with its candidates: other texts that compute the same, of which a program chooses one on the device.

use super::error::{Error, Problem};
use super::shader::{BuiltShader, build_shader};
use super::variants::identity;
use crate::emit;
use crate::kernel::Kernel;
use crate::spec::{Candidates, KernelConfig};
use std::collections::BTreeMap;
use straightline_manifest::Form;
use straightline_manifest::plan::Plan;

/// A shader and its candidates, ready to be written.
pub(super) struct BuiltCandidates {
    /// Shaders that differ; the first one has the kernel's own settings and name.
    shaders: Vec<BuiltShader>,
    /// Names of the candidates with the position of their shader.
    candidates: Vec<(String, usize)>,
}

/// Builds a shader and its candidates.
///
/// # Errors
///
/// The errors of each candidate, with its name, and candidates that cannot take each other's place.
pub(super) fn build_candidates(config: &KernelConfig, kernel: &Kernel, name: String) -> Result<BuiltCandidates, Error> {
    let refused = |why: String| Error::from_problem(Problem::Candidates(name.clone(), why));
    config.candidates.check().map_err(refused)?;
    if !config.variants.axes().is_empty() {
        return Err(refused(
            "it has variants, too: generate candidates of one of them".to_owned(),
        ));
    }
    let own = build_shader(&config.spec, kernel, name.clone()).map_err(Error::from_errors)?;
    let manifest = &own.emitted.manifest;
    if manifest.form == Form::Function || !manifest.varyings.is_empty() {
        let why =
            "only passes are timed, and this is a function or has interpolated values: leave `.candidate(..)` out";
        return Err(refused(why.to_owned()));
    }
    let plan = plan_of(&own);
    let mut set = BuiltCandidates {
        shaders: vec![own],
        candidates: vec![(Candidates::DEFAULT.to_owned(), 0)],
    };
    let mut problems = Vec::new();
    for candidate in config.candidates.iter() {
        let spec = candidate.apply(&config.spec);
        if spec.settings.options != config.spec.settings.options {
            let why = format!(
                "the candidate `{}` sets options, and candidates compute the same: use `.variants(..)`",
                candidate.name
            );
            problems.push(Problem::Candidates(name.clone(), why));
            continue;
        }
        match build_shader(&spec, kernel, format!("{name}_{}", candidate.name)) {
            Ok(shader) => match plan.find_interface_difference(&plan_of(&shader)) {
                None => set.add(&candidate.name, shader),
                Some(difference) => {
                    let why = format!("the candidate `{}` cannot take its place: {difference}", candidate.name);
                    problems.push(Problem::Candidates(name.clone(), why));
                }
            },
            Err(errors) => problems.push(Problem::Candidate(candidate.name.clone(), errors)),
        }
    }
    match problems.is_empty() {
        true => Ok(set),
        false => Err(Error { problems }),
    }
}

fn plan_of(shader: &BuiltShader) -> Plan {
    Plan::from_manifest(&shader.emitted.manifest).expect("the generator's own manifest")
}

impl BuiltCandidates {
    /// Adds a candidate, whose shader may be one that is there.
    fn add(&mut self, candidate: &str, shader: BuiltShader) {
        let of_new = identity(&shader);
        let known = self.shaders.iter().position(|own| identity(own) == of_new);
        let at = known.unwrap_or(self.shaders.len());
        if known.is_none() {
            self.shaders.push(shader);
        }
        self.candidates.push((candidate.to_owned(), at));
    }

    pub fn name(&self) -> &str {
        &self.shaders[0].name
    }

    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let shaders = self.shaders.iter();
        let mut files: BTreeMap<_, _> = shaders
            .flat_map(|shader| shader.emitted.named_files(&shader.name))
            .collect();
        files.insert(format!("{}.candidates.txt", self.name()), self.list().into_bytes());
        files
    }

    /// The candidates that are timed with the stems of their files, for `straightline choose`.
    fn list(&self) -> String {
        let mut text = format!("# candidates for {}\n", self.name());
        for (at, shader) in self.shaders.iter().enumerate() {
            let first = self.candidates.iter().find(|(_, of)| *of == at);
            let (name, _) = first.expect("each shader is some candidate's");
            text += &format!("{name} {}\n", shader.name);
        }
        text
    }

    pub fn bindings_module(&self) -> emit::CandidatesModule<'_> {
        let mut modules = self.shaders.iter().map(BuiltShader::bindings_module);
        emit::CandidatesModule {
            own: modules.next().expect("the kernel's own"),
            others: modules.collect(),
            candidates: &self.candidates,
        }
    }
}

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
    /// Shaders that differ with the names of their candidates; the first one has the kernel's own settings and name.
    shaders: Vec<(String, BuiltShader)>,
    /// Candidates with the text of another one, whose name follows.
    twins: Vec<(String, String)>,
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
        shaders: vec![(Candidates::DEFAULT.to_owned(), own)],
        twins: Vec::new(),
    };
    let mut problems = Vec::new();
    for candidate in config.candidates.iter() {
        let spec = candidate.apply(&config.spec);
        let (own, other) = (&config.spec.settings, &spec.settings);
        if (&own.options, &own.overrides) != (&other.options, &other.overrides) {
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
        match self.shaders.iter().find(|(_, known)| identity(known) == of_new) {
            Some((twin, _)) => self.twins.push((candidate.to_owned(), twin.clone())),
            None => self.shaders.push((candidate.to_owned(), shader)),
        }
    }

    pub fn name(&self) -> &str {
        &self.shaders[0].1.name
    }

    /// The files, with a list of the candidates and the stems of their files for `straightline choose`.
    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let mut list = format!("# candidates for {}\n", self.name());
        let mut files = BTreeMap::new();
        for (candidate, shader) in &self.shaders {
            list += &format!("{candidate} {}\n", shader.name);
            files.extend(shader.emitted.named_files(&shader.name));
        }
        files.insert(format!("{}.candidates.txt", self.name()), list.into_bytes());
        files
    }

    pub fn bindings_module(&self) -> emit::CandidatesModule<'_> {
        let shaders = self.shaders.iter();
        emit::CandidatesModule {
            shaders: shaders
                .map(|(candidate, shader)| (candidate.as_str(), shader.bindings_module()))
                .collect(),
            twins: &self.twins,
        }
    }
}

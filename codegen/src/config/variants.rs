//! A set of shaders of one kernel: one for each combination of option values, and those with the same text once.

use super::error::{Error, Problem};
use super::parallel::map_in_parallel;
use super::shader::{BuiltShader, build_shader};
use crate::emit::{self, Axis};
use crate::kernel::Kernel;
use crate::spec::KernelConfig;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use straightline_kernels::OptionText;
use straightline_manifest::plan::Plan;

/// A set of shaders ready to be written.
pub(super) struct BuiltVariants {
    pub name: String,
    axes: Vec<Axis>,
    /// Shaders that differ. Each has the set's name, followed by the values of its first combination.
    shaders: Vec<BuiltShader>,
    /// Combinations with the position of their shader.
    combinations: Vec<(Vec<OptionText>, usize)>,
}

/// Builds the shaders of all combinations.
///
/// # Errors
///
/// Each different error once, with the first combination that has it.
pub(super) fn build_variants(config: &KernelConfig, kernel: &Kernel, name: String) -> Result<BuiltVariants, Error> {
    let variants = &config.variants;
    let checked = variants.check(&config.spec.settings.options);
    checked.map_err(|why| Error::from_problem(Problem::Variants(name.clone(), why)))?;
    let mut set = BuiltVariants {
        axes: variants
            .axes()
            .iter()
            .map(|axis| Axis::new(&axis.option, &axis.values))
            .collect(),
        name,
        shaders: Vec::new(),
        combinations: Vec::new(),
    };
    let (mut known, mut stems) = (BTreeMap::new(), BTreeSet::new());
    let (mut said, mut problems) = (BTreeSet::new(), Vec::new());
    let combinations = variants.combinations().into_iter().map(|options| {
        let stem = unique_stem(&set.name, &options, &mut stems);
        (options, stem)
    });
    let combinations: Vec<_> = combinations.collect();
    let built = map_in_parallel(&combinations, |(options, stem)| {
        let mut spec = config.spec.clone();
        spec.settings = spec.settings.set_all(options.iter().cloned());
        build_shader(&spec, kernel, stem.clone())
    });
    for ((options, _), result) in combinations.into_iter().zip(built) {
        match result {
            Ok(shader) => {
                let at = *known.entry(identity(&shader)).or_insert(set.shaders.len());
                if at == set.shaders.len() {
                    set.shaders.push(shader);
                }
                set.combinations.push((options, at));
            }
            Err(errors) if said.insert(errors.to_string()) => {
                problems.push(Problem::Variant(combination_text(&options), errors));
            }
            Err(_) => {}
        }
    }
    match problems.is_empty() {
        true => Ok(set),
        false => Err(Error { problems }),
    }
}

/// Text of a shader without the comment at its head, which names the options, and its bindings: shaders that are equal in both
/// are one.
pub(super) fn identity(shader: &BuiltShader) -> (String, String) {
    let text = shader.emitted.wgsl();
    let code = text.lines().skip_while(|line| line.starts_with("//"));
    let plan = Plan::from_manifest(&shader.emitted.manifest);
    (code.collect::<Vec<_>>().join("\n"), format!("{plan:?}"))
}

/// Stem of a combination's files: the set's name and the values, `sraa_latin4_branch`.
fn unique_stem(name: &str, options: &[OptionText], taken: &mut BTreeSet<String>) -> String {
    let values = options.iter().map(|(_, value)| emit::value_words(value).join("_"));
    let stem = std::iter::once(name.to_owned())
        .chain(values)
        .collect::<Vec<_>>()
        .join("_");
    let numbered = (2..).map(|n| format!("{stem}_{n}"));
    let mut stems = std::iter::once(stem.clone()).chain(numbered);
    stems
        .find(|stem| taken.insert(stem.clone()))
        .expect("some number is free")
}

/// Options of a combination as `--set` takes them.
fn combination_text(options: &[OptionText]) -> String {
    let texts = options.iter().map(|(name, value)| format!("{name}={value}"));
    texts.collect::<Vec<_>>().join(" ")
}

impl BuiltVariants {
    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let shaders = self.shaders.iter();
        let mut files: BTreeMap<_, _> = shaders.flat_map(|s| s.emitted.named_files(&s.name)).collect();
        files.insert(format!("{}.variants.txt", self.name), self.table().into_bytes());
        files
    }

    pub fn bindings_module(&self) -> emit::VariantsModule<'_> {
        emit::VariantsModule {
            name: &self.name,
            axes: &self.axes,
            shaders: self.shaders.iter().map(BuiltShader::bindings_module).collect(),
            shader_of: self.combinations.iter().map(|(_, at)| *at).collect(),
        }
    }

    /// Table of the combinations with the size of their shaders.
    fn table(&self) -> String {
        let rows = self.combinations.iter().map(|(options, at)| {
            let shader = &self.shaders[*at];
            (
                combination_text(options),
                &shader.name,
                shader.emitted.wgsl().len(),
                &shader.emitted.manifest.counts,
            )
        });
        let rows: Vec<_> = rows.collect();
        let wide = |of: &dyn Fn(usize) -> usize, head: &str| (0..rows.len()).map(of).fold(head.len(), usize::max);
        let (options, shaders) = (
            wide(&|k| rows[k].0.len(), "options"),
            wide(&|k| rows[k].1.len(), "shader"),
        );
        let bytes: usize = self.shaders.iter().map(|shader| shader.emitted.wgsl().len()).sum();
        let mut text = format!(
            "{}: {} combinations, {} shaders, {bytes} bytes\n\n{:options$}  {:shaders$}  {:>7}  {:>10}  {:>5}\n",
            self.name,
            self.combinations.len(),
            self.shaders.len(),
            "options",
            "shader",
            "bytes",
            "statements",
            "reads",
        );
        for (combination, shader, bytes, counts) in &rows {
            let (statements, reads) = (counts.statements, counts.texture_reads + counts.colour_reads);
            writeln!(
                text,
                "{combination:options$}  {shader:shaders$}  {bytes:>7}  {statements:>10}  {reads:>5}"
            )
            .expect("a text takes all");
        }
        text
    }
}

//! Compiling the passes of a chain: each kernel once, with the pictures that it computes in place.

use super::cascades::Grouping;
use super::compiled::{CompiledChain, CompiledPass, SharedPass};
use super::failures::Failures;
use super::fusion::{self, Decision};
use super::planned::{Pass, Planned, Shared};
use super::spec::ChainSpec;
use crate::compiled::Compiled;
use crate::kernel::Kernel;
use crate::pipeline::{Start, first_sentence};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors, File};
use straightline_evaluator::front::chain::{self as front, Chain, ReadChain, Source};
use straightline_evaluator::ir::Texture;
use straightline_evaluator::passes::{self, Drawn};
use straightline_manifest::Format;
use straightline_manifest::chain::SizeRule;

/// Compiles the kernels of a chain's passes.
pub(super) fn compile_passes(
    files: &Arc<Vec<File>>,
    read: ReadChain,
    spec: &ChainSpec,
) -> Result<CompiledChain, Errors> {
    let chain = &read.chain;
    let compiler = Compiler {
        files,
        read: &read,
        chain,
        spec,
    };
    let starts = compiler.evaluate_all()?;
    let sized = compiler.input_textures(&starts);
    let decision =
        fusion::decide(chain, &starts, &sized, &spec.fuse).map_err(|error| Errors::new(vec![*error], files))?;
    let planned = compiler.plan_passes(&starts, &decision, &sized)?;
    let planned = compiler.share_passes(planned, &starts, &sized)?;
    let kernels = compiler.compile_all(&planned.passes)?;
    let mut stored: Vec<usize> = planned.passes.iter().flat_map(|pass| pass.pictures.clone()).collect();
    stored.sort_unstable();
    let moved = |picture: usize| {
        stored
            .iter()
            .position(|index| *index == picture)
            .expect("a stored picture")
    };
    let mut passes: Vec<CompiledPass> = planned
        .passes
        .into_iter()
        .map(|pass| CompiledPass {
            format: pass.format,
            shader: pass.kernel.clone(),
            kernel: pass.kernel,
            draws: pass.pictures.into_iter().map(moved).collect(),
            reads: pass
                .reads
                .into_iter()
                .map(|(name, source)| match source {
                    Source::Picture(index) => (name, Source::Picture(moved(index))),
                    input => (name, input),
                })
                .collect(),
        })
        .collect();
    name_shaders(&mut passes);
    let named = |index: usize| chain.pictures[index].name.clone();
    Ok(CompiledChain {
        fused: (0..chain.pictures.len())
            .filter(|k| decision.fused[*k])
            .map(named)
            .collect(),
        shared: planned.shared,
        kept: decision
            .kept
            .into_iter()
            .chain(planned.kept)
            .map(|kept| (named(kept.picture), kept.reason))
            .collect(),
        results: chain.results.iter().map(|index| moved(*index)).collect(),
        pictures: stored.iter().map(|index| chain.pictures[*index].clone()).collect(),
        name: chain.name.clone(),
        changed: Vec::new(),
        summary: first_sentence(&chain.docs),
        inputs: chain.inputs.clone(),
        passes,
        kernels,
        spec: spec.clone(),
        files: Arc::clone(files),
        span: chain.span,
    })
}

struct Compiler<'c> {
    files: &'c Arc<Vec<File>>,
    read: &'c ReadChain,
    chain: &'c Chain,
    spec: &'c ChainSpec,
}

impl Compiler<'_> {
    fn kernel(&self, entry: &str) -> Result<Kernel, Errors> {
        Kernel::from_pass(self.files, entry, self.read.parse_pass(entry)?)
    }

    /// Description of the shaders of a kernel: one without options takes no settings of them.
    fn settings(&self, entry: &str) -> crate::spec::Settings {
        let mut settings = self.spec.shader.dispatched_settings();
        let has_options = self
            .chain
            .passes
            .iter()
            .any(|pass| pass.entry == entry && pass.has_options);
        if !has_options {
            settings.options.clear();
            settings.overrides.clear();
        }
        settings
    }

    /// Evaluates every kernel once. All errors of all passes are reported.
    fn evaluate_all(&self) -> Result<BTreeMap<String, Start>, Errors> {
        let mut failures = Failures::default();
        let mut starts = BTreeMap::new();
        for pass in &self.chain.passes {
            if !starts.contains_key(&pass.entry) && !failures.entries.contains(&pass.entry) {
                let evaluate = |kernel: Kernel| kernel.evaluate(&self.settings(&pass.entry));
                match self.kernel(&pass.entry).and_then(evaluate) {
                    Ok(start) => {
                        starts.insert(pass.entry.clone(), start);
                    }
                    Err(errors) => failures.add(&pass.entry, errors),
                }
            }
        }
        failures.none(self.files).map(|()| starts)
    }

    /// Inputs of the chain that passes read as textures.
    fn input_textures(&self, starts: &BTreeMap<String, Start>) -> Vec<Texture> {
        let mut found: Vec<Texture> = Vec::new();
        for pass in &self.chain.passes {
            for texture in &self.renamed(&starts[&pass.entry], pass).graph.textures {
                let is_new = found.iter().all(|known| known.name != texture.name);
                if is_new && self.chain.inputs.contains(&texture.name) {
                    found.push(texture.clone());
                }
            }
        }
        found
    }

    /// Lists the passes that are stored, with what they compute in place.
    fn plan_passes(
        &self,
        starts: &BTreeMap<String, Start>,
        decision: &Decision,
        sized: &[Texture],
    ) -> Result<Vec<Planned>, Errors> {
        let mut fused: Vec<Option<Start>> = Vec::new();
        let mut planned: Vec<Planned> = Vec::new();
        for (index, pass) in self.chain.passes.iter().enumerate() {
            let in_place = |source: &Source| matches!(source, Source::Picture(k) if decision.fused[*k]);
            let has_fused = pass.reads.iter().any(|(_, source)| in_place(source));
            if !decision.fused[index] && !has_fused {
                fused.push(None);
                planned.push(Planned {
                    picture: index,
                    kernel: pass.entry.clone(),
                    entry: pass.entry.clone(),
                    fused: None,
                    reads: pass.reads.clone(),
                });
                continue;
            }
            let start = self.fuse_pass(&starts[&pass.entry], index, decision, (&fused, sized))?;
            if !decision.fused[index] {
                let reads = self.reads_of(&start, &|picture| decision.fused[picture]);
                // Other passes may have the kernel without the fused pictures.
                let others = self
                    .chain
                    .passes
                    .iter()
                    .enumerate()
                    .filter(|(other, _)| *other != index);
                let taken: Vec<&str> = planned.iter().map(|other| other.kernel.as_str()).collect();
                let kernel = unused_kernel(&pass.entry, |name| {
                    taken.contains(&name) || others.clone().any(|(_, other)| other.entry == name)
                });
                planned.push(Planned {
                    picture: index,
                    kernel,
                    entry: pass.entry.clone(),
                    fused: Some(start.clone()),
                    reads,
                });
            }
            fused.push(Some(start));
        }
        Ok(planned)
    }

    /// Merges passes whose workgroups can compute a picture after another.
    fn share_passes(
        &self,
        planned: Vec<Planned>,
        starts: &BTreeMap<String, Start>,
        sized: &[Texture],
    ) -> Result<Shared, Errors> {
        let kernels = planned.iter().map(|pass| match &pass.fused {
            Some(start) => start.clone(),
            None => self.renamed(&starts[&pass.entry], &self.chain.passes[pass.picture]),
        });
        let kernels: Vec<Start> = kernels.collect();
        let grouping = Grouping {
            chain: self.chain,
            spec: self.spec,
            planned: &planned,
            starts: &kernels,
            sized,
        };
        let (mut groups, kept) = grouping
            .group()
            .map_err(|error| Errors::new(vec![*error], self.files))?;
        groups.sort_by_key(|group| group.members.last().copied());
        let (mut passes, mut shared): (Vec<Pass>, Vec<SharedPass>) = (Vec::new(), Vec::new());
        for group in groups {
            let last = *group.members.last().expect("groups have members");
            let of = planned[last].clone();
            let Some(cascade) = group.cascade else {
                passes.push(Pass {
                    pictures: vec![of.picture],
                    format: grouping.format_of(last),
                    kernel: of.kernel,
                    entry: of.entry,
                    changed: of.fused,
                    reads: of.reads,
                });
                continue;
            };
            let parts = grouping.parts(&group.members);
            let graph = passes::compute_cascade(&parts, sized, &cascade).map_err(|reason| {
                let picture = &self.chain.pictures[of.picture];
                Errors::new(vec![*fusion::unfit(picture, &reason.to_string())], self.files)
            })?;
            let half = group
                .members
                .iter()
                .flat_map(|member| kernels[*member].half.iter().cloned());
            let start = Start {
                graph,
                half: half.collect(),
            };
            let is_member = |picture: usize| group.members.iter().any(|member| planned[*member].picture == picture);
            let kernel = unused_kernel(&format!("{}_cascade", of.entry), |name| {
                passes.iter().any(|pass| pass.kernel == name) || planned.iter().any(|pass| pass.entry == name)
            });
            let stored = group.members.iter().zip(&parts).filter(|(_, part)| part.stored);
            let stored: Vec<usize> = stored.map(|(member, _)| *member).collect();
            passes.push(Pass {
                pictures: stored.iter().map(|member| planned[*member].picture).collect(),
                format: grouping.format_of(stored.first().copied().unwrap_or(last)),
                kernel: kernel.clone(),
                entry: of.entry,
                reads: self.reads_of(&start, &is_member),
                changed: Some(start),
            });
            shared.push(SharedPass { kernel, cascade });
        }
        Ok(Shared { passes, shared, kept })
    }

    /// The kernel of a pass with the pictures in it that are computed in place. Its textures are called after what they hold.
    fn fuse_pass(
        &self,
        start: &Start,
        index: usize,
        decision: &Decision,
        (fused, sized): (&[Option<Start>], &[Texture]),
    ) -> Result<Start, Errors> {
        let pass = &self.chain.passes[index];
        let mut start = self.renamed(start, pass);
        let size = &self.chain.pictures[index].size;
        for (_, source) in &pass.reads {
            let Source::Picture(read) = source else {
                continue;
            };
            let (true, Some(producer)) = (decision.fused[*read], &fused[*read]) else {
                continue;
            };
            let picture = &self.chain.pictures[*read];
            let drawn = Drawn {
                name: &picture.name,
                graph: &producer.graph,
                size: Some(&picture.size).filter(|of| *of != size),
                sized,
            };
            start.graph = passes::fuse_picture(&start.graph, &drawn).map_err(|reason| {
                let what = format!("the picture `{}` cannot be fused: {reason}", picture.name);
                let error = Diagnostic::error_at(Code::UnfitSetting, picture.span, what)
                    .label("drawn here")
                    .help("store it: leave it out of `--fuse`");
                Errors::new(vec![error], self.files)
            })?;
            start.half.extend(producer.half.iter().cloned());
        }
        Ok(start)
    }

    /// The kernel with its resources called as the inputs and pictures of the chain are.
    fn renamed(&self, start: &Start, pass: &front::Pass) -> Start {
        let mut start = start.clone();
        let name_of = |name: &str| {
            let found = pass.reads.iter().find(|(known, _)| known == name);
            found.map(|(_, source)| match source {
                Source::Input(name) => name.clone(),
                Source::Picture(index) => self.chain.pictures[*index].name.clone(),
            })
        };
        let graph = &mut start.graph;
        let names = graph.textures.iter_mut().map(|texture| &mut texture.name);
        let names = names.chain(graph.samplers.iter_mut().map(|sampler| &mut sampler.name));
        let names = names.chain(graph.buffers.iter_mut().map(|buffer| &mut buffer.name));
        for name in names {
            if let Some(source) = name_of(name) {
                *name = source;
            }
        }
        start
    }

    /// Resources of a fused kernel, which are called after what they hold.
    fn reads_of(&self, start: &Start, is_gone: &dyn Fn(usize) -> bool) -> Vec<(String, Source)> {
        let graph = &start.graph;
        let names = graph.textures.iter().map(|texture| &texture.name);
        let names = names.chain(graph.samplers.iter().map(|sampler| &sampler.name));
        let names = names.chain(graph.buffers.iter().map(|buffer| &buffer.name));
        let source = |name: &String| match self.chain.pictures.iter().position(|picture| picture.name == *name) {
            Some(index) => Source::Picture(index),
            None => Source::Input(name.clone()),
        };
        // Pictures that are computed in place are still listed among the textures, which nothing reads.
        let is_stored = |(_, source): &(String, Source)| !matches!(source, Source::Picture(k) if is_gone(*k));
        names
            .map(|name| (name.clone(), source(name)))
            .filter(is_stored)
            .collect()
    }

    /// Compiles each kernel once, with what the chain knows of the sizes of its textures.
    fn compile_all(&self, passes: &[Pass]) -> Result<BTreeMap<String, Compiled>, Errors> {
        let mut failures = Failures::default();
        let mut kernels = BTreeMap::new();
        for pass in passes {
            if kernels.contains_key(&pass.kernel) || failures.entries.contains(&pass.kernel) {
                continue;
            }
            let framed = self.framed_textures(passes, &pass.kernel);
            let change = |start: Start| {
                let mut start = pass.changed.clone().unwrap_or(start);
                start.graph = passes::frame_textures(&start.graph, &|name| framed.contains(name));
                Ok(start)
            };
            let compile = |kernel: Kernel| kernel.compile_changed(&self.settings(&pass.entry), &mut |_, _| {}, &change);
            match self.kernel(&pass.entry).and_then(compile) {
                Ok(mut compiled) => {
                    compiled.kernel.clone_from(&pass.kernel);
                    kernels.insert(pass.kernel.clone(), compiled);
                }
                Err(errors) => failures.add(&pass.kernel, errors),
            }
        }
        failures.none(self.files).map(|()| kernels)
    }

    /// Textures of a kernel that have the size of what is drawn, in every pass that has the kernel.
    fn framed_textures(&self, passes: &[Pass], kernel: &str) -> BTreeSet<String> {
        let passes = passes.iter().filter(|pass| pass.kernel == kernel);
        let framed = passes.map(|pass| -> BTreeSet<String> {
            let of_frame = pass.changed.as_ref().is_none_or(|start| start.graph.images.is_empty());
            let Some(drawn) = pass.pictures.first().filter(|_| of_frame) else {
                return BTreeSet::new();
            };
            let drawn = &self.chain.pictures[*drawn].size;
            let is_framed = |source: &Source| match source {
                Source::Input(name) => drawn == &SizeRule::of_input(name),
                Source::Picture(index) => &self.chain.pictures[*index].size == drawn,
            };
            let framed = pass.reads.iter().filter(|(_, source)| is_framed(source));
            framed.map(|(name, _)| name.clone()).collect()
        });
        framed
            .reduce(|all, other| all.intersection(&other).cloned().collect())
            .unwrap_or_default()
    }
}

/// The name of a kernel, with a number if others have it.
fn unused_kernel(name: &str, mut taken: impl FnMut(&str) -> bool) -> String {
    let mut names = std::iter::once(name.to_owned()).chain((2..).map(|k: u32| format!("{name}_{k}")));
    names.find(|name| !taken(name)).expect("endless")
}

/// Names the shaders of passes that have one kernel and several formats after both.
fn name_shaders(passes: &mut [CompiledPass]) {
    let formats: Vec<(String, Format)> = passes.iter().map(|pass| (pass.kernel.clone(), pass.format)).collect();
    for pass in passes {
        let first = formats.iter().find(|(kernel, _)| *kernel == pass.kernel);
        if first.is_some_and(|(_, format)| *format != pass.format) {
            pass.shader = format!("{}_{}", pass.kernel, pass.format);
        }
    }
}

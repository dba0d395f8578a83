//! Emitted chains: the shaders of the passes and the plan of the whole.

use super::compiled::CompiledChain;
use super::memory::{Life, assign_memory};
use crate::emit::{EmitOptions, Emitted};
use std::collections::{BTreeMap, BTreeSet};
use straightline_evaluator::diagnostic::Errors;
use straightline_evaluator::front::chain::Source;
use straightline_manifest::chain::{CHAIN_SCHEMA, ChainPlan, PassPlan, PicturePlan, ReadPlan, SizeTerm};

/// The files of a chain.
#[derive(Clone, Debug)]
pub struct EmittedChain {
    /// Plan of the whole.
    pub plan: ChainPlan,
    /// Shaders by name.
    pub shaders: BTreeMap<String, EmittedPass>,
}

/// The shader of one or several passes.
#[derive(Clone, Debug)]
pub struct EmittedPass {
    /// Name of its kernel.
    pub kernel: String,
    /// Its files.
    pub emitted: Emitted,
}

impl EmittedChain {
    /// Gives the chain and its files another name, for variants of one chain.
    pub fn renamed(mut self, name: &str) -> EmittedChain {
        let old = self.plan.chain.to_string();
        let rename = |shader: &str| match shader.strip_prefix(old.as_str()) {
            Some(rest) => format!("{name}{rest}"),
            None => shader.to_owned(),
        };
        for pass in self.plan.passes.to_mut() {
            pass.shader = rename(&pass.shader).into();
        }
        self.shaders = self
            .shaders
            .into_iter()
            .map(|(shader, pass)| (rename(&shader), pass))
            .collect();
        self.plan.chain = name.to_owned().into();
        self
    }

    /// Returns the files by name: `NAME.chain.json`, and the texts and the manifest of each shader.
    pub fn named_files(&self) -> BTreeMap<String, Vec<u8>> {
        let mut files = BTreeMap::new();
        for (name, pass) in &self.shaders {
            files.extend(pass.emitted.named_files(name));
        }
        files.insert(
            format!("{}.chain.json", self.plan.chain),
            self.plan.to_json().into_bytes(),
        );
        files
    }
}

impl CompiledChain {
    /// Writes the shaders, each once, and the plan of the chain.
    ///
    /// # Errors
    ///
    /// As of [`Compiled::emit`](crate::Compiled::emit), for each pass.
    pub fn emit(&self) -> Result<EmittedChain, Errors> {
        self.emit_as(&self.spec.shader.emit)
    }

    /// As [`CompiledChain::emit`], with other options of the texts; each pass has its own format.
    ///
    /// # Errors
    ///
    /// As of [`CompiledChain::emit`].
    pub fn emit_as(&self, emit: &EmitOptions) -> Result<EmittedChain, Errors> {
        let mut shaders: BTreeMap<String, EmittedPass> = BTreeMap::new();
        for pass in &self.passes {
            if shaders.contains_key(&pass.shader) {
                continue;
            }
            let options = emit.clone().format(pass.format);
            let emitted = EmittedPass {
                kernel: pass.kernel.clone(),
                emitted: self.kernel_of(pass).emit(&options)?,
            };
            shaders.insert(pass.shader.clone(), emitted);
        }
        let plan = plan_chain(self, &shaders);
        Ok(EmittedChain { plan, shaders })
    }
}

fn plan_chain(chain: &CompiledChain, shaders: &BTreeMap<String, EmittedPass>) -> ChainPlan {
    // Options can make inputs unnecessary.
    let reads: Vec<Vec<(&String, &Source)>> = chain
        .passes
        .iter()
        .map(|pass| {
            let bound: BTreeSet<&str> = shaders[&pass.shader]
                .emitted
                .manifest
                .bindings
                .iter()
                .map(|b| &*b.name)
                .collect();
            let reads = pass.reads.iter().map(|(name, source)| (name, source));
            reads.filter(|(name, _)| bound.contains(name.as_str())).collect()
        })
        .collect();
    let lives: Vec<Life> = chain
        .pictures
        .iter()
        .enumerate()
        .map(|(k, picture)| {
            let readers = reads
                .iter()
                .enumerate()
                .filter(|(_, reads)| reads.iter().any(|(_, s)| **s == Source::Picture(k)));
            let last = readers.map(|(reader, _)| reader).next_back();
            let (drawn, output) = chain.drawn_by(k);
            Life {
                size: picture.size.clone(),
                format: shaders[&chain.passes[drawn].shader].emitted.manifest.outputs[output].format,
                drawn,
                last_read: (!chain.results.contains(&k)).then(|| last.unwrap_or(drawn)),
            }
        })
        .collect();
    let memory = assign_memory(&lives);
    let pictures = chain
        .pictures
        .iter()
        .zip(lives)
        .zip(memory)
        .map(|((picture, life), memory)| PicturePlan {
            name: picture.name.clone().into(),
            size: life.size,
            format: life.format,
            memory,
        });
    let passes = chain.passes.iter().zip(reads).map(|(pass, reads)| PassPlan {
        name: chain.pictures[pass.draws[0]].name.clone().into(),
        shader: pass.shader.clone().into(),
        reads: reads
            .into_iter()
            .map(|(name, source)| ReadPlan {
                name: name.clone().into(),
                from: chain.source_name(source).to_owned().into(),
            })
            .collect(),
        writes: pass
            .draws
            .iter()
            .map(|picture| chain.pictures[*picture].name.clone().into())
            .collect(),
    });
    let inputs = |name: &&String| {
        let is_read = |(_, source): &(String, Source)| matches!(source, Source::Input(input) if input == *name);
        let has_size = |term: &SizeTerm| matches!(term, SizeTerm::Of(input) if *input == **name);
        chain.passes.iter().any(|pass| pass.reads.iter().any(is_read))
            || chain.pictures.iter().any(|picture| picture.size.0.iter().any(has_size))
    };
    let inputs = chain
        .inputs
        .iter()
        .filter(inputs)
        .map(|name| name.clone().into())
        .collect();
    ChainPlan {
        schema: CHAIN_SCHEMA,
        chain: chain.name.clone().into(),
        inputs,
        pictures: pictures.collect(),
        passes: passes.collect(),
    }
}

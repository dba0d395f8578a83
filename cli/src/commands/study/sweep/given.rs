//! Inputs of a sweep's variants: files of the command line, and the test card for everything else.

use crate::args::{CardArgs, CommonArgs, Executor, GivenArgs};
use crate::commands::run::inputs;
use crate::failure::Failure;
use glam::UVec2;
use std::collections::BTreeSet;
use std::fmt;
use straightline_bench::execute::{Inputs, test_inputs};
use straightline_codegen::{Compiled, Stage};

/// Inputs from the command line.
pub struct Given {
    args: GivenArgs,
    /// Names of all inputs that any variant reads.
    names: BTreeSet<String>,
    /// Default size, without a picture.
    size: UVec2,
}

/// Returns the names of all inputs of a kernel.
fn input_names(compiled: &Compiled) -> impl Iterator<Item = &String> {
    let graph = &compiled.graph;
    let textures = graph.textures.iter().map(|texture| &texture.name);
    let uniforms = graph.uniforms.iter().map(|uniform| &uniform.name);
    textures
        .chain(uniforms)
        .chain(graph.buffers.iter().map(|buffer| &buffer.name))
}

impl Given {
    /// Creates the inputs of variants that read the inputs of `compiled`, at a size unless pictures have their own.
    pub fn new(common: &CommonArgs, inputs: &CardArgs, size: UVec2, compiled: &[Compiled]) -> Given {
        let args = GivenArgs {
            input: inputs.input.clone(),
            uniform: inputs.uniform.clone(),
            buffer: inputs.buffer.clone(),
            size: match inputs.input.is_empty() {
                true => Some(size),
                false => common.size,
            },
            executor: Executor::Gpu,
            adapter: common.adapter.clone(),
        };
        Given {
            args,
            names: compiled.iter().flat_map(input_names).cloned().collect(),
            size,
        }
    }

    /// Returns the width and height of the pictures.
    pub fn picture_size(&self, compiled: &Compiled) -> Result<UVec2, Failure> {
        Ok(self.variant_inputs(compiled)?.size)
    }

    /// Returns the inputs of a variant, without those that only other variants read.
    pub fn variant_inputs(&self, compiled: &Compiled) -> Result<Inputs, Failure> {
        let own: BTreeSet<&String> = input_names(compiled).collect();
        let wanted = |name: &str| own.iter().any(|own| *own == name) || !self.names.contains(name);
        let mut args = self.args.clone();
        args.input
            .retain(|text| text.split_once('=').is_none_or(|(name, _)| wanted(name)));
        args.uniform.retain(|(name, _)| wanted(name));
        args.buffer.retain(|(name, _)| wanted(name));
        if args.input.is_empty() {
            args.size = args.size.or(Some(self.size));
        }
        let mut inputs = inputs::read_inputs(&args, Stage::Compute, compiled)?;
        let card = test_inputs(&compiled.in_blocks().graph, inputs.size);
        add_missing(&mut inputs.images, card.images);
        add_missing(&mut inputs.integers, card.integers);
        add_missing(&mut inputs.buffers, card.buffers);
        add_missing(&mut inputs.uniforms, card.uniforms);
        Ok(inputs)
    }
}

/// Adds the missing entries.
fn add_missing<T>(own: &mut Vec<(String, T)>, card: Vec<(String, T)>) {
    for (name, value) in card {
        if !own.iter().any(|(known, _)| *known == name) {
            own.push((name, value));
        }
    }
}

impl fmt::Display for Given {
    /// Formats the inputs for a record.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pairs = self.args.uniform.iter().chain(&self.args.buffer);
        let pairs = pairs.map(|(name, value)| format!("{name}={value}"));
        let all: Vec<String> = self.args.input.iter().cloned().chain(pairs).collect();
        match all.is_empty() {
            true => f.write_str("the test card"),
            false => write!(f, "{}; all else the test card", all.join(" ")),
        }
    }
}

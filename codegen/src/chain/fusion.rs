//! Decision which pictures of a chain are computed where they are read.

use super::spec::Fuse;
use crate::pipeline::Start;
use std::collections::BTreeMap;
use straightline_evaluator::diagnostic::{Code, Diagnostic};
use straightline_evaluator::front::chain::{Chain, Picture, Source};
use straightline_evaluator::ir::{Op, Texture};
use straightline_evaluator::passes::{self, Unfused};
use straightline_evaluator::suggest_name;

/// Cost of a read or a store of a texel, in operations. Ratios of a texture unit's rate to that of arithmetic lie between 4 and
/// 16 on GPUs of ten years.
const TEXEL: usize = 8;

/// Most operations of a pass in which everything is computed that can be: a shader of some thousand lines. SwiftShader's compiler
/// ends the program at five times as many.
const MOST_OPERATIONS: usize = 4_000;

/// Reason why a picture is stored that could have been asked for.
pub struct Kept {
    /// Index of the picture.
    pub picture: usize,
    /// Reason, as a message has it.
    pub reason: String,
}

/// Pictures to compute where they are read, by index, and the others with a reason.
pub struct Decision {
    pub fused: Vec<bool>,
    pub kept: Vec<Kept>,
}

/// Decides which pictures are computed where they are read.
///
/// # Errors
///
/// A name that no picture has, or that of a picture that has to be stored.
pub fn decide(
    chain: &Chain,
    starts: &BTreeMap<String, Start>,
    sized: &[Texture],
    fuse: &Fuse,
) -> Result<Decision, Box<Diagnostic>> {
    let mut decision = Decision {
        fused: vec![false; chain.pictures.len()],
        kept: Vec::new(),
    };
    if let Fuse::Named { inline, shared } = fuse {
        check_names(chain, inline.iter().chain(shared).map(String::as_str))?;
    }
    let mut costs: Vec<usize> = chain
        .passes
        .iter()
        .map(|pass| operations(&starts[&pass.entry]))
        .collect();
    for (index, picture) in chain.pictures.iter().enumerate() {
        let wanted = match fuse {
            Fuse::None | Fuse::Share => false,
            Fuse::Auto | Fuse::All => !chain.results.contains(&index),
            Fuse::Named { inline, .. } => inline.contains(&picture.name),
        };
        if !wanted {
            continue;
        }
        let reason = match obstacle(chain, starts, sized, index) {
            Err(reason) => reason,
            Ok(reads) => {
                let each = costs[index];
                let total: usize = reads.iter().map(|(_, count)| count).sum();
                let largest = reads.iter().map(|(reader, count)| costs[*reader] + count * each).max();
                let is_large = *fuse == Fuse::All && largest.is_some_and(|operations| operations > MOST_OPERATIONS);
                if (*fuse != Fuse::Auto || pays(each, total)) && !is_large {
                    decision.fused[index] = true;
                    // A reader computes the picture in place of reading it.
                    for (reader, count) in reads {
                        costs[reader] = (costs[reader] + count * each).saturating_sub(count * TEXEL);
                    }
                    continue;
                }
                match is_large {
                    true => format!("{total} times {each} operations are too many for a pass"),
                    false => format!("{total} reads of it cost less than {each} operations each"),
                }
            }
        };
        if let Fuse::Named { .. } = fuse {
            return Err(unfit(picture, &reason));
        }
        decision.kept.push(Kept { picture: index, reason });
    }
    Ok(decision)
}

/// Error of a picture that was asked for by name, and has to be stored.
pub fn unfit(picture: &Picture, reason: &str) -> Box<Diagnostic> {
    let what = format!("the picture `{}` cannot be fused: {reason}", picture.name);
    Box::new(
        Diagnostic::error_at(Code::UnfitSetting, picture.span, what)
            .label("drawn here")
            .help("leave it out of `--fuse`, or use `--fuse auto`"),
    )
}

fn check_names<'n>(chain: &Chain, names: impl Iterator<Item = &'n str>) -> Result<(), Box<Diagnostic>> {
    let known: Vec<&str> = chain.pictures.iter().map(|picture| picture.name.as_str()).collect();
    for name in names {
        if !known.contains(&name) {
            let what = format!("`{}` has no picture `{name}`", chain.name);
            let help = suggest_name(name, &known, "its pictures are");
            return Err(Box::new(
                Diagnostic::error_at(Code::SettingValue, chain.span, what)
                    .label("this chain")
                    .help(help),
            ));
        }
    }
    Ok(())
}

/// Passes that read a picture, each with its number of coordinates there, or the reason why the picture has to be stored.
fn obstacle(
    chain: &Chain,
    starts: &BTreeMap<String, Start>,
    sized: &[Texture],
    index: usize,
) -> Result<Vec<(usize, usize)>, String> {
    if chain.results.contains(&index) {
        return Err("it is a result of the chain".to_owned());
    }
    let start = &starts[&chain.passes[index].entry];
    if let Some(obstacle) = passes::find_obstacle(&start.graph) {
        return Err(obstacle.to_string());
    }
    if !passes::has_textures(&chain.pictures[index].size, sized) {
        return Err(Unfused::Size.to_string());
    }
    let mut reads = Vec::new();
    for (reader, pass) in chain.passes.iter().enumerate() {
        let graph = &starts[&pass.entry].graph;
        for (name, _) in pass
            .reads
            .iter()
            .filter(|(_, source)| *source == Source::Picture(index))
        {
            let count = passes::count_reads(graph, name).ok_or_else(|| Unfused::Sampled.to_string())?;
            reads.push((reader, count));
        }
    }
    Ok(reads)
}

/// Returns whether computing a picture at each of `total` reads costs no more than storing it once and reading it.
fn pays(each: usize, total: usize) -> bool {
    total * each <= each + TEXEL + total * TEXEL
}

/// Cost of a texel of a picture in operations.
pub fn operations(start: &Start) -> usize {
    let cost = |op: &Op| match op {
        Op::Const(_)
        | Op::Pixel
        | Op::FrameSize
        | Op::Uniform(_)
        | Op::Override(_)
        | Op::Extract(_)
        | Op::Compose
        | Op::Splat => 0,
        op if op.is_read() => TEXEL,
        _ => 1,
    };
    start.graph.nodes.iter().map(|node| cost(&node.op)).sum()
}

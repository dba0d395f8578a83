//! Pictures that a workgroup computes one after another, each from a tile of those before it in workgroup memory.
//!
//! A picture is eligible if others read it texel by texel at places that follow from their pixel, scaled by a whole number or
//! divided by one, and if its size is scaled alike. From the texels of the last picture that a workgroup computes follow those
//! of each earlier one that they need: its tile. Where tiles of neighbours overlap, both compute the texels.
//!
//! Tests: `tests/tests/language/cascades.rs` compares chains in this form with stored ones and with rustc.

mod build;
mod footprint;
mod ratio;

use super::fuse::{Unfused, count_reads};
use crate::ir::{Graph, MOST_SHARED_BYTES, Scalar, Type};
use footprint::{Sizes, Span, find_footprint};
use straightline_manifest::chain::SizeRule;

pub use build::compute_cascade;

/// Most copies of a picture's kernel in the shader: texels of the tile that a thread computes one after another.
const MOST_TURNS: u32 = 8;

/// Texels of the last picture that a workgroup may compute, across and down.
const SIDES: [u32; 6] = [32, 16, 8, 4, 2, 1];

/// A picture of a cascade with the kernel that draws it.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Name of the picture, which the kernels after it have for the texture.
    pub name: &'a str,
    /// Kernel that draws it, as it was evaluated.
    pub graph: &'a Graph,
    /// Its size, in those of textures.
    pub size: &'a SizeRule,
    /// `true` if something besides the cascade reads it.
    pub stored: bool,
}

/// Texels of a picture that a workgroup computes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Name of the picture.
    pub name: String,
    /// Texels by which the tiles of neighbouring workgroups are apart: those that a workgroup stores.
    pub step: [u32; 2],
    /// First texel of the tile, relative to the first one that is stored.
    pub first: [i32; 2],
    /// Width and height of the tile.
    pub size: [u32; 2],
    /// Bytes of workgroup memory; 0 of the last picture.
    pub bytes: u64,
    /// Texels that a thread computes, one after another.
    pub turns: u32,
}

/// Tiles of the pictures that a workgroup computes, in order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cascade {
    /// A tile for each picture.
    pub tiles: Vec<Tile>,
}

impl Cascade {
    /// Width and height of every workgroup.
    pub const THREADS: [u32; 2] = [16, 16];

    /// Bytes of workgroup memory.
    pub fn byte_size(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.bytes).sum()
    }

    /// Texels that are computed, for each that a workgroup would compute without overlap; weighed by `cost`, of each picture.
    pub fn overlap(&self, cost: &[usize]) -> f64 {
        let sum = |area: &dyn Fn(&Tile) -> [u32; 2]| -> f64 {
            let each = self.tiles.iter().zip(cost);
            each.map(|(tile, cost)| *cost as f64 * area(tile).map(f64::from).iter().product::<f64>())
                .sum()
        };
        sum(&|tile| tile.size) / sum(&|tile| tile.step).max(1.0)
    }

    /// Work of all threads, idle ones too, for that of the texels that a workgroup stores; weighed by `cost`, of each picture.
    /// Small tiles keep few threads busy.
    pub fn idleness(&self, cost: &[usize]) -> f64 {
        let threads = f64::from(Cascade::THREADS[0] * Cascade::THREADS[1]);
        let each = || self.tiles.iter().zip(cost.iter().map(|cost| *cost as f64));
        let all: f64 = each().map(|(tile, cost)| cost * f64::from(tile.turns) * threads).sum();
        let stored: f64 = each()
            .map(|(tile, cost)| cost * f64::from(tile.step[0] * tile.step[1]))
            .sum();
        all / stored.max(1.0)
    }

    /// Operations of a thread, by those of each picture's kernel.
    fn time(&self, cost: &[usize]) -> usize {
        // A barrier and the places of a tile take a while, too.
        let each = self.tiles.iter().zip(cost);
        each.map(|(tile, cost)| tile.turns as usize * (cost + 8) + 16).sum()
    }
}

/// Chooses the tiles of pictures in the order in which they are drawn. `rule_of` gives the size of a texture that the kernels
/// read, by name; `cost` has the operations of each picture's kernel.
///
/// # Errors
///
/// The reason why no workgroup can compute them.
pub fn plan_cascade(
    parts: &[Part<'_>],
    rule_of: &dyn Fn(&str) -> Option<SizeRule>,
    cost: &[usize],
) -> Result<Cascade, String> {
    let reads = find_reads(parts, rule_of)?;
    let mut best: Option<(f64, Cascade)> = None;
    let mut reason = String::new();
    for side in SIDES {
        match choose_tiles(parts, &reads, side) {
            Ok(cascade) => {
                let each = cascade.time(cost) as f64 / f64::from(side * side);
                if best.as_ref().is_none_or(|(least, _)| each < *least) {
                    best = Some((each, cascade));
                }
            }
            Err(why) => reason = why,
        }
    }
    best.map(|(_, cascade)| cascade).ok_or(reason)
}

/// A picture that a later one reads.
struct Read {
    read: usize,
    reader: usize,
    spans: [Span; 2],
}

/// Reads of pictures by later ones.
fn find_reads(parts: &[Part<'_>], rule_of: &dyn Fn(&str) -> Option<SizeRule>) -> Result<Vec<Read>, String> {
    let mut reads = Vec::new();
    for (reader, part) in parts.iter().enumerate() {
        let rules: Vec<Option<SizeRule>> = part.graph.textures.iter().map(|of| rule_of(&of.name)).collect();
        let sizes = Sizes {
            frame: part.size,
            textures: &rules,
        };
        for (texture, of) in (0..).zip(&part.graph.textures) {
            let Some(read) = parts[..reader].iter().position(|other| other.name == of.name) else {
                continue;
            };
            let is_read = part
                .graph
                .nodes
                .iter()
                .any(|node| node.op.is_read() && node.op.texture() == Some(texture));
            if !is_read {
                continue;
            }
            let spans = find_footprint(part.graph, texture, &sizes);
            let spans = spans.ok_or_else(|| match count_reads(part.graph, &of.name) {
                None => Unfused::Sampled.to_string(),
                Some(_) => format!("`{}` reads it at places that do not follow from its pixel", part.name),
            })?;
            reads.push(Read { read, reader, spans });
        }
    }
    Ok(reads)
}

/// Tiles for workgroups that compute `side` by `side` texels of the last picture.
fn choose_tiles(parts: &[Part<'_>], reads: &[Read], side: u32) -> Result<Cascade, String> {
    let along = |axis: usize| choose_extents(parts, reads, i64::from(side), axis);
    let axes = [along(0)?, along(1)?];
    let last = parts.len() - 1;
    let threads = Cascade::THREADS[0] * Cascade::THREADS[1];
    let tiles = parts.iter().enumerate().map(|(k, part)| {
        let along = [&axes[0][k], &axes[1][k]];
        let size = along.map(|extent| (extent.last - extent.first + 1) as u32);
        let texels = u64::from(size[0]) * u64::from(size[1]);
        Tile {
            name: part.name.to_owned(),
            step: along.map(|extent| extent.step as u32),
            first: along.map(|extent| extent.first as i32),
            size,
            bytes: if k == last { 0 } else { texels * texel_bytes(part.graph) },
            turns: u32::try_from(texels.div_ceil(u64::from(threads))).unwrap_or(u32::MAX),
        }
    });
    let cascade = Cascade { tiles: tiles.collect() };
    if cascade.byte_size() > MOST_SHARED_BYTES {
        return Err(format!(
            "its tiles do not fit into {MOST_SHARED_BYTES} bytes of workgroup memory"
        ));
    }
    if cascade.tiles.iter().any(|tile| tile.turns > MOST_TURNS) {
        return Err("its tiles have too many texels for a workgroup".to_owned());
    }
    Ok(cascade)
}

/// Bytes of a texel in workgroup memory.
fn texel_bytes(graph: &Graph) -> u64 {
    match graph.targets[0].ty.component_count() {
        3 => 16,
        lanes => 4 * u64::from(lanes),
    }
}

/// Texels of a picture along an axis that a workgroup computes, relative to the first one that it stores.
struct Extent {
    step: i64,
    first: i64,
    last: i64,
    /// The first one that is stored lies at `size - 1 + slack` or less.
    slack: i64,
}

fn choose_extents(parts: &[Part<'_>], reads: &[Read], side: i64, axis: usize) -> Result<Vec<Extent>, String> {
    let mut extents: Vec<Option<Extent>> = parts.iter().map(|_| None).collect();
    for reader in (0..parts.len()).rev() {
        let extent = extents[reader].get_or_insert(Extent {
            step: side,
            first: 0,
            last: side - 1,
            slack: 0,
        });
        if reader + 1 < parts.len() && reads.iter().all(|read| read.read != reader) {
            return Err(format!("nothing after `{}` reads it there", parts[reader].name));
        }
        // The tile has the texels that are stored, and lies partly inside the picture, so that clamped places are in it.
        extent.first = extent.first.min(-extent.slack);
        let &mut Extent {
            step,
            first,
            last,
            slack,
        } = extent;
        for read in reads.iter().filter(|read| read.reader == reader) {
            let (span, of) = (read.spans[axis], &parts[read.read]);
            let apart = || {
                format!(
                    "the sizes of `{}` and `{}` are not scaled as it is read",
                    of.name, parts[reader].name
                )
            };
            if step * span.times % span.over != 0 {
                return Err(format!(
                    "`{}` needs parts of texels of `{}`",
                    parts[reader].name, of.name
                ));
            }
            let slack = ratio::slack_of_read(of.size, parts[reader].size, &span, axis, slack).ok_or_else(apart)?;
            let own = step * span.times / span.over;
            let from = (first * span.times).div_euclid(span.over) + span.low;
            let to = (last * span.times).div_euclid(span.over) + span.high;
            let found = extents[read.read].get_or_insert(Extent {
                step: own,
                first: 0,
                last: own - 1,
                slack: 0,
            });
            if found.step != own {
                return Err(format!("`{}` is read in two scales", of.name));
            }
            found.first = found.first.min(from);
            found.last = found.last.max(to);
            found.slack = found.slack.max(slack);
        }
    }
    Ok(extents.into_iter().flatten().collect())
}

/// Type of a pair of coordinates.
const PAIR: Type = Type::value(Scalar::I32, 2);

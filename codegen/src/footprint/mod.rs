//! Texels that an invocation reads, their weights, and the messages between lanes, from the evaluated graph.
//!
//! The graph is evaluated for a few pixels of large frames. A coordinate that has the same offset from the pixel in all of
//! them is a tap. A result that is a sum of taps times constants has their weights.

mod facts;
mod place;
mod record;
mod value;
mod walk;

pub use facts::{Causes, Elsewhere, Footprint, MemoryReads, Messages, Method, SharedTexels, Tap, TextureReads, Unit};

use crate::compiled::Compiled;
use place::Place;
use record::FoundTap;
use std::collections::BTreeMap;
use straightline_evaluator::ir::{Graph, Invocation};
use straightline_evaluator::passes::{Sharing, schedule_graph};
use value::{PROBES, Part, Value};
use walk::{Found, find_reads};

/// Finds the texels that one invocation reads, before a workgroup shares them.
pub fn find_footprint(compiled: &Compiled) -> Footprint {
    let sharing = compiled.sharing.as_deref();
    let found = match &compiled.unshared {
        Some(graph) => (
            find_reads(graph, &schedule_graph(graph, compiled.policy.reads)),
            &**graph,
        ),
        None => (find_reads(&compiled.graph, &compiled.schedule), &compiled.graph),
    };
    describe_reads(found.0, found.1, sharing)
}

fn describe_reads(found: Found, graph: &Graph, sharing: Option<&Sharing>) -> Footprint {
    let mut found = found;
    place_around(&mut found.taps);
    let weights = find_weights(&found);
    // By texture, level and unit, which has no order of its own.
    let mut textures: BTreeMap<(u32, u32, u64), TextureReads> = BTreeMap::new();
    for (k, tap) in found.taps.iter().enumerate() {
        let unit = match tap.place {
            Place::Near(_, unit) => unit,
            _ => main_unit(&found.taps, tap),
        };
        let order = match unit {
            Unit::Texels(scale) => scale.to_bits(),
            Unit::Around(_) => u64::MAX - 1,
            Unit::Pixels => u64::MAX,
        };
        let of = textures
            .entry((tap.texture, tap.level, order))
            .or_insert_with(|| TextureReads {
                texture: graph.textures[tap.texture as usize].name.clone(),
                level: tap.level,
                unit,
                reads: 0,
                taps: Vec::new(),
                elsewhere: Vec::new(),
                shared: Vec::new(),
            });
        of.reads += tap.reads;
        match tap.place {
            Place::Near(at, _) => of.taps.push(Tap {
                at,
                method: tap.method,
                layer: tap.layer,
                lane: tap.lane,
                reads: tap.reads,
                conditional: tap.conditional,
                weights: weights_of(&weights, k),
            }),
            Place::Fixed => count_elsewhere(of, "one place, the same for all pixels".to_owned(), tap.reads),
            Place::Elsewhere(causes) | Place::Assumed(_, causes) => {
                count_elsewhere(of, format!("places that depend on {causes}"), tap.reads)
            }
        }
    }
    let mut textures: Vec<TextureReads> = textures.into_values().collect();
    for of in &mut textures {
        let key = |tap: &Tap| {
            (
                tap.at[1].to_bits() ^ sign_flip(tap.at[1]),
                tap.at[0].to_bits() ^ sign_flip(tap.at[0]),
                tap.layer,
                tap.lane,
                tap.method,
            )
        };
        of.taps.sort_by_key(key);
        of.shared = sharing.map_or(Vec::new(), |sharing| shared_texels(sharing, &of.texture));
    }
    let tested = found.results.iter().any(|result| {
        result
            .parts()
            .iter()
            .any(|part| matches!(part, Part::Sum(sum) if sum.tested))
    });
    let lanes = graph.invocation == Invocation::Lane;
    Footprint {
        pixels: if lanes { [2, 2] } else { graph.invocation.block_size() },
        lanes,
        textures,
        messages: found.messages,
        memories: found.memories,
        tested: tested && weights.iter().any(Option::is_some),
    }
}

/// Mask that makes the bits of a float ordered like the float.
fn sign_flip(x: f64) -> u64 {
    if x.is_sign_negative() { u64::MAX } else { 1 << 63 }
}

/// Places reads whose position was assumed relative to the first of the same texture, where their distance is constant.
fn place_around(taps: &mut [FoundTap]) {
    let mut first: BTreeMap<(u32, u32), [[f64; 2]; PROBES]> = BTreeMap::new();
    let mut sizes: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for tap in taps.iter() {
        if let Place::Assumed(places, _) = tap.place {
            first.entry((tap.texture, tap.level)).or_insert(places);
            *sizes.entry((tap.texture, tap.level)).or_default() += 1;
        }
    }
    for tap in taps {
        let Place::Assumed(places, causes) = tap.place else {
            continue;
        };
        let key = (tap.texture, tap.level);
        let phase = constant_phase(&first[&key]);
        let from = &first[&key];
        let relative = places
            .iter()
            .zip(from)
            .map(|(at, from)| [at[0] - from[0], at[1] - from[1]]);
        let relative: Vec<[f64; 2]> = relative.collect();
        let is_constant = relative
            .iter()
            .all(|at| (0..2).all(|axis| (at[axis] - relative[0][axis]).abs() < 1e-4));
        tap.place = match is_constant && sizes[&key] > 1 {
            true => {
                let at = [0, 1].map(|axis| ((relative[0][axis] + phase[axis]) * 1e4).round() / 1e4 + 0.0);
                Place::Near(at, Unit::Around(causes))
            }
            false => Place::Elsewhere(causes),
        };
    }
}

/// Position inside its texel, if it is equal in all probes; otherwise the middle.
fn constant_phase(places: &[[f64; 2]; PROBES]) -> [f64; 2] {
    [0, 1].map(|axis| {
        // Positions just below a border count as on it.
        let phases = places.map(|at| (at[axis] + 1e-5).rem_euclid(1.0) - 1e-5);
        match phases.iter().all(|phase| (phase - phases[0]).abs() < 1e-4) {
            true => phases[0],
            false => 0.5,
        }
    })
}

/// Unit of the first tap of the same texture and level, for a read without a place.
fn main_unit(taps: &[FoundTap], of: &FoundTap) -> Unit {
    let same = taps
        .iter()
        .filter(|tap| (tap.texture, tap.level) == (of.texture, of.level));
    let mut units = same.filter_map(|tap| match tap.place {
        Place::Near(_, unit) => Some(unit),
        _ => None,
    });
    units.next().unwrap_or(Unit::Texels(1.0))
}

fn count_elsewhere(of: &mut TextureReads, place: String, reads: u32) {
    match of.elsewhere.iter_mut().find(|other| other.place == place) {
        Some(known) => known.reads += reads,
        None => of.elsewhere.push(Elsewhere { reads, place }),
    }
}

fn shared_texels(sharing: &Sharing, texture: &str) -> Vec<SharedTexels> {
    let tiles = sharing.tiles.iter().filter(|tile| tile.texture == texture);
    tiles
        .map(|tile| SharedTexels {
            layer: tile.layer,
            first: tile.first,
            size: tile.size,
            workgroup: sharing.threads,
        })
        .collect()
}

/// Weights of all taps by pixel. A pixel whose result is no sum of taps has none.
fn find_weights(found: &Found) -> Vec<Option<Vec<Vec<f64>>>> {
    let results = found.results.iter();
    results.map(|result| pixel_weights(result, &found.taps)).collect()
}

/// Returns the weights of a tap by pixel. A tap with weight 0 everywhere has none: it decides about others.
fn weights_of(weights: &[Option<Vec<Vec<f64>>>], tap: usize) -> Vec<Option<Vec<f64>>> {
    let of_pixel = |all: &Option<Vec<Vec<f64>>>| all.as_ref().map(|all| all[tap].clone());
    let found: Vec<Option<Vec<f64>>> = weights.iter().map(of_pixel).collect();
    match found.iter().flatten().flatten().all(|weight| *weight == 0.0) {
        true => vec![None; found.len()],
        false => found,
    }
}

/// Weight of each tap in a result: the factor of a texel whose components are equal. `None` unless all components of the
/// colour that have taps agree. The fourth component often is that of one texel, and counts only alone.
fn pixel_weights(result: &Value, taps: &[FoundTap]) -> Option<Vec<Vec<f64>>> {
    let (color, rest) = result.parts().split_at(result.parts().len().min(3));
    let has_taps = |parts: &[Part]| parts.iter().any(|part| !matches!(part, Part::Known(..)));
    let mut found: Option<Vec<Vec<f64>>> = None;
    for part in if has_taps(color) { color } else { rest } {
        let sum = match part {
            Part::Sum(sum) if !sum.terms.is_empty() => sum,
            Part::Unknown(_) => return None,
            _ => continue,
        };
        let empty = |tap: &FoundTap| vec![0.0; if tap.method.is_gather() { 4 } else { 1 }];
        let mut weights: Vec<Vec<f64>> = taps.iter().map(empty).collect();
        for ((tap, component), factor) in &sum.terms {
            let of = &mut weights[*tap as usize];
            let k = usize::from(*component).min(of.len() - 1);
            of[k] += factor;
        }
        let same = |other: &Vec<Vec<f64>>| {
            let mut pairs = other.iter().flatten().zip(weights.iter().flatten());
            pairs.all(|(a, b)| (a - b).abs() < 1e-9)
        };
        match &found {
            Some(before) if !same(before) => return None,
            Some(_) => {}
            None => found = Some(weights),
        }
    }
    found
}

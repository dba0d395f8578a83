//! Reads and messages found while a schedule is evaluated.

use super::facts::Method;
use super::place::Place;
use std::collections::{BTreeMap, HashMap};
use straightline_evaluator::ir::Type;

/// A read with its place.
#[derive(Clone, Debug)]
pub struct FoundTap {
    pub texture: u32,
    pub method: Method,
    pub layer: Option<u32>,
    pub level: u32,
    pub lane: u32,
    pub place: Place,
    pub reads: u32,
    pub conditional: bool,
}

/// Reads and messages found so far.
#[derive(Clone, Debug, Default)]
pub struct Record {
    pub taps: Vec<FoundTap>,
    /// Index of a tap by its key.
    known: HashMap<TapKey, u32>,
    /// Messages and their scalars, by direction.
    pub messages: BTreeMap<[u32; 2], (u32, u32)>,
    /// Reads by the memory's name; `true` for that of a workgroup.
    pub memories: BTreeMap<(String, bool), u32>,
}

/// Texture, way of reading, layer, level, lane, and the bits of the place.
type TapKey = (u32, Method, Option<u32>, u32, u32, [u64; 2]);

impl Record {
    /// Counts a message of a type.
    pub fn count_message(&mut self, direction: [u32; 2], ty: Type) {
        let (messages, values) = self.messages.entry(direction).or_default();
        *messages += 1;
        *values += u32::from(ty.component_count());
    }

    /// Counts a read of a buffer, or of the memory of a workgroup.
    pub fn count_memory(&mut self, name: &str, workgroup: bool) {
        *self.memories.entry((name.to_owned(), workgroup)).or_default() += 1;
    }

    /// Adds a tap; returns its index. Reads of one texel have one index.
    pub fn add_tap(&mut self, tap: FoundTap) -> u32 {
        let next = self.taps.len() as u32;
        if let Place::Near(at, _) = tap.place {
            let key = (
                tap.texture,
                tap.method,
                tap.layer,
                tap.level,
                tap.lane,
                at.map(f64::to_bits),
            );
            let known = *self.known.entry(key).or_insert(next);
            if known != next {
                let before = &mut self.taps[known as usize];
                before.reads += 1;
                before.conditional &= tap.conditional;
                return known;
            }
        }
        self.taps.push(tap);
        next
    }
}

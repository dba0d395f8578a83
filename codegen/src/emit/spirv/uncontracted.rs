//! Decoration of exact operations. naga writes none, so the translated WGSL passes exact values through a marking function,
//! whose calls become decorations here.

use super::{HEADER, opcode_of, split_instructions};
use crate::emit::legalise::AS_WRITTEN;
use std::collections::HashSet;

/// Opcodes of the instructions handled here.
mod code {
    pub const SOURCE_CONTINUED: u32 = 2;
    pub const SOURCE: u32 = 3;
    pub const SOURCE_EXTENSION: u32 = 4;
    pub const NAME: u32 = 5;
    pub const MEMBER_NAME: u32 = 6;
    pub const STRING: u32 = 7;
    pub const EXTENSION: u32 = 10;
    pub const EXT_INST_IMPORT: u32 = 11;
    pub const MEMORY_MODEL: u32 = 14;
    pub const ENTRY_POINT: u32 = 15;
    pub const EXECUTION_MODE: u32 = 16;
    pub const CAPABILITY: u32 = 17;
    pub const FUNCTION: u32 = 54;
    pub const FUNCTION_PARAMETER: u32 = 55;
    pub const FUNCTION_END: u32 = 56;
    pub const FUNCTION_CALL: u32 = 57;
    pub const DECORATE: u32 = 71;
    pub const MEMBER_DECORATE: u32 = 72;
    pub const COPY_OBJECT: u32 = 83;
    pub const LABEL: u32 = 248;
    pub const MODULE_PROCESSED: u32 = 330;
    /// `OpFNegate`, `OpFAdd`, `OpFSub`, `OpFMul`, `OpFDiv`, `OpFRem`, `OpFMod`, `OpVectorTimesScalar` and `OpDot`.
    pub const ARITHMETIC: [u32; 9] = [127, 129, 131, 133, 136, 140, 141, 142, 148];
}

/// The decoration `NoContraction`, which prevents merging and reordering of an operation.
const NO_CONTRACTION: u32 = 42;

/// Replaces each call of the marking function by a copy of its argument, decorates the operation that computes the
/// argument, and removes the function.
pub fn forbid_contraction(words: &[u32]) -> Vec<u32> {
    let all = split_instructions(words);
    // An entry point may have that name; no other function is the kernel's own.
    let entries: HashSet<u32> = all
        .iter()
        .filter(|i| opcode_of(i) == code::ENTRY_POINT)
        .map(|i| i[2])
        .collect();
    let is_named =
        |i: &&&[u32]| opcode_of(i) == code::NAME && i.len() > 2 && literal_string(&i[2..]).starts_with(AS_WRITTEN);
    let named: HashSet<u32> = all.iter().filter(is_named).map(|i| i[1]).collect();
    let functions = all.iter().filter(|i| opcode_of(i) == code::FUNCTION).map(|i| i[2]);
    let marks: HashSet<u32> = functions
        .filter(|id| named.contains(id) && !entries.contains(id))
        .collect();
    let is_call = |i: &[u32]| opcode_of(i) == code::FUNCTION_CALL && i.len() == 5 && marks.contains(&i[3]);
    if !all.iter().any(|i| is_call(i)) {
        return words.to_vec();
    }
    let exact: HashSet<u32> = all.iter().filter(|i| is_call(i)).map(|i| i[4]).collect();
    let arithmetic = all.iter().filter(|i| code::ARITHMETIC.contains(&opcode_of(i)));
    let mut decorated: Vec<u32> = arithmetic.map(|i| i[2]).filter(|id| exact.contains(id)).collect();
    decorated.sort_unstable();
    decorated.dedup();
    let (mut kept, mut gone) = (Vec::with_capacity(all.len()), marks.clone());
    let mut inside = false;
    for instruction in all {
        match opcode_of(instruction) {
            code::FUNCTION => inside = marks.contains(&instruction[2]),
            code::FUNCTION_PARAMETER if inside => _ = gone.insert(instruction[2]),
            code::LABEL if inside => _ = gone.insert(instruction[1]),
            code::FUNCTION_END if inside => {
                inside = false;
                continue;
            }
            _ => {}
        }
        if !inside {
            kept.push(instruction);
        }
    }
    let mut out = words[..HEADER].to_vec();
    let mut decorations = Some(decorated);
    for instruction in kept {
        if !is_before_types(opcode_of(instruction)) {
            for id in decorations.take().into_iter().flatten() {
                out.extend([instruction_head(3, code::DECORATE), id, NO_CONTRACTION]);
            }
        }
        match opcode_of(instruction) {
            code::NAME if gone.contains(&instruction[1]) => {}
            _ if is_call(instruction) => {
                out.extend([
                    instruction_head(4, code::COPY_OBJECT),
                    instruction[1],
                    instruction[2],
                    instruction[4],
                ]);
            }
            _ => out.extend_from_slice(instruction),
        }
    }
    out
}

/// Returns the first word of an instruction.
pub(super) fn instruction_head(length: u32, opcode: u32) -> u32 {
    length << 16 | opcode
}

/// Returns whether an instruction precedes the types of a module, where decorations belong.
pub(super) fn is_before_types(opcode: u32) -> bool {
    use code::*;
    matches!(
        opcode,
        SOURCE_CONTINUED
            | SOURCE
            | SOURCE_EXTENSION
            | NAME
            | MEMBER_NAME
            | STRING
            | EXTENSION
            | EXT_INST_IMPORT
            | MEMORY_MODEL
            | ENTRY_POINT
            | EXECUTION_MODE
            | CAPABILITY
            | DECORATE
            | MEMBER_DECORATE
            | MODULE_PROCESSED
    )
}

/// Decodes a literal string.
pub(super) fn literal_string(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    String::from_utf8_lossy(&bytes.take_while(|byte| *byte != 0).collect::<Vec<u8>>()).into_owned()
}

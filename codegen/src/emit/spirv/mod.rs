//! SPIR-V as words: straight-line functions are inlined, consecutive blocks joined, exact operations decorated,
//! overrides made specialization constants, and lines those of the kernel's source.

mod inline;
mod lines;
mod spec_constants;
mod uncontracted;

pub use inline::inline_functions;
pub use lines::{SourceFile, set_source_lines};
pub use spec_constants::{SpecConstant, add_spec_constants};
pub use uncontracted::forbid_contraction;

/// Words before the first instruction: magic number, version, generator, bound of ids, and 0.
const HEADER: usize = 5;

/// Opcodes of the instructions that begin, end and join blocks.
mod opcode {
    pub const PHI: u32 = 245;
    pub const LOOP_MERGE: u32 = 246;
    pub const SELECTION_MERGE: u32 = 247;
    pub const LABEL: u32 = 248;
    pub const BRANCH: u32 = 249;
    pub const SWITCH: u32 = 251;
}

/// Splits a module into instructions.
fn split_instructions(words: &[u32]) -> Vec<&[u32]> {
    let mut rest = words.get(HEADER..).unwrap_or_default();
    let mut found = Vec::new();
    while let Some(first) = rest.first() {
        let length = ((first >> 16) as usize).clamp(1, rest.len());
        let (instruction, after) = rest.split_at(length);
        found.push(instruction);
        rest = after;
    }
    found
}

fn opcode_of(instruction: &[u32]) -> u32 {
    instruction[0] & 0xffff
}

/// Joins a block with the next one if it ends in a branch to it and nothing else refers to that label. naga begins each
/// function with a separate block for variables.
pub fn join_blocks(words: &[u32]) -> Vec<u32> {
    let all = split_instructions(words);
    let merges = |k: usize| k > 0 && matches!(opcode_of(all[k - 1]), opcode::LOOP_MERGE | opcode::SELECTION_MERGE);
    let mut users: std::collections::HashMap<u32, u32> = all
        .iter()
        .filter(|i| opcode_of(i) == opcode::LABEL)
        .map(|i| (i[1], 0))
        .collect();
    // A literal of a switch may equal a label; the block is then left unchanged.
    let controls = |i: &&&[u32]| matches!(opcode_of(i), opcode::PHI..=opcode::SWITCH if opcode_of(i) != opcode::LABEL);
    for word in all.iter().filter(controls).flat_map(|i| &i[1..]) {
        if let Some(count) = users.get_mut(word) {
            *count += 1;
        }
    }
    let mut out = words[..HEADER.min(words.len())].to_vec();
    let mut k = 0;
    while k < all.len() {
        let joins = opcode_of(all[k]) == opcode::BRANCH
            && !merges(k)
            && all
                .get(k + 1)
                .is_some_and(|next| opcode_of(next) == opcode::LABEL && next[1] == all[k][1] && users[&next[1]] == 1);
        if joins {
            k += 2;
        } else {
            out.extend_from_slice(all[k]);
            k += 1;
        }
    }
    out
}

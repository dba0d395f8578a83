//! Specialization constants. naga writes none, so the translated WGSL holds each override in a private variable with
//! its default; here a specialization constant takes the place of that initial value.

use super::uncontracted::{instruction_head, is_before_types, literal_string};
use super::{HEADER, opcode_of, split_instructions};
use std::collections::HashMap;

/// Opcodes, storage class and decoration of the instructions handled here.
mod code {
    pub const NAME: u32 = 5;
    pub const SPEC_CONSTANT_TRUE: u32 = 48;
    pub const SPEC_CONSTANT_FALSE: u32 = 49;
    pub const SPEC_CONSTANT: u32 = 50;
    pub const VARIABLE: u32 = 59;
    pub const DECORATE: u32 = 71;
    pub const PRIVATE: u32 = 6;
    pub const SPEC_ID: u32 = 1;
}

/// An override, and the variable that holds its default.
pub struct SpecConstant<'a> {
    /// Name of the variable.
    pub variable: &'a str,
    /// Name of the override.
    pub name: &'a str,
    /// Number by which hosts set it.
    pub id: u32,
    /// Bits of the default.
    pub default: u32,
    /// `true` of a boolean.
    pub is_bool: bool,
}

/// Gives each of the variables a specialization constant as its initial value.
pub fn add_spec_constants(words: &[u32], constants: &[SpecConstant<'_>]) -> Vec<u32> {
    let all = split_instructions(words);
    let (mut bound, mut made) = (words[3], HashMap::new());
    for instruction in &all {
        let [_, _, variable, code::PRIVATE, initial] = instruction[..] else {
            continue;
        };
        let is_name = |i: &&&[u32]| opcode_of(i) == code::NAME && i[1] == variable;
        let name = all.iter().find(is_name).map(|i| literal_string(&i[2..]));
        let constant = constants.iter().find(|of| name.as_deref() == Some(of.variable));
        if let (code::VARIABLE, Some(constant)) = (opcode_of(instruction), constant) {
            made.insert(variable, (bound, initial, constant));
            bound += 1;
        }
    }
    let mut out = words[..HEADER].to_vec();
    out[3] = bound;
    let mut is_decorated = false;
    for instruction in &all {
        if !is_decorated && !is_before_types(opcode_of(instruction)) {
            is_decorated = true;
            let mut ids: Vec<_> = made.values().map(|(own, _, constant)| (*own, constant.id)).collect();
            ids.sort_unstable();
            for (own, id) in ids {
                out.extend([instruction_head(4, code::DECORATE), own, code::SPEC_ID, id]);
            }
        }
        match (opcode_of(instruction), made.get(instruction.get(1).unwrap_or(&0))) {
            (code::NAME, Some((own, _, constant))) => {
                out.extend_from_slice(instruction);
                let text = literal_words(constant.name);
                out.extend([instruction_head(2 + text.len() as u32, code::NAME), *own]);
                out.extend(text);
            }
            (code::VARIABLE, _) if made.contains_key(&instruction[2]) => {
                let (own, initial, constant) = &made[&instruction[2]];
                let ty = all
                    .iter()
                    .find(|i| i.len() > 2 && defines_constant(i, *initial))
                    .map_or(0, |i| i[1]);
                out.extend(match (constant.is_bool, constant.default) {
                    (true, 0) => vec![instruction_head(3, code::SPEC_CONSTANT_FALSE), ty, *own],
                    (true, _) => vec![instruction_head(3, code::SPEC_CONSTANT_TRUE), ty, *own],
                    (false, bits) => vec![instruction_head(4, code::SPEC_CONSTANT), ty, *own, bits],
                });
                out.extend_from_slice(&instruction[..4]);
                out.push(*own);
            }
            _ => out.extend_from_slice(instruction),
        }
    }
    out
}

/// Returns whether an instruction is the constant with an id: `OpConstantTrue` to `OpConstantNull`.
fn defines_constant(instruction: &[u32], id: u32) -> bool {
    matches!(opcode_of(instruction), 41..=46) && instruction[2] == id
}

/// Encodes a literal string, which ends in at least one zero byte.
pub(super) fn literal_words(text: &str) -> Vec<u32> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize((text.len() / 4 + 1) * 4, 0);
    let words = bytes.chunks_exact(4);
    words
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect()
}

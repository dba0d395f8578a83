//! Inlining of straight-line functions. naga guards integer divisions, and Straightline conversions, by functions without a
//! branch; each would be a separate basic block.

use super::{HEADER, opcode_of, split_instructions};
use std::collections::HashMap;

/// Opcodes of declarations, functions, and the instructions whose operands are not all ids.
mod op {
    pub const NAME: u32 = 5;
    pub const EXT_INST: u32 = 12;
    pub const ENTRY_POINT: u32 = 15;
    pub const FUNCTION: u32 = 54;
    pub const FUNCTION_PARAMETER: u32 = 55;
    pub const FUNCTION_END: u32 = 56;
    pub const FUNCTION_CALL: u32 = 57;
    pub const DECORATE: u32 = 71;
    pub const VECTOR_SHUFFLE: u32 = 79;
    pub const COMPOSITE_CONSTRUCT: u32 = 80;
    pub const COMPOSITE_EXTRACT: u32 = 81;
    pub const COPY_OBJECT: u32 = 83;
    pub const CONVERT_F_TO_U: u32 = 109;
    pub const F_CONVERT: u32 = 115;
    pub const BITCAST: u32 = 124;
    pub const S_NEGATE: u32 = 126;
    pub const DOT: u32 = 148;
    pub const ANY: u32 = 154;
    pub const F_UNORD_GREATER_THAN_EQUAL: u32 = 191;
    pub const SHIFT_RIGHT_LOGICAL: u32 = 194;
    pub const BIT_COUNT: u32 = 205;
    pub const RETURN_VALUE: u32 = 254;
}

/// Inlines functions of a single block that only compute. A module without such functions is returned unchanged.
///
/// Each iteration removes one function, so there are at most as many iterations as functions.
pub fn inline_functions(words: &[u32]) -> Vec<u32> {
    let mut module = words.to_vec();
    while let Some(next) = without_one(&module) {
        module = next;
    }
    module
}

/// A function that can be inlined.
struct Straight<'w> {
    /// Id of the function.
    id: u32,
    params: Vec<u32>,
    body: Vec<&'w [u32]>,
    /// The id that it returns.
    value: u32,
}

impl<'w> Straight<'w> {
    /// Parses the function in `all`; returns `None` if it cannot be inlined.
    fn new(all: &[&'w [u32]]) -> Option<Straight<'w>> {
        let [head, inner @ .., last, _end] = all else {
            return None;
        };
        let params = inner
            .iter()
            .take_while(|i| opcode_of(i) == op::FUNCTION_PARAMETER)
            .count();
        let (params, inner) = inner.split_at(params);
        let (label, body) = inner.split_first()?;
        let is_straight = opcode_of(label) == super::opcode::LABEL
            && opcode_of(last) == op::RETURN_VALUE
            && body.iter().all(|i| first_literal(i).is_some());
        is_straight.then(|| Straight {
            id: head[2],
            params: params.iter().map(|param| param[2]).collect(),
            body: body.to_vec(),
            value: last[1],
        })
    }

    /// Returns whether the function defines an id.
    fn defines(&self, id: u32) -> bool {
        id == self.id || self.params.contains(&id) || self.body.iter().any(|i| i[2] == id)
    }
}

/// Returns the index of the first literal operand of a computation, counted in words from the instruction's first, or the
/// instruction's length if all operands are ids. `None` for every other instruction. The second word is the type, the third
/// the result.
fn first_literal(instruction: &[u32]) -> Option<usize> {
    match opcode_of(instruction) {
        // The instruction set is an id, its instruction number is a literal, and ids follow.
        op::EXT_INST => Some(4),
        op::COMPOSITE_EXTRACT => Some(4),
        op::VECTOR_SHUFFLE => Some(5),
        op::FUNCTION_CALL
        | op::COMPOSITE_CONSTRUCT
        | op::COPY_OBJECT
        | op::CONVERT_F_TO_U..=op::F_CONVERT
        | op::BITCAST
        | op::S_NEGATE..=op::DOT
        | op::ANY..=op::F_UNORD_GREATER_THAN_EQUAL
        | op::SHIFT_RIGHT_LOGICAL..=op::BIT_COUNT => Some(instruction.len()),
        _ => None,
    }
}

/// Returns the module with one function inlined and removed.
fn without_one(words: &[u32]) -> Option<Vec<u32>> {
    let all = split_instructions(words);
    let entries: Vec<u32> = all
        .iter()
        .filter(|i| opcode_of(i) == op::ENTRY_POINT)
        .map(|i| i[2])
        .collect();
    let starts = (0..all.len()).filter(|k| opcode_of(all[*k]) == op::FUNCTION);
    let mut spans = starts.filter_map(|first| {
        let length = all[first..].iter().position(|i| opcode_of(i) == op::FUNCTION_END)? + 1;
        Some((first, first + length))
    });
    let (span, straight) = spans.find_map(|(first, end)| {
        let straight = Straight::new(&all[first..end])?;
        // Straight functions that call others must wait until those are inlined.
        let calls = straight.body.iter().any(|i| opcode_of(i) == op::FUNCTION_CALL);
        (!calls && !entries.contains(&straight.id)).then_some(((first, end), straight))
    })?;
    let mut bound = *words.get(3)?;
    let mut copies: HashMap<u32, Vec<u32>> = HashMap::new();
    let mut functions = Vec::new();
    let declared = all.iter().position(|i| opcode_of(i) == op::FUNCTION)?;
    for (_, instruction) in (declared..)
        .zip(&all[declared..])
        .filter(|(k, _)| *k < span.0 || *k >= span.1)
    {
        if opcode_of(instruction) == op::FUNCTION_CALL && instruction[3] == straight.id {
            inline_call(&straight, instruction, &mut bound, &mut copies, &mut functions);
        } else {
            functions.extend_from_slice(instruction);
        }
    }
    let mut out = words[..HEADER].to_vec();
    out[3] = bound;
    for instruction in &all[..declared] {
        match opcode_of(instruction) {
            op::NAME if straight.defines(instruction[1]) => {}
            // Decorations of a result apply to each of its copies.
            op::DECORATE if straight.defines(instruction[1]) => {
                for copy in copies.get(&instruction[1]).into_iter().flatten() {
                    out.extend([instruction[0], *copy]);
                    out.extend_from_slice(&instruction[2..]);
                }
            }
            _ => out.extend_from_slice(instruction),
        }
    }
    out.extend(functions);
    Some(out)
}

/// Emits the body of a function for one call.
fn inline_call(
    straight: &Straight<'_>,
    instruction: &[u32],
    bound: &mut u32,
    copies: &mut HashMap<u32, Vec<u32>>,
    out: &mut Vec<u32>,
) {
    let [_, ty, result, _, args @ ..] = instruction else {
        return;
    };
    let mut stands_for: HashMap<u32, u32> = straight.params.iter().copied().zip(args.iter().copied()).collect();
    for computed in &straight.body {
        let own = match computed[2] == straight.value {
            true => *result,
            false => {
                *bound += 1;
                *bound - 1
            }
        };
        let literals = first_literal(computed).unwrap_or(computed.len());
        let ids_again = match opcode_of(computed) {
            op::EXT_INST => literals + 1,
            _ => computed.len(),
        };
        out.extend([computed[0], computed[1], own]);
        for (k, operand) in computed.iter().enumerate().skip(3) {
            let is_id = k < literals || k >= ids_again;
            out.push(stands_for.get(operand).copied().filter(|_| is_id).unwrap_or(*operand));
        }
        stands_for.insert(computed[2], own);
        copies.entry(computed[2]).or_default().push(own);
    }
    if straight.body.iter().all(|computed| computed[2] != straight.value) {
        // The function returns a parameter or a constant.
        let value = stands_for.get(&straight.value).copied().unwrap_or(straight.value);
        out.extend([4 << 16 | op::COPY_OBJECT, *ty, *result, value]);
    }
}

//! Lines of the kernel's source in SPIR-V. naga writes the lines of the WGSL that it translates; the source map of that
//! WGSL turns them into those of the kernel.

use super::spec_constants::literal_words;
use super::uncontracted::instruction_head;
use super::{HEADER, opcode_of, split_instructions};
use crate::emit::print::PrintedStatement;
use std::collections::BTreeMap;

/// Opcodes of debug information.
mod code {
    pub const SOURCE_CONTINUED: u32 = 2;
    pub const SOURCE: u32 = 3;
    pub const STRING: u32 = 7;
    pub const LINE: u32 = 8;
    pub const FUNCTION_END: u32 = 56;
    pub const NO_LINE: u32 = 317;
}

/// Source language of `OpSource`: unknown. Readers of SPIR-V refuse languages that are newer than they are.
const UNKNOWN: u32 = 0;

/// Number of words of text in one instruction. An instruction has 65 535 words at most.
const WORDS: usize = 0xfff0;

/// A file of the source.
pub struct SourceFile<'a> {
    /// Path to show.
    pub path: &'a str,
    /// Contents.
    pub text: &'a str,
}

/// Replaces the lines of the WGSL by those of the source that its `statements` come from. `file` returns a file by the
/// index that places carry. Instructions that the source does not have are in no line.
pub fn set_source_lines<'a>(
    words: &[u32],
    statements: &[PrintedStatement<'_>],
    file: impl Fn(u32) -> SourceFile<'a>,
) -> Vec<u32> {
    let mut bound = words[3];
    let mut ids: BTreeMap<u32, u32> = BTreeMap::new();
    for statement in statements {
        ids.entry(statement.place.span.file).or_insert_with(|| {
            bound += 1;
            bound - 1
        });
    }
    let mut out = words[..HEADER].to_vec();
    out[3] = bound;
    let mut has_line = false;
    for instruction in split_instructions(words) {
        match opcode_of(instruction) {
            // naga writes a single string, the name of its source, and then that source.
            code::STRING => {
                for (index, id) in &ids {
                    push_text(&mut out, code::STRING, &[*id], &literal_words(file(*index).path));
                }
            }
            code::SOURCE => {
                for (index, id) in &ids {
                    push_source(&mut out, *id, file(*index).text);
                }
            }
            code::SOURCE_CONTINUED => {}
            code::LINE => {
                let line = instruction[2];
                let at = statements.partition_point(|statement| statement.last < line);
                match statements.get(at).filter(|statement| statement.first <= line) {
                    Some(statement) => {
                        let span = statement.place.span;
                        let id = ids[&span.file];
                        out.extend([instruction_head(4, code::LINE), id, span.line, span.column]);
                        has_line = true;
                    }
                    None if has_line => {
                        out.push(instruction_head(1, code::NO_LINE));
                        has_line = false;
                    }
                    None => {}
                }
            }
            opcode => {
                has_line &= opcode != code::FUNCTION_END;
                out.extend_from_slice(instruction);
            }
        }
    }
    out
}

fn push_text(out: &mut Vec<u32>, opcode: u32, operands: &[u32], text: &[u32]) {
    out.push(instruction_head((1 + operands.len() + text.len()) as u32, opcode));
    out.extend_from_slice(operands);
    out.extend_from_slice(text);
}

/// Adds a file with its text, in as many instructions as it needs. Each instruction's text is a string of its own.
fn push_source(out: &mut Vec<u32>, id: u32, text: &str) {
    let mut rest = text;
    let mut opcode = code::SOURCE;
    loop {
        let mut end = rest.len().min(4 * WORDS);
        while !rest.is_char_boundary(end) {
            end -= 1;
        }
        let (part, behind) = rest.split_at(end);
        let operands: &[u32] = match opcode {
            code::SOURCE => &[UNKNOWN, 0, id],
            _ => &[],
        };
        push_text(out, opcode, operands, &literal_words(part));
        if behind.is_empty() {
            return;
        }
        (rest, opcode) = (behind, code::SOURCE_CONTINUED);
    }
}

//! Methods of Rust and glam that are made of others, as text of the kernel language: what glam and the standard library
//! compute, in their order of operations, so that the bits are theirs.
//!
//! The texts are read after a kernel's files. Of what they define, only what the files mention is parsed, and only what the
//! kernel reaches is kept.

mod by_size;

use crate::diagnostic::{File, Span};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::fmt::Write;
use std::sync::OnceLock;

/// The file that places in these texts name: no file of a kernel.
pub const FILE: u32 = Span::LIBRARY;

/// Component names.
const LANES: [&str; 4] = ["x", "y", "z", "w"];

/// A function of these texts, a structure, or an enum.
struct Piece {
    /// Text between `impl` and its braces; empty for items outside of an `impl`.
    of: String,
    /// Words that ask for it: its name, of an enum the names of its variants too.
    names: Vec<String>,
    text: String,
}

/// The functions that `files` may call, as one text.
pub fn text(files: &[File]) -> String {
    let mut mentioned: HashSet<&str> = files.iter().flat_map(|file| words(&file.text)).collect();
    let mut taken = BTreeSet::new();
    let own: HashSet<&str> = files.iter().flat_map(|file| declared_types(&file.text)).collect();
    let structures: HashSet<&str> = pieces()
        .iter()
        .filter(|piece| piece.text.lines().any(|line| line.starts_with("struct ")))
        .flat_map(|piece| piece.names.iter().map(String::as_str))
        .collect();
    loop {
        let before = taken.len();
        for (k, piece) in pieces().iter().enumerate() {
            // A structure of the library's own is made by its functions alone, or written by its name.
            let structure = words(&piece.of).find(|word| structures.contains(word));
            let is_replaced = structure.is_some_and(|name| own.contains(name)) || piece.is_type_of(&own);
            let there = structure.is_none_or(|name| mentioned.contains(name)) && !is_replaced;
            let asked = piece.names.iter().any(|name| mentioned.contains(name.as_str()));
            // A derived `Default` calls `default` of the fields' types without mentioning its name.
            let derived = piece.names == ["default"] && mentioned.contains("Default");
            if there && (asked || derived) && taken.insert(k) {
                mentioned.extend(words(&piece.text));
            }
        }
        if taken.len() == before {
            break;
        }
    }
    written(taken.into_iter().map(|k| &pieces()[k]))
}

/// Names of the structures and enums that a text declares.
fn declared_types(text: &str) -> impl Iterator<Item = &str> {
    let mut before = "";
    words(text).filter(move |word| {
        let is_declared = before == "struct" || before == "enum";
        before = word;
        is_declared
    })
}

impl Piece {
    /// Name of the type that an `impl` is of, without its parameters; empty for items outside of an `impl`.
    fn type_name(&self) -> &str {
        let of = self.of.rsplit_once("> ").map_or(self.of.as_str(), |(_, of)| of);
        of.trim().split('<').next().unwrap_or_default()
    }

    /// Returns whether the piece declares one of `types`, or implements an operator for it.
    fn is_type_of(&self, types: &HashSet<&str>) -> bool {
        let is_type = self.text.starts_with("impl ") || declared_types(&self.text).next().is_some();
        is_type && self.names.first().is_some_and(|name| types.contains(name.as_str()))
    }
}

/// Functions of these texts that only others of them call.
const INTERNAL: [&str; 3] = ["divides_by", "multiplies", "to_vec4"];

/// Names of the functions that a type has in these texts.
pub fn function_names(ty: &str) -> Vec<&'static str> {
    let names = names_by_type().get(ty).into_iter().flatten().copied();
    names
        .filter(|name| name.starts_with(char::is_lowercase) && !INTERNAL.contains(name))
        .collect()
}

/// Returns whether a type has a function in these texts.
pub fn has_function(ty: &str, name: &str) -> bool {
    names_by_type().get(ty).is_some_and(|names| names.contains(name))
}

/// Names of the functions in these texts, by the type that has them. Every call of a method asks for them.
fn names_by_type() -> &'static HashMap<&'static str, BTreeSet<&'static str>> {
    static NAMES: OnceLock<HashMap<&str, BTreeSet<&str>>> = OnceLock::new();
    NAMES.get_or_init(|| {
        let mut by_type: HashMap<&str, BTreeSet<&str>> = HashMap::new();
        for piece in pieces() {
            let names = by_type.entry(piece.type_name()).or_default();
            names.extend(piece.names.iter().map(String::as_str));
        }
        by_type
    })
}

/// The functions, those of a type in an `impl` of it.
fn written<'p>(taken: impl Iterator<Item = &'p Piece>) -> String {
    let mut by_type: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for piece in taken {
        by_type.entry(&piece.of).or_default().push(&piece.text);
    }
    let mut text = String::new();
    for (of, functions) in by_type {
        let functions = functions.concat();
        let _ = match of {
            "" => writeln!(text, "{functions}"),
            of => writeln!(text, "impl{of} {{\n{functions}}}"),
        };
    }
    text
}

/// The words of a text that may be names.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
}

fn pieces() -> &'static [Piece] {
    static PIECES: OnceLock<Vec<Piece>> = OnceLock::new();
    PIECES.get_or_init(|| {
        let of_both = include_str!("both_integers.rs");
        let mut text = [
            include_str!("floats.rs"),
            include_str!("integers.rs"),
            of_both,
            &of_both.replace("i32", "u32"),
            include_str!("checked.rs"),
            include_str!("shapes.rs"),
            include_str!("option.rs"),
            include_str!("defaults.rs"),
            include_str!("iterators.rs"),
            include_str!("lazy.rs"),
            include_str!("orders.rs"),
            include_str!("workgroups.rs"),
            include_str!("quat.rs"),
        ]
        .concat();
        for lanes in 2..=4 {
            text += &include_str!("vectors.rs").replace("Vec3", &format!("Vec{lanes}"));
            by_lane(&mut text, lanes);
            by_size::write_vectors(&mut text, lanes);
            by_size::write_matrix(&mut text, lanes);
        }
        split(&text)
    })
}

/// A text as its functions. Those of an `impl` are indented by four, and what is in them by more.
fn split(text: &str) -> Vec<Piece> {
    let mut found: Vec<Piece> = Vec::new();
    let (mut of, mut attributes) = ("", String::new());
    for line in text.lines() {
        let piece = |names: Vec<String>, attributes: &mut String| Piece {
            of: of.to_owned(),
            names,
            text: format!("{}{line}\n", std::mem::take(attributes)),
        };
        let is_operator = found
            .last()
            .is_some_and(|piece| piece.text.starts_with("impl ") && !piece.text.trim_end().ends_with("\n}"));
        if is_operator && let Some(operator) = found.last_mut() {
            operator.text += &format!("{line}\n");
        } else if let Some((_, implementor)) = line.strip_prefix("impl ").and_then(|line| line.split_once(" for ")) {
            let name = implementor.trim_end_matches(" {").to_owned();
            found.push(piece(vec![name], &mut attributes));
        } else if let Some(header) = line.strip_prefix("impl") {
            of = header.trim_end_matches(" {");
        } else if line == "}" && !of.is_empty() {
            of = "";
        } else if line.starts_with("#[") {
            attributes = format!("{line}\n");
        } else if let Some(rest) = line.trim_start().strip_prefix("fn ") {
            let end = rest.find(['(', '<']).unwrap_or(rest.len());
            found.push(piece(vec![rest[..end].to_owned()], &mut attributes));
        } else if let Some((name, _)) = line.strip_prefix("    const ").and_then(|rest| rest.split_once(':')) {
            found.push(piece(vec![name.to_owned()], &mut attributes));
        } else if let Some(rest) = line.strip_prefix("enum ").or_else(|| line.strip_prefix("struct ")) {
            let end = rest.find(['<', ' ']).unwrap_or(rest.len());
            found.push(piece(vec![rest[..end].to_owned()], &mut attributes));
        } else if let Some(last) = found.last_mut() {
            if last.text.lines().any(|line| line.starts_with("enum ")) {
                let variant = words(line).next().filter(|word| word.starts_with(char::is_uppercase));
                last.names.extend(variant.map(str::to_owned));
            }
            last.text += &format!("{line}\n");
        }
    }
    found
}

/// Methods that are written out component by component.
fn by_lane(text: &mut String, lanes: usize) {
    let vector = format!("Vec{lanes}");
    let each = |part: &dyn Fn(&str) -> String| LANES[..lanes].iter().map(|l| part(l)).collect::<Vec<_>>().join(", ");
    let _ = writeln!(text, "impl {vector} {{");
    for name in ["rem_euclid", "div_euclid", "copysign"] {
        let parts = each(&|l| format!("self.{l}.{name}(other.{l})"));
        let _ = writeln!(
            text,
            "    fn {name}(self, other: {vector}) -> {vector} {{ {vector}::new({parts}) }}"
        );
    }
    for name in ["round", "signum"] {
        let parts = each(&|l| format!("self.{l}.{name}()"));
        let _ = writeln!(text, "    fn {name}(self) -> {vector} {{ {vector}::new({parts}) }}");
    }
    text.push_str("}\n");
    let bits = LANES[..lanes].iter().enumerate();
    let bits = bits.map(|(k, lane)| format!("(self.{lane} as u32) << {k}"));
    let bits = bits.collect::<Vec<_>>().join(" | ");
    let _ = writeln!(
        text,
        "impl B{vector} {{\n    fn default() -> B{vector} {{ B{vector}::FALSE }}\n    fn bitmask(self) -> u32 {{ {bits} }}\n}}"
    );
    for (prefix, number) in [("", "f32"), ("I", "i32"), ("U", "u32")] {
        let own = format!("{prefix}{vector}");
        let _ = writeln!(text, "impl {own} {{");
        for changed in &LANES[..lanes] {
            let parts = each(&|l| match l == *changed {
                true => "value".to_owned(),
                false => format!("self.{l}"),
            });
            let _ = writeln!(
                text,
                "    fn with_{changed}(self, value: {number}) -> {own} {{ {own}::new({parts}) }}"
            );
        }
        let choices = each(&|l| format!("if mask.{l} {{ yes.{l} }} else {{ no.{l} }}"));
        let _ = writeln!(
            text,
            "    fn select(mask: B{vector}, yes: {own}, no: {own}) -> {own} {{ {own}::new({choices}) }}"
        );
        let _ = writeln!(text, "    fn default() -> {own} {{ {own}::ZERO }}");
        let mapped = each(&|l| format!("f(self.{l})"));
        let _ = writeln!(
            text,
            "    fn map(self, f: impl Fn({number}) -> {number}) -> {own} {{ {own}::new({mapped}) }}"
        );
        positions(text, lanes);
        text.push_str("}\n");
    }
}

/// `min_position` and `max_position`, the first component that none is below or above, with glam's answers for NaN.
fn positions(text: &mut String, lanes: usize) {
    for (name, better, no_worse) in [("min_position", "<", "<="), ("max_position", ">", ">=")] {
        let _ = writeln!(text, "    fn {name}(self) -> usize {{");
        if lanes == 2 {
            let _ = writeln!(text, "        if self.x {no_worse} self.y {{ 0 }} else {{ 1 }}\n    }}");
            continue;
        }
        text.push_str("        let (mut best, mut index) = (self.x, 0);\n");
        for (k, lane) in LANES[..lanes].iter().enumerate().skip(1) {
            let _ = writeln!(
                text,
                "        if self.{lane} {better} best {{ best = self.{lane}; index = {k}; }}"
            );
        }
        text.push_str("        index\n    }\n");
    }
}

#[cfg(test)]
mod tests {
    use super::pieces;
    use crate::diagnostic::File;
    use crate::front;
    use std::sync::Arc;

    /// Compiles every function of the texts: nothing else checks those that no kernel reaches.
    #[test]
    fn every_function_has_its_types() {
        assert!(pieces().len() > 100, "{} functions", pieces().len());
        for piece in pieces()
            .iter()
            .filter(|piece| piece.text.contains("fn ") && !piece.text.starts_with("impl "))
        {
            let of = piece.type_name();
            let name = match of {
                "" => piece.names[0].clone(),
                of => format!("{of}::{}", piece.names[0]),
            };
            // The text mentions one function, so that only what that one needs is parsed.
            let kernel = File {
                path: "kernel.rs".to_owned(),
                text: format!("// {} {of}\n", piece.names.join(" ")),
            };
            let files = Arc::new(vec![kernel]);
            let mut parsed = front::parse(&files, &name).unwrap_or_else(|e| panic!("{name}:\n{e}"));
            assert!(parsed.library.functions.contains_key(&name), "{name}");
            if let Err(errors) = crate::infer::infer_types(&mut parsed.library, &parsed.reached) {
                panic!("{name}: {errors:?}");
            }
        }
    }
}

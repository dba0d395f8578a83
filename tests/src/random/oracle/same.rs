//! Changes that leave a kernel's meaning as it is: the same bits must come out.

use super::{Text, World, interpret};
use crate::random::Random;
use crate::random::forms::{FORMS, same};
use straightline_codegen::Kernel;

/// A change that leaves the meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Every variable and function has another name.
    Renamed,
    /// Expressions stand in functions of their own.
    Outlined,
    /// Variables are given away by `&mut` and come back as they were.
    Borrowed,
    /// Conditions are negated and their sides swapped.
    Swapped,
    /// The first iteration of loops stands before them.
    Peeled,
}

/// All of them.
pub const CHANGES: &[Change] = &[
    Change::Renamed,
    Change::Outlined,
    Change::Borrowed,
    Change::Swapped,
    Change::Peeled,
];

/// The text after a change; `None` if there is nothing to change.
pub fn apply(change: Change, source: &str, random: &mut Random) -> Option<String> {
    let text = match change {
        Change::Renamed => renamed(source),
        Change::Outlined => outlined(source, random)?,
        Change::Borrowed => borrowed(source, random)?,
        Change::Swapped => swapped(source),
        Change::Peeled => peeled(source)?,
    };
    (text != source).then_some(text)
}

/// Returns whether two texts have the same result, bit for bit, in every form that accepts both.
///
/// # Errors
///
/// What differs.
pub fn same_bits(a: &Text, b: &str, world: &World) -> Result<bool, String> {
    let first = Kernel::from_text("a.rs", &a.file(), "k");
    let text = Text {
        seed: a.seed,
        source: b.to_owned(),
    };
    let second = Kernel::from_text("b.rs", &text.file(), "k");
    let mut compared = false;
    for form in FORMS {
        let (Ok(x), Ok(y)) = (interpret(&first, *form, world), interpret(&second, *form, world)) else {
            continue;
        };
        for (place, x, y) in x.pairs(&y, world)? {
            if !same(x, y) {
                return Err(format!("{form}, {place}: {x:?} became {y:?}"));
            }
        }
        compared = true;
    }
    Ok(compared)
}

/// Numbered names (`v3`, `f1`) with another letter and number.
fn renamed(source: &str) -> String {
    let mut out = String::new();
    let mut word = String::new();
    for c in source.chars().chain(['\n']) {
        if c.is_ascii_alphanumeric() || c == '_' {
            word.push(c);
            continue;
        }
        let digits = word.trim_start_matches(|c: char| c.is_ascii_lowercase());
        let letters = &word[..word.len() - digits.len()];
        let own = ["v", "f", "m", "g", "h", "k", "e", "i", "t", "c", "n"].contains(&letters);
        if own
            && !["f32", "i32"].contains(&word.as_str())
            && !digits.is_empty()
            && digits.bytes().all(|b| b.is_ascii_digit())
        {
            out.push_str(&format!("other_{letters}_{digits}"));
        } else {
            out.push_str(&word);
        }
        word.clear();
        out.push(c);
    }
    out.pop();
    out
}

/// `let x: f32 = e;` becomes a call of a function that returns `e`, if `e` only depends on inputs.
fn outlined(source: &str, random: &mut Random) -> Option<String> {
    let mut lines: Vec<String> = source.lines().map(str::to_owned).collect();
    let begin = lines.iter().position(|l| l.starts_with("pub fn k("))?;
    let takes = |l: &String| {
        let l = l.trim();
        l.starts_with("let ") && l.contains(": f32 = ") && l.ends_with(';')
    };
    let found: Vec<usize> = (begin..lines.len()).filter(|k| takes(&lines[*k])).collect();
    let at = (!found.is_empty()).then(|| random.pick(&found))?;
    let line = lines[at].clone();
    let (head, value) = line.split_once(" = ")?;
    let value = value.trim_end_matches(';').to_owned();
    lines[at] = format!("{head} = outlined({value});");
    lines.insert(begin, "fn outlined(value: f32) -> f32 { value }".to_owned());
    Some(lines.join("\n") + "\n")
}

/// After `let mut x: f32 = e;` the variable goes through a function that takes it by `&mut`.
fn borrowed(source: &str, random: &mut Random) -> Option<String> {
    let mut lines: Vec<String> = source.lines().map(str::to_owned).collect();
    let begin = lines.iter().position(|l| l.starts_with("pub fn k("))?;
    let takes = |l: &String| {
        let l = l.trim();
        l.starts_with("let mut ") && l.contains(": f32 = ") && l.ends_with(';')
    };
    let found: Vec<usize> = (begin..lines.len()).filter(|k| takes(&lines[*k])).collect();
    let at = (!found.is_empty()).then(|| random.pick(&found))?;
    let name = lines[at].trim().strip_prefix("let mut ")?.split(':').next()?.to_owned();
    lines.insert(at + 1, format!("through(&mut {name});"));
    lines.insert(
        begin,
        "fn through(value: &mut f32) { let old = *value; *value = 7.0; let r = &mut *value; *r = old; }".to_owned(),
    );
    Some(lines.join("\n") + "\n")
}

/// `(if c { a } else { b })` becomes `(if !(c) { b } else { a })`.
fn swapped(source: &str) -> String {
    let mut text = source.to_owned();
    let mut from = 0;
    while let Some(at) = text[from..].find("(if ").map(|at| from + at) {
        from = at + 4;
        let Some((c, a, b, end)) = parts(&text, at) else {
            continue;
        };
        let new = format!("(if !({c}) {{{b}}} else {{{a}}})");
        text.replace_range(at..end, &new);
        from = at + 6;
    }
    text
}

/// Condition, sides and end of the `(if c { a } else { b })` at a place.
fn parts(text: &str, at: usize) -> Option<(String, String, String, usize)> {
    let matching = |open: usize| -> Option<usize> {
        let mut depth = 0;
        for (k, c) in text[open..].char_indices() {
            match c {
                '(' | '{' | '[' => depth += 1,
                ')' | '}' | ']' => {
                    depth -= 1;
                    if depth == 0 {
                        return Some(open + k);
                    }
                }
                '\n' => return None,
                _ => {}
            }
        }
        None
    };
    let close = matching(at)?;
    let mut k = at + 4;
    // The condition ends at the first brace outside of parentheses.
    while text.as_bytes()[k] != b'{' {
        k = match text.as_bytes()[k] {
            b'(' | b'[' => matching(k)? + 1,
            _ => k + 1,
        };
        if k >= close {
            return None;
        }
    }
    let then = matching(k)?;
    let rest = &text[then + 1..close];
    let other = rest.strip_prefix(" else {")?;
    let other = other.strip_suffix('}')?;
    Some((
        text[at + 4..k].trim().to_owned(),
        text[k + 1..then].to_owned(),
        other.to_owned(),
        close + 1,
    ))
}

/// `for x in 0..4 { ... }` that nothing leaves: its first iteration, and `for x in 1..4 { ... }`.
fn peeled(source: &str) -> Option<String> {
    let lines: Vec<&str> = source.lines().collect();
    for (k, line) in lines.iter().enumerate() {
        let Some(rest) = line.trim_start().strip_prefix("for ") else {
            continue;
        };
        let Some((name, range)) = rest.strip_suffix(" {").and_then(|r| r.split_once(" in ")) else {
            continue;
        };
        let Some((low, high)) = range.split_once("..") else {
            continue;
        };
        let ty = ["i32", "u32", "usize"]
            .into_iter()
            .find(|ty| low.ends_with(ty))
            .unwrap_or_default();
        let plain = |text: &str| text.trim_end_matches(ty).trim_end_matches('_').parse::<i64>().ok();
        let (Some(first), Some(end)) = (plain(low), plain(high.trim_start_matches('='))) else {
            continue;
        };
        if first >= end {
            continue;
        }
        let indent = line.len() - line.trim_start().len();
        let last = k + lines[k..]
            .iter()
            .position(|l| l.len() == indent + 1 && l.trim() == "}")?;
        let body = &lines[k + 1..last];
        let leaves = |l: &&str| l.contains("break") || l.contains("continue");
        if body.iter().any(leaves) || k > 0 && lines[k - 1].contains("unroll") {
            continue;
        }
        let mut out: Vec<String> = lines[..k].iter().map(|l| (*l).to_owned()).collect();
        out.push("{".to_owned());
        if name != "_" {
            // The type that the counter has in the loop it has here too.
            let counter = lines.iter().any(|l| l.contains(&format!("{name}: usize")));
            if counter {
                continue;
            }
            out.push(format!("for {name} in {first}{ty}..{} {{", first + 1));
        }
        out.extend(body.iter().map(|l| (*l).to_owned()));
        if name != "_" {
            out.push("}".to_owned());
        }
        out.push("}".to_owned());
        let dots = if high.starts_with('=') { "..=" } else { ".." };
        out.push(format!("for {name} in {}{ty}{dots}{end} {{", first + 1));
        out.extend(lines[k + 1..].iter().map(|l| (*l).to_owned()));
        return Some(out.join("\n") + "\n");
    }
    None
}

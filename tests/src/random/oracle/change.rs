//! Kernels with a mistake in them: what rustc refuses, the generator must refuse too.

use super::{Rustc, Text, Verdict};
use crate::random::Random;
use crate::random::make::{Features, make};
use std::collections::BTreeMap;
use straightline_codegen::{Kernel, Settings};

/// rustc's errors on who owns and who borrows what, and on items that no kernel uses. The generator does not check these:
/// copies and references of the subset have one meaning whether or not rustc takes them.
const OWNERSHIP: &[&str] = &[
    "E0382", "E0499", "E0502", "E0503", "E0505", "E0506", "E0507", "E0508", "E0515", "E0597", "E0713", "E0716",
];

/// Verdicts on changed kernels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verdicts {
    /// Refused by both.
    pub refused: u64,
    /// Accepted by both.
    pub accepted: u64,
    /// Refused by rustc alone, for ownership.
    pub ownership: u64,
    /// Accepted by rustc alone, by the generator's error.
    pub stricter: BTreeMap<String, u64>,
}

/// A kernel that rustc refuses and the generator accepts.
#[derive(Clone, Debug)]
pub struct Lenient {
    /// The kernel.
    pub text: Text,
    /// The line that was changed, as it is now.
    pub line: String,
    /// rustc's error.
    pub error: String,
}

/// Changes one kernel of each seed, and compares what rustc and the generator say of it.
///
/// # Errors
///
/// rustc cannot be run.
pub fn judge_changed(
    rustc: &Rustc,
    seeds: std::ops::Range<u64>,
    features: Features,
) -> Result<(Verdicts, Vec<Lenient>), String> {
    let mut texts = Vec::new();
    let mut lines = Vec::new();
    for seed in seeds {
        let mut random = Random(seed ^ 0x6368_616e_6765);
        let source = reached(&make(seed, features).source);
        if let Some((source, line)) = changed(&source, &mut random) {
            texts.push(Text { seed, source });
            lines.push(line);
        }
    }
    let verdicts = rustc.judge(&texts)?;
    let (mut counts, mut lenient) = (Verdicts::default(), Vec::new());
    for ((text, verdict), line) in texts.into_iter().zip(verdicts).zip(lines) {
        let kernel = Kernel::from_text("changed.rs", &text.file(), "k");
        let ours = kernel.compile(&Settings::default());
        match (verdict, ours) {
            (Verdict::Accepted, Ok(_)) => counts.accepted += 1,
            (Verdict::Refused(_), Err(_)) => counts.refused += 1,
            // The mistake is in a function that the kernel does not reach.
            (Verdict::Refused(_), Ok(_)) if kernel.check_others().is_err() => counts.refused += 1,
            (Verdict::Accepted, Err(errors)) => {
                *counts
                    .stricter
                    .entry(errors.diagnostics[0].message.clone())
                    .or_default() += 1;
            }
            (Verdict::Refused(error), Ok(_)) if OWNERSHIP.iter().any(|code| error.starts_with(code)) => {
                counts.ownership += 1;
            }
            (Verdict::Refused(error), Ok(_)) => lenient.push(Lenient { text, line, error }),
        }
    }
    Ok((counts, lenient))
}

/// The text without functions, constants and traits that nothing mentions: those may hold anything.
fn reached(source: &str) -> String {
    let mut lines: Vec<&str> = source.lines().collect();
    loop {
        let gone = lines.iter().enumerate().find_map(|(k, line)| {
            let start = line.trim_start();
            let item = ["fn ", "const ", "trait "];
            let name = item.iter().find_map(|item| start.strip_prefix(item))?;
            let name = &name[..name.find(['(', '<', ':', ' '])?];
            let word = |text: &str| {
                text.match_indices(name).any(|(at, _)| {
                    let before = text[..at]
                        .chars()
                        .next_back()
                        .is_none_or(|c| !c.is_alphanumeric() && c != '_');
                    let after = text[at + name.len()..].chars().next();
                    before && after.is_none_or(|c| !c.is_alphanumeric() && c != '_')
                })
            };
            let indent = line.len() - line.trim_start().len();
            let closes = |l: &&str| l.trim() == "}" && l.len() == indent + 1;
            let last = if line.trim_end().ends_with(['}', ';']) {
                k
            } else {
                k + lines[k..].iter().position(closes)?
            };
            let elsewhere = lines.iter().enumerate().any(|(n, l)| (n < k || n > last) && word(l));
            (!elsewhere).then_some(k..=last)
        });
        match gone {
            Some(gone) => drop(lines.drain(gone)),
            None => {
                let before = lines.len();
                if !calls_the_trait(&lines) {
                    lines.retain(|line| !line.starts_with("impl Tr for"));
                }
                if lines.len() == before {
                    return lines.join("\n") + "\n";
                }
            }
        }
    }
}

/// Returns whether a line mentions the trait or its functions, other than the trait itself and its implementations, a line each.
fn calls_the_trait(lines: &[&str]) -> bool {
    let own = |line: &str| {
        let start = line.trim_start();
        let beginnings = ["impl Tr for", "trait Tr", "fn tr(", "fn twice("];
        beginnings.iter().any(|beginning| start.starts_with(beginning))
    };
    let mentions = |line: &str| [".tr(", ".twice(", "Tr"].iter().any(|word| line.contains(word));
    lines.iter().any(|line| !own(line) && mentions(line))
}

/// Replacements: each text, and the text that replaces it.
const CHANGES: &[(&str, &str)] = &[
    ("let mut ", "let "),
    ("&mut ", "&"),
    ("&mut ", ""),
    ("(&", "("),
    (": u32", ": i32"),
    (": i32", ": u32"),
    (": f32", ": i32"),
    (": usize", ": u32"),
    (": bool", ": u32"),
    ("-> u32", "-> i32"),
    ("-> f32", "-> u32"),
    ("-> i32", "-> f32"),
    (" as f32", " as i32"),
    (" as f32", ""),
    (" as u32", ""),
    (" as usize", ""),
    (" as usize", " as u32"),
    ("u32", "i32"),
    ("i32", "usize"),
    ("f32", "i32"),
    ("Vec2", "Vec3"),
    ("Vec4", "IVec4"),
    (".x", ".z"),
    (".y", ".w"),
    (".0", ".7"),
    (" + ", " && "),
    (" && ", " & "),
    (" < ", " + "),
    (" + ", " < "),
    (" & ", " && "),
    (" * ", " << "),
    ("true", "1"),
    ("false", "0.0"),
    ("1.0", "1"),
    ("0.5", "2"),
    ("0.25", "3"),
    ("2", "2.0"),
    ("3", "3.0"),
    ("1", "-1"),
    ("(*", "("),
    ("*", ""),
    (".min(", ".minimum("),
    ("as_vec", "as_ivec"),
    ("splat(", "new("),
    (".iter_mut()", ".iter()"),
    (".iter()", ""),
    ("&self", "self"),
    ("&mut self", "&self"),
    ("self.", ""),
    (" else ", " "),
    (";", ""),
    ("pixel", "p"),
    ("q", "p"),
    (" p", " q"),
    (" r", " q"),
    ("acc", "pixel"),
    (", ", ""),
    ("_ =>", "9 =>"),
    ("v1", "v2"),
    ("v2", "v3"),
    ("v4", "v1"),
    ("v3", "v5"),
    ("'l", "'m"),
    ("..=", ".."),
    ("[", "("),
    ("unroll", "roll"),
    ("const ", "let "),
];

/// The text with one change, and the line that was changed.
fn changed(source: &str, random: &mut Random) -> Option<(String, String)> {
    for _ in 0..30 {
        let (from, to) = random.pick(CHANGES);
        let found: Vec<usize> = source.match_indices(from).map(|(at, _)| at).collect();
        if found.is_empty() {
            continue;
        }
        let at = random.pick(&found);
        let text = format!("{}{to}{}", &source[..at], &source[at + from.len()..]);
        let start = text[..at].rfind('\n').map_or(0, |k| k + 1);
        let end = text[at..].find('\n').map_or(text.len(), |k| at + k);
        let line = text[start..end].trim().to_owned();
        // Lines before the kernel's own items mean nothing to the generator.
        if line.starts_with("pub fn k(")
            || line.starts_with("#[derive")
            || line.starts_with("///")
            || line.starts_with("pub ")
            // Effects of a function called through a reference: the generator may not see them at the call.
            || line.starts_with("fn apply_mut<")
        {
            continue;
        }
        return Some((text, line));
    }
    None
}

//! Making a failing kernel smaller: on its text, since rustc says what is still a kernel.

use super::{Failure, Rustc, Text, check};
use rayon::prelude::*;
use straightline_codegen::{Kernel, Settings};

/// Candidates that are tried at once.
const TOGETHER: usize = 80;

/// The smallest text found that differs in the same manner.
pub fn reduce(rustc: &Rustc, failure: &Failure) -> Failure {
    let mut best = failure.clone();
    let mut skip = 0;
    loop {
        let candidates = candidates(&best.text.source);
        if skip >= candidates.len() {
            return best;
        }
        // What the generator refuses shows nothing, and most that rustc refuses it refuses sooner.
        let texts: Vec<Text> = candidates[skip..]
            .par_iter()
            .take(TOGETHER)
            .map(|source| Text {
                seed: failure.text.seed,
                source: source.clone(),
            })
            .filter(|text| {
                let kernel = Kernel::from_text("random.rs", &text.file(), "k");
                kernel.compile(&Settings::default()).is_ok()
            })
            .collect();
        let mut found = Vec::new();
        differences(rustc, &texts, best.world, &mut found);
        let smaller = found.into_iter().filter(|f| f.difference.like(&best.difference));
        match smaller.min_by_key(|f| f.text.source.len()) {
            Some(smaller) => {
                best = smaller;
                eprintln!("{} bytes", best.text.source.len());
                skip = 0;
            }
            None => skip += TOGETHER,
        }
    }
}

/// The texts that differ. Some may not end, or take all of the stack: those are tried apart from the others.
fn differences(rustc: &Rustc, texts: &[Text], world: u64, found: &mut Vec<Failure>) {
    match check(rustc, texts, world) {
        Ok((_, failures)) => found.extend(failures),
        Err(_) if texts.len() > 1 => {
            let (left, right) = texts.split_at(texts.len() / 2);
            differences(rustc, left, world, found);
            differences(rustc, right, world, found);
        }
        Err(_) => {}
    }
}

/// Smaller texts: without some lines, with the inside of a block for the block, with simpler operands.
fn candidates(source: &str) -> Vec<String> {
    let lines: Vec<&str> = source.lines().collect();
    let mut found = Vec::new();
    let mut spans: Vec<(usize, usize)> = Vec::new();
    let mut open = Vec::new();
    for (k, line) in lines.iter().enumerate() {
        let line = line.trim();
        let closes = line.starts_with('}');
        let opens = line.ends_with('{');
        if closes && let Some(start) = open.pop() {
            spans.push((start, k));
        }
        if opens {
            open.push(k);
        } else if !closes {
            spans.push((k, k));
        }
    }
    spans.sort_by_key(|(start, end)| start.abs_diff(*end));
    for (start, end) in spans.iter().rev() {
        found.push(without(&lines, *start..=*end));
        if end > start {
            let inside: Vec<&str> = lines
                .iter()
                .enumerate()
                .filter(|(k, _)| k != start && k != end)
                .map(|(_, line)| *line)
                .collect();
            found.push(inside.join("\n") + "\n");
        }
    }
    simpler(source, &mut found);
    found.retain(|text| text.len() < source.len());
    found
}

fn without(lines: &[&str], gone: std::ops::RangeInclusive<usize>) -> String {
    let left = lines
        .iter()
        .enumerate()
        .filter(|(k, _)| !gone.contains(k))
        .map(|(_, line)| *line);
    left.collect::<Vec<_>>().join("\n") + "\n"
}

/// For each pair of parentheses: one of its operands, or a literal, in its place.
fn simpler(source: &str, found: &mut Vec<String>) {
    let bytes = source.as_bytes();
    let mut open = Vec::new();
    let mut pairs = Vec::new();
    for (k, b) in bytes.iter().enumerate() {
        match b {
            b'(' => open.push(k),
            b')' => {
                if let Some(start) = open.pop() {
                    pairs.push((start, k));
                }
            }
            _ => {}
        }
    }
    pairs.sort_by_key(|(start, end)| std::cmp::Reverse(end - start));
    for (start, end) in &pairs {
        if end - start < 4 {
            continue;
        }
        for literal in ["1.0", "2", "true", "1u32", "pixel", "q", "p"] {
            found.push(format!("{}{literal}{}", &source[..*start], &source[end + 1..]));
        }
        for (a, b) in pairs.iter().filter(|(a, b)| a > start && b < end).take(6) {
            found.push(format!(
                "{}{}{}",
                &source[..*start],
                &source[*a..=*b],
                &source[end + 1..]
            ));
        }
        for operator in [" + ", " - ", " * ", " & ", " | ", " ^ "] {
            let inner = &source[start + 1..*end];
            if let Some((left, right)) = inner.split_once(operator) {
                for side in [left, right] {
                    found.push(format!("{}({side}){}", &source[..*start], &source[end + 1..]));
                }
            }
        }
    }
}

//! Making a failing kernel smaller: on its text, since rustc says what is still a kernel.

use super::{Driver, Failure, Given, Rustc, Text, Ways, World, check, run};
use rayon::prelude::*;
use straightline_codegen::{Kernel, Settings};

/// Candidates that are tried at once.
const TOGETHER: usize = 80;

/// Filters candidates: keeps those with the same difference as the first text.
type Alike<'a> = dyn Fn(&[Text]) -> Result<Vec<Text>, String> + 'a;

/// The smallest text found that differs in the same manner.
pub fn reduce(rustc: &Rustc, failure: &Failure) -> Failure {
    let mut best = failure.clone();
    let alike = |texts: &[Text]| {
        let (_, failures) = check(rustc, texts, failure.world)?;
        let alike = failures.into_iter().filter(|f| f.difference.like(&failure.difference));
        Ok(alike.map(|f| f.text).collect())
    };
    best.text = smallest(&failure.text, &alike);
    if let Ok((_, mut failures)) = check(rustc, std::slice::from_ref(&best.text), failure.world)
        && let Some(failure) = failures.pop()
    {
        best.difference = failure.difference;
    }
    best
}

/// The smallest text found with which a driver does not do what rustc's program does, in the same form and manner.
pub fn reduce_on_driver(rustc: &Rustc, driver: &Driver, ways: Ways, text: &Text, world: u64) -> Text {
    let inputs = World::for_drivers(world);
    let off = |text: &Text, native: &Given| {
        let shaders = driver.shaders(std::slice::from_ref(text), ways).ok()?;
        driver
            .compare(shaders.first()?, &inputs, native, &mut Default::default())
            .err()
    };
    let natives = run(rustc, std::slice::from_ref(text), &inputs).unwrap_or_default();
    let Some(first) = natives.iter().flatten().find_map(|native| off(text, native)) else {
        return text.clone();
    };
    let alike = |texts: &[Text]| {
        let natives = run(rustc, texts, &inputs)?;
        let both = texts.iter().zip(natives);
        let alike = both.filter(|(text, native)| {
            let found = native.as_ref().ok().and_then(|native| off(text, native));
            found.is_some_and(|found| found.like(&first))
        });
        Ok(alike.map(|(text, _)| text.clone()).collect())
    };
    smallest(text, &alike)
}

/// The smallest text found that is one of those that `alike` gives of some candidates.
fn smallest(text: &Text, alike: &Alike<'_>) -> Text {
    let mut best = text.clone();
    let mut skip = 0;
    loop {
        let candidates = candidates(&best.source);
        if skip >= candidates.len() {
            return best;
        }
        // A refused candidate shows nothing, and the generator refuses most that rustc refuses, sooner.
        let texts: Vec<Text> = candidates[skip..]
            .par_iter()
            .take(TOGETHER)
            .map(|source| Text {
                seed: text.seed,
                source: source.clone(),
            })
            .filter(|text| {
                let kernel = Kernel::from_text("random.rs", &text.file(), "k");
                kernel.compile(&Settings::default()).is_ok()
            })
            .collect();
        let mut found = Vec::new();
        all_alike(&texts, alike, &mut found);
        match found.into_iter().min_by_key(|text| text.source.len()) {
            Some(smaller) => {
                best = smaller;
                eprintln!("{} bytes", best.source.len());
                skip = 0;
            }
            None => skip += TOGETHER,
        }
    }
}

/// The texts that differ alike. Some may not end, or take all of the stack: those are tried apart from the others.
fn all_alike(texts: &[Text], alike: &Alike<'_>, found: &mut Vec<Text>) {
    match alike(texts) {
        Ok(texts) => found.extend(texts),
        Err(_) if texts.len() > 1 => {
            let (left, right) = texts.split_at(texts.len() / 2);
            all_alike(left, alike, found);
            all_alike(right, alike, found);
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

//! Plain words: counts of what makes comments, names and documents hard to skim, each with a limit; and links that lead somewhere.
//!
//! A failure lists the places. Reword one of them, not necessarily the newest.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Words with which a comment should not open: a noun or a verb tells a reader who skims more.
const OPENINGS: &[&str] = &[
    "What", "Whether", "Who", "Whoever", "Whose", "Which", "Where", "How", "Nobody", "Somebody", "Those", "It", "Its",
    "One",
];

/// Words that have a plain term.
const DIALECT: &[&str] = &[
    "nobody",
    "somebody",
    "whoever",
    "whichever",
    "tell apart",
    "tells apart",
    "told",
    "goes round",
    "is born",
    "at home",
    "gives back",
    "for whom",
    "of one's own",
    "what is asked",
    "mend",
    "mends",
    "mended",
    "leaves aside",
    "stands there",
];

/// Names of one word that say enough on any type.
const SHORT_NAMES: &[&str] = &[
    "new", "from", "default", "main", "fmt", "next", "len", "drop", "eq", "hash", "cmp", "add", "sub", "mul", "div",
    "neg", "not", "index", "get", "push", "insert", "iter", "build", "parse", "print", "clone",
];

const MAX_WORDS: usize = 35;
const MAX_COLUMNS: usize = 120;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Files of the repository with an extension, without build outputs; paths relative to the root, and texts.
fn files(extension: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                if !name.starts_with('.') && !["target", "dist", "demo", "node_modules"].contains(&&*name) {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|own| own == extension) {
                let text = std::fs::read_to_string(&path).expect("a text");
                let relative = path.strip_prefix(root()).expect("a path below the root");
                found.push((relative.to_string_lossy().replace('\\', "/"), text));
            }
        }
    }
    found.sort();
    found
}

/// Places that break a rule, out of a number of places.
struct Count {
    found: Vec<String>,
    all: usize,
}

impl Count {
    /// Fails if more than `limit` of a hundred places break the rule.
    fn check_share(&self, what: &str, limit: f64) {
        let share = 100.0 * self.found.len() as f64 / self.all.max(1) as f64;
        assert!(self.all > 100, "{what}: only {} places were looked at", self.all);
        assert!(
            share <= limit,
            "{what}: {share:.1} % for {limit} %\n{}",
            self.found.join("\n")
        );
    }
}

/// The words of a line, without punctuation.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_alphanumeric() && c != '\'')
        .filter(|word| !word.is_empty())
}

fn has_dialect(line: &str) -> bool {
    let line = words(line).map(str::to_lowercase).collect::<Vec<_>>().join(" ");
    let line = format!(" {line} ");
    DIALECT.iter().any(|word| line.contains(&format!(" {word} ")))
}

/// The text of a line that is a comment.
fn comment_text(line: &str) -> Option<&str> {
    let text = line.trim().strip_prefix("//")?;
    Some(text.trim_start_matches(['/', '!']).trim())
}

fn is_source(path: &str) -> bool {
    !path.contains("/tests/errors/") && !path.contains("/templates/")
}

/// Returns whether a file is read where it stands: snapshots and templates are installed elsewhere, with words of kernels in them,
/// and explanations of codes are parts of `docs/errors.md`.
fn is_document(path: &str) -> bool {
    is_source(path) && !path.contains("/snapshots/") && !path.contains("/diagnostic/codes/")
}

/// Prose of a document: lines outside of code, tables and headings, with their numbers from 1.
fn prose(document: &str) -> Vec<(usize, &str)> {
    let mut in_code = false;
    let mut found = Vec::new();
    for (index, line) in document.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        } else if !in_code && !line.trim_start().starts_with(['|', '#', '<']) {
            found.push((index + 1, line));
        }
    }
    found
}

#[test]
fn comments_open_with_a_noun_or_a_verb() {
    let mut count = Count {
        found: Vec::new(),
        all: 0,
    };
    for (path, text) in files("rs").iter().filter(|(path, _)| is_source(path)) {
        let mut follows = false;
        for (index, line) in text.lines().enumerate() {
            let comment = comment_text(line);
            if let Some(comment) = comment.filter(|_| !follows) {
                count.all += 1;
                let first = comment.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
                if OPENINGS.contains(&first) || comment.starts_with("The same ") {
                    count.found.push(format!("{path}:{}: {comment}", index + 1));
                }
            }
            follows = comment.is_some();
        }
    }
    count.check_share("comments that open with a pronoun or a relative clause", 1.5);
}

#[test]
fn functions_say_what_they_do() {
    let mut count = Count {
        found: Vec::new(),
        all: 0,
    };
    let sources = files("rs").into_iter().filter(|(path, _)| is_source(path));
    for (path, text) in sources.filter(|(path, _)| !path.contains("/tests/") && !path.starts_with("tests/")) {
        for (index, line) in text.lines().enumerate() {
            let line = line
                .trim()
                .trim_start_matches("pub ")
                .trim_start_matches("pub(crate) ")
                .trim_start_matches("pub(super) ");
            let line = line.trim_start_matches("const ").trim_start_matches("unsafe ");
            let Some(rest) = line.strip_prefix("fn ") else { continue };
            count.all += 1;
            let end = rest
                .find(|c: char| !c.is_alphanumeric() && c != '_')
                .unwrap_or(rest.len());
            let name = rest[..end].trim_matches('_');
            if !name.contains('_') && !SHORT_NAMES.contains(&name) {
                count.found.push(format!("{path}:{}: {name}", index + 1));
            }
        }
    }
    count.check_share("functions named by one word", 30.0);
}

#[test]
fn words_are_the_fields_own() {
    let comments = files("rs")
        .into_iter()
        .filter(|(path, _)| is_source(path))
        .flat_map(|(path, text)| {
            let lines = text
                .lines()
                .enumerate()
                .filter_map(|(index, line)| Some((index + 1, comment_text(line)?.to_owned())));
            lines
                .map(|(line, text)| (format!("{path}:{line}"), text))
                .collect::<Vec<_>>()
        });
    let documents = files("md").into_iter().flat_map(|(path, text)| {
        let lines = prose(&text)
            .into_iter()
            .map(|(line, text)| (format!("{path}:{line}"), text.to_owned()));
        lines.collect::<Vec<_>>()
    });
    // The list of this file is made of such words.
    let lines = comments
        .chain(documents)
        .filter(|(place, text)| has_dialect(text) && !place.contains("studies/plain.rs"));
    let found: Vec<String> = lines.map(|(place, text)| format!("{place}: {text}")).collect();
    assert!(
        found.len() <= 10,
        "{} lines have words with a plain term\n{}",
        found.len(),
        found.join("\n")
    );
}

#[test]
fn sentences_of_documents_are_short() {
    let mut count = Count {
        found: Vec::new(),
        all: 0,
    };
    for (path, text) in files("md") {
        let prose: Vec<&str> = prose(&text).into_iter().map(|(_, line)| line.trim()).collect();
        let prose = prose.join(" ");
        let mut sentence = 0;
        let mut start = String::new();
        let all: Vec<&str> = prose.split_whitespace().collect();
        for (k, word) in all.iter().enumerate() {
            if sentence == 0 {
                (*word).clone_into(&mut start);
            }
            sentence += 1;
            let begins = |next: &&str| next.starts_with(|c: char| c.is_ascii_uppercase() || c == '`' || c == '*');
            let ends = word.ends_with(['.', '!', '?']) && all.get(k + 1).is_none_or(begins);
            if ends || k + 1 == all.len() {
                if sentence > 3 {
                    count.all += 1;
                }
                if sentence > MAX_WORDS {
                    let from = k + 1 - sentence;
                    count.found.push(format!(
                        "{path}: {} ... ({sentence} words)",
                        all[from..from + 12].join(" ")
                    ));
                }
                sentence = 0;
            }
        }
    }
    count.check_share("sentences of more than 35 words", 5.0);
}

#[test]
fn lines_of_documents_fit_a_window() {
    let mut found = Vec::new();
    for (path, text) in files("md").into_iter().filter(|(path, _)| is_document(path)) {
        let long = |line: &str| line.chars().count() > MAX_COLUMNS && !line.contains("](http");
        found.extend(
            prose(&text)
                .into_iter()
                .filter(|(_, line)| long(line))
                .map(|(line, _)| format!("{path}:{line}")),
        );
    }
    assert!(
        found.is_empty(),
        "{} lines are longer than {MAX_COLUMNS} columns\n{}",
        found.len(),
        found.join("\n")
    );
}

/// Anchors of a document's headings, as GitHub makes them.
fn anchors(document: &str) -> HashSet<String> {
    let mut in_code = false;
    let mut found = HashSet::new();
    for line in document.lines() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }
        if in_code || !line.starts_with('#') {
            continue;
        }
        let heading = line.trim_start_matches('#').trim().to_lowercase();
        let kept = heading
            .chars()
            .filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
        found.insert(kept.map(|c| if c == ' ' { '-' } else { c }).collect());
    }
    found
}

/// Targets of a document's links into the repository.
fn links(document: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut in_code = false;
    for (index, line) in document.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }
        if in_code {
            continue;
        }
        let inline = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let reference = line.starts_with('[').then(|| line.split("]: ").nth(1)).flatten();
        for target in inline
            .chain(reference)
            .filter(|target| !target.contains("://") && !target.contains(' '))
        {
            found.push((index + 1, target.to_owned()));
        }
    }
    found
}

#[test]
fn links_lead_somewhere() {
    let mut broken = Vec::new();
    let mut all = 0;
    for (path, text) in files("md").into_iter().filter(|(path, _)| is_document(path)) {
        for (line, target) in links(&text) {
            all += 1;
            let (file, anchor) = target
                .split_once('#')
                .map_or((&*target, None), |(file, anchor)| (file, Some(anchor)));
            let folder = root().join(&path).parent().map(Path::to_path_buf).unwrap_or_default();
            let goal = if file.is_empty() {
                root().join(&path)
            } else {
                folder.join(file)
            };
            let is_there = match anchor {
                Some(anchor) if goal.extension().is_some_and(|kind| kind == "md") => {
                    std::fs::read_to_string(&goal).is_ok_and(|text| anchors(&text).contains(anchor))
                }
                _ => goal.exists(),
            };
            if !is_there {
                broken.push(format!("{path}:{line}: {target}"));
            }
        }
    }
    assert!(all > 100, "only {all} links were found");
    assert!(
        broken.is_empty(),
        "{} links lead nowhere\n{}",
        broken.len(),
        broken.join("\n")
    );
}

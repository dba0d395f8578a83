//! Lines of a body, grouped under comments that say where they come from.

use crate::ir::{Counter, Graph, Origin};
use std::collections::HashMap;

/// Lines written so far.
pub struct Listing<'g> {
    files: &'g [String],
    /// By name of a counter, how deep its loop is nested: outer counters come first in comments.
    depth: HashMap<&'g str, usize>,
    lines: Vec<String>,
    indent: usize,
    group: Group,
    /// Place and outer counters of the last comment.
    commented: Option<((u32, u32), Vec<Counter>)>,
}

/// Statements of one place in the source, under one comment.
#[derive(Default)]
struct Group {
    counters: Vec<Counter>,
    place: Option<(u32, u32)>,
    lines: Vec<String>,
}

impl<'g> Listing<'g> {
    /// No line yet, indented by one level.
    pub fn new(graph: &'g Graph) -> Self {
        let mut depth: HashMap<&str, usize> = HashMap::new();
        for origin in graph.origins.iter().flatten() {
            for (k, counter) in origin.counters.iter().enumerate() {
                let slot = depth.entry(counter.name.as_str()).or_default();
                *slot = k.max(*slot);
            }
        }
        Listing {
            files: &graph.files,
            depth,
            lines: Vec::new(),
            indent: 1,
            group: Group::default(),
            commented: None,
        }
    }

    /// All lines.
    pub fn lines(mut self) -> Vec<String> {
        self.flush();
        self.lines
    }

    /// What follows is one level deeper.
    pub fn indent(&mut self) {
        self.flush();
        self.indent += 1;
    }

    /// What follows is one level higher.
    pub fn dedent(&mut self) {
        self.flush();
        self.indent -= 1;
    }

    /// A statement, under a comment with those of the same place.
    pub fn statement(&mut self, origin: Option<&Origin>, line: &str) {
        if let Some(origin) = origin.filter(|o| !o.name.is_empty()) {
            let agrees = origin.counters.iter().all(|c| {
                let known = self.group.counters.iter().find(|known| known.name == c.name);
                known.is_none_or(|known| known.value == c.value)
            });
            if !agrees {
                self.flush();
            }
            for counter in &origin.counters {
                if !self.group.counters.contains(counter) {
                    self.group.counters.push(counter.clone());
                }
            }
            self.group.place.get_or_insert((origin.file, origin.line));
        }
        let indent = "    ".repeat(self.indent);
        self.group.lines.push(format!("{indent}{line}"));
    }

    /// A line that belongs to no group.
    pub fn line(&mut self, line: &str) {
        self.flush();
        let indent = "    ".repeat(self.indent);
        self.lines.push(format!("{indent}{line}"));
    }

    /// Ends a group: its comment, then its statements.
    fn flush(&mut self) {
        let group = std::mem::take(&mut self.group);
        if group.lines.is_empty() {
            return;
        }
        let indent = "    ".repeat(self.indent);
        let mut counters = group.counters;
        counters.sort_by_key(|c| self.depth.get(c.name.as_str()).copied().unwrap_or(0));
        // The same line for the next innermost counter speaks for itself: the names carry it.
        let outer = counters[..counters.len().saturating_sub(1)].to_vec();
        let place = group.place.map(|place| (place, outer));
        let repeated = place.is_some() && place == self.commented;
        if let Some(((file, line), _)) = &place
            && !repeated
        {
            let values: Vec<String> = counters.iter().map(|c| format!("{} {}", c.name, c.value)).collect();
            let file = self.files.get(*file as usize).map_or("", String::as_str);
            let colon = if values.is_empty() { "" } else { ": " };
            let said = super::text::comment(&format!("{}{colon}{file}:{line}", values.join(", ")));
            self.lines.push(format!("{indent}// {said}"));
            self.commented = place;
        }
        self.lines.extend(group.lines);
    }
}

//! Comments with the source locations of statements: one for each group of statements from the same place.

use super::ast::{Block, Stmt, StmtKind};
use super::prose::single_line_comment;
use std::collections::{HashMap, HashSet};
use straightline_evaluator::ir::{Counter, Graph, Origin};

/// Returns the statements with a comment before each group.
pub fn comment_groups<'g>(block: Block<'g>, graph: &'g Graph) -> Block<'g> {
    let mut depth: HashMap<&str, usize> = HashMap::new();
    for origin in graph.origins.iter().flatten() {
        for (k, counter) in origin.counters.iter().enumerate() {
            let slot = depth.entry(&*counter.name).or_default();
            *slot = k.max(*slot);
        }
    }
    let mut groups = Groups {
        graph,
        depth,
        group: Group::default(),
        commented: None,
        places: HashSet::new(),
    };
    groups.group_block(block)
}

/// Removes all comments, including those of nested blocks.
pub fn strip_comments(block: &mut Block<'_>) {
    block.retain(|stmt| !matches!(stmt.kind, StmtKind::Comment(_)));
    block.iter_mut().flat_map(Stmt::blocks_mut).for_each(strip_comments);
}

/// Number of counters in a comment that has no other text.
const OUTERMOST: usize = 2;

struct Groups<'g> {
    graph: &'g Graph,
    /// Nesting depth of the loop of each counter: comments list outer counters first.
    depth: HashMap<&'g str, usize>,
    group: Group<'g>,
    /// File and outer counters of the previous comment.
    commented: Option<(u32, Vec<Counter>)>,
    /// Files and lines that earlier comments have named.
    places: HashSet<(u32, u32)>,
}

/// Statements from one source location, under one comment.
#[derive(Default)]
struct Group<'g> {
    counters: Vec<Counter>,
    place: Option<(u32, u32)>,
    statements: Block<'g>,
}

impl<'g> Groups<'g> {
    fn group_block(&mut self, block: Block<'g>) -> Block<'g> {
        let mut out = Vec::new();
        for mut stmt in block {
            match &mut stmt.kind {
                StmtKind::For { body, .. } | StmtKind::Loop(body) => {
                    self.flush(&mut out);
                    *body = self.group_block(std::mem::take(body));
                    out.push(stmt);
                    // Statements after the loop belong neither to the group before it nor to that of its body.
                    self.commented = None;
                }
                StmtKind::If { then, otherwise, .. } => {
                    self.flush(&mut out);
                    *then = self.group_block(std::mem::take(then));
                    *otherwise = self.group_block(std::mem::take(otherwise));
                    out.push(stmt);
                }
                StmtKind::Barrier { .. } => {
                    self.flush(&mut out);
                    out.push(stmt);
                }
                _ => self.add(stmt, &mut out),
            }
        }
        self.flush(&mut out);
        out
    }

    fn add(&mut self, stmt: Stmt<'g>, out: &mut Block<'g>) {
        if let Some(origin) = stmt.source.origin.filter(|o| !o.name.is_empty()) {
            let agrees = origin.counters.iter().all(|c| {
                let known = self.group.counters.iter().find(|known| known.name == c.name);
                known.is_none_or(|known| known.value == c.value)
            });
            if !agrees {
                self.flush(out);
            }
            for counter in &*origin.counters {
                if !self.group.counters.contains(counter) {
                    self.group.counters.push(counter.clone());
                }
            }
            if origin.line != Origin::NOWHERE {
                self.group.place.get_or_insert((origin.file, origin.line));
            }
        }
        self.group.statements.push(stmt);
    }

    /// Ends a group: prints its comment, then its statements.
    fn flush(&mut self, out: &mut Block<'g>) {
        let group = std::mem::take(&mut self.group);
        if group.statements.is_empty() {
            return;
        }
        let mut counters = group.counters;
        counters.sort_by_key(|c| self.depth.get(&*c.name).copied().unwrap_or(0));
        // The innermost counter, or many counters, need no comment: the names contain them.
        let outer = counters[..counters.len().saturating_sub(1).min(OUTERMOST)].to_vec();
        if let Some((file, line)) = group.place
            && self.commented.as_ref() != Some(&(file, outer.clone()))
        {
            let before = self.commented.take().map(|(_, outer)| outer);
            // Prints a place's purpose once; later groups print only the next iteration of the surrounding loops.
            if self.places.insert((file, line)) {
                out.push(StmtKind::Comment(self.comment_text(&counters, file, line)).into());
            } else if before.is_none_or(|before| !before.starts_with(&outer)) && !outer.is_empty() {
                out.push(StmtKind::Comment(counter_values(&outer)).into());
            }
            self.commented = Some((file, outer));
        }
        out.extend(group.statements);
    }

    /// `sample 1, tap 2: what the function is for (file:line)`.
    fn comment_text(&self, counters: &[Counter], file: u32, line: u32) -> String {
        let values = counter_values(counters);
        let mut functions = self.graph.purposes.iter().rev();
        let purpose = functions.find(|function| function.file == file && function.line <= line);
        let purpose = purpose.map_or("", |purpose| purpose.words.as_str());
        let place = source_place(self.graph, file, line);
        let colon = if values.is_empty() { "" } else { ": " };
        let said = match purpose {
            "" => format!("{values}{colon}{place}"),
            purpose => format!("{values}{colon}{purpose} ({place})"),
        };
        single_line_comment(&said)
    }
}

/// Returns `file:line` of the source, as printed in a shader.
pub fn source_place(graph: &Graph, file: u32, line: u32) -> String {
    let path = graph.files.get(file as usize).map_or("", |path| shown_path(path));
    format!("{path}:{line}")
}

/// Returns a path as printed in a shader: of an absolute one only the file's name, because the rest would reveal the
/// author's file system.
pub fn shown_path(path: &str) -> &str {
    match std::path::Path::new(path).is_absolute() {
        true => path.rsplit(['/', '\\']).next().unwrap_or(path),
        false => path,
    }
}

/// `sample 1, tap 2`.
pub fn counter_values(counters: &[Counter]) -> String {
    let values: Vec<String> = counters.iter().map(|c| format!("{} {}", c.name, c.value)).collect();
    values.join(", ")
}

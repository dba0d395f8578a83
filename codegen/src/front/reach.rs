//! Which items a kernel reaches. Errors elsewhere are nobody's concern.

use super::scan;
use super::tree::{Const, Function};
use std::collections::{BTreeSet, HashMap};

/// Names of the functions (methods as `Type::name`) and constants that `entry` reaches by any mention of their
/// last segment. Coarse, never too small.
pub fn reach(functions: &HashMap<String, Function>, consts: &HashMap<String, Const>, entry: &str) -> BTreeSet<String> {
    let mut by_last: HashMap<&str, Vec<&String>> = HashMap::new();
    for name in functions.keys().chain(consts.keys()) {
        by_last.entry(last(name)).or_default().push(name);
    }
    let mut reached = BTreeSet::new();
    let mut pending = vec![entry.to_owned()];
    while let Some(name) = pending.pop() {
        if !reached.insert(name.clone()) {
            continue;
        }
        let mut names = BTreeSet::new();
        if let Some(function) = functions.get(&name) {
            scan::mentioned(&function.body, &mut names);
        }
        if let Some(constant) = consts.get(&name) {
            scan::mentioned_in(&constant.value, &mut names);
        }
        for mentioned in &names {
            pending.extend(
                by_last
                    .get(mentioned.as_str())
                    .into_iter()
                    .flatten()
                    .map(|n| (*n).clone()),
            );
        }
    }
    reached
}

fn last(name: &str) -> &str {
    name.rsplit("::").next().unwrap_or(name)
}

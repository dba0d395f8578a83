//! Report of the differences, function by function.

use crate::edges_of_functions::compare::{Mismatch, Verdict};
use crate::edges_of_functions::rights;
use std::collections::BTreeMap;

/// Results of all roads.
#[derive(Default)]
pub struct Report {
    /// Values that a driver has a right to, by the reason.
    rights: BTreeMap<&'static str, usize>,
    /// Values that none has, by function and how it differs: how many on each road, and the first.
    wrong: BTreeMap<(String, Verdict), (BTreeMap<String, usize>, String)>,
    /// Kernels that could not be compiled or run.
    broken: Vec<String>,
}

impl Report {
    /// Notes what was found on a road.
    pub fn add(&mut self, road: &str, found: Result<Vec<Mismatch>, String>) {
        let found = match found {
            Ok(found) => found,
            Err(why) => return self.broken.push(format!("{road}: {why}")),
        };
        for mismatch in found {
            if let Some(reason) = rights::of(&mismatch) {
                *self.rights.entry(reason).or_default() += 1;
                continue;
            }
            let key = (mismatch.text.to_owned(), mismatch.verdict);
            let (roads, _) = self
                .wrong
                .entry(key)
                .or_insert_with(|| (BTreeMap::new(), format!("{road}, {mismatch}")));
            *roads.entry(road.to_owned()).or_default() += 1;
        }
    }

    /// Values that a driver has a right to, a line for each reason. One that no value needs is an error.
    ///
    /// # Errors
    ///
    /// Everything that no driver has a right to, and the reasons that nothing needs.
    pub fn finish(self) -> Result<String, String> {
        let mut lines = self.broken;
        for ((function, verdict), (roads, first)) in self.wrong {
            let roads: Vec<String> = roads.iter().map(|(road, count)| format!("{road} {count}")).collect();
            lines.push(format!("`{function}`: {verdict}: {}; first {first}", roads.join(", ")));
        }
        let unused = rights::reasons().filter(|reason| !self.rights.contains_key(reason));
        lines.extend(unused.map(|reason| format!("no value is off because: {reason}")));
        let rights = self
            .rights
            .iter()
            .map(|(reason, count)| format!("{count} values: {reason}"));
        match lines.is_empty() {
            true => Ok(rights.collect::<Vec<_>>().join("\n")),
            false => Err(format!("{} differ:\n{}", lines.len(), lines.join("\n"))),
        }
    }
}

//! The items that a kernel reaches, with the errors in them.

use super::Items;
use crate::diagnostic::Diagnostic;
use crate::front::foreign::Import;
use crate::front::{Parsed, recursive, std};
use ::std::collections::BTreeSet;
use rustc_hash::FxHashSet;

impl Items {
    /// Lowers the items that `entry` needs, and collects the errors in them.
    ///
    /// # Errors
    ///
    /// Items that are defined twice, and types that hold themselves, with all other errors.
    pub fn lower_reached(mut self, entry: &str) -> Result<Parsed, Vec<Diagnostic>> {
        self.lower(entry, false)
    }

    /// As [`Items::lower_reached`], with the library's functions that the other items of the files need.
    pub fn lower_whole(mut self, entry: &str) -> Result<Parsed, Vec<Diagnostic>> {
        self.lower(entry, true)
    }

    fn lower(&mut self, entry: &str, whole: bool) -> Result<Parsed, Vec<Diagnostic>> {
        self.implement_all();
        // A method of a type itself goes before one of a trait.
        for (name, errors) in ::std::mem::take(&mut self.of_traits) {
            if !self.library.functions.contains_key(&name) {
                self.note_errors_of(&name, errors);
            }
        }
        let mut doubtful_names = FxHashSet::default();
        let foreign = self.imports.iter().filter_map(Import::foreign_name);
        let elsewhere = foreign.map(str::to_owned).collect();
        for import in ::std::mem::take(&mut self.imports) {
            doubtful_names.extend(import.unknown_name(&self.library).map(str::to_owned));
            if let Some((name, error)) = import.missing_error(&self.library, &elsewhere) {
                self.note_errors_of(&name, vec![error]);
            }
        }
        let reached = self.mentions.reached_items(self.errors.keys(), entry);
        let mut errors = Vec::new();
        for name in &reached {
            errors.extend(self.errors.get(name).into_iter().flatten().cloned());
        }
        if whole {
            let others = self
                .implementation_errors
                .drain(..)
                .filter(|error| !errors.contains(error));
            let others: Vec<Diagnostic> = others.collect();
            errors.extend(others);
        }
        let mut contradictions = ::std::mem::take(&mut self.duplicates);
        contradictions.extend(recursive::check_recursive_types(&self.library));
        if !contradictions.is_empty() {
            contradictions.extend(errors);
            return Err(contradictions);
        }
        let is_broken = |name: &String| self.errors.get(name).is_some_and(|errors| !errors.is_empty());
        let (broken, types): (Vec<&String>, Vec<&String>) = reached
            .iter()
            .filter(|name| is_broken(name))
            .partition(|name| self.library.functions.contains_key(*name) || self.library.consts.contains_key(*name));
        self.library.broken = broken.into_iter().cloned().collect();
        let doubtful = |name: &String| is_broken(name) || self.mentions.mentions_any(name, &types);
        let sound = reached.iter().filter(|name| !doubtful(name)).cloned().collect();
        let std_file = std::FILE;
        let written = |name: &&String| self.errors.get(*name).is_none_or(Vec::is_empty) && !reached.contains(*name);
        let functions = self.library.functions.iter();
        let functions = functions.filter(|(_, function)| function.span.file != std_file);
        let consts = self.library.consts.iter();
        let consts = consts.filter(|(_, constant)| constant.value.span.file != std_file);
        let own = functions.map(|(name, _)| name).chain(consts.map(|(name, _)| name));
        let others: BTreeSet<String> = own.filter(written).cloned().collect();
        let mut needed = reached.clone();
        if whole {
            for name in &others {
                needed.extend(self.mentions.reached_items(self.errors.keys(), name));
            }
            doubtful_names.extend(self.errors.keys().filter(|name| is_broken(name)).cloned());
        }
        let mut library = ::std::mem::take(&mut self.library);
        library
            .functions
            .retain(|name, function| function.span.file != std_file || needed.contains(name));
        if whole {
            library.broken = doubtful_names;
        }
        Ok(Parsed {
            library,
            reached: sound,
            others,
            unknown_names: self.unknown_names,
            errors,
        })
    }
}

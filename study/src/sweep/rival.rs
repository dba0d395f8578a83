//! Hand-written shaders that are measured beside emitted ones.

use super::{Space, SweepError, Variant};
use std::collections::BTreeMap;
use std::path::Path;
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::files;
use straightline_manifest::Stage;

/// Longest text of a shader that is read, in bytes.
const MOST_BYTES: u64 = 1 << 24;

/// A WGSL file that binds what the emitted shader binds, at the same numbers, and has an entry point of its name. In the file's
/// name `{AXIS}` stands for the value of an axis: `blur-{radius}.wgsl`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rival {
    /// The file's name.
    pub pattern: String,
}

impl Rival {
    /// The file for variants of these settings.
    pub fn file_for(&self, settings: &BTreeMap<String, String>) -> String {
        let mut file = self.pattern.clone();
        for (name, value) in settings {
            file = file.replace(&format!("{{{name}}}"), value);
        }
        file
    }

    /// Refuses what names no file for any group, or an axis that does not tell groups apart.
    pub(super) fn check(
        &self,
        space: &Space,
        baseline: &BTreeMap<String, String>,
        groups: &[Vec<Variant>],
    ) -> Result<(), SweepError> {
        let axes = space.axes();
        for (_, rest) in self.pattern.match_indices('{').map(|(at, _)| self.pattern.split_at(at)) {
            let Some(name) = rest
                .get(1..)
                .and_then(|rest| rest.split_once('}'))
                .map(|(name, _)| name)
            else {
                continue;
            };
            if !axes.iter().any(|axis| axis.name == name) || baseline.contains_key(name) {
                let tell: Vec<String> = axes.iter().map(|axis| axis.name.clone()).collect();
                return Err(SweepError::Bad(format!(
                    "`{{{name}}}` in {} is no axis by which variants are compared apart; there are {}, without those of the baseline",
                    self.pattern,
                    tell.join(", ")
                )));
            }
        }
        let firsts = groups.iter().filter_map(|group| group.first());
        let named: Vec<String> = firsts.map(|variant| self.file_for(&variant.axis_values())).collect();
        match named.first() {
            Some(first) if !named.iter().any(|file| Path::new(file).exists()) => {
                Err(SweepError::Bad(format!("there is no file {first} to measure against")))
            }
            _ => Ok(()),
        }
    }

    /// The text in place of one of `like`, whose bindings it takes.
    pub(super) fn load_emitted(&self, file: &str, like: &[&Emitted]) -> Result<Emitted, String> {
        let bytes =
            files::read_file(Path::new(file), MOST_BYTES).map_err(|error| format!("cannot read {file}: {error}"))?;
        let text = String::from_utf8(bytes).map_err(|_| format!("{file} is no UTF-8 text"))?;
        let module =
            naga::front::wgsl::parse_str(&text).map_err(|error| error.emit_to_string_with_path(&text, file))?;
        let mut why = format!("no variant could be made whose bindings {file} could take");
        for like in like.iter().filter(|like| like.manifest.block == [1, 1]) {
            let name = &like.manifest.entry_point;
            let stage = match like.manifest.stage {
                Stage::Compute => naga::ShaderStage::Compute,
                Stage::Fragment => naga::ShaderStage::Fragment,
            };
            let mut entries = module.entry_points.iter();
            let Some(entry) = entries.find(|entry| entry.name == *name && entry.stage == stage) else {
                why = format!("{file} has no {} entry point `{name}`", like.manifest.stage.name());
                continue;
            };
            let mut rival = (*like).clone();
            rival.manifest.hashes.clear();
            rival.manifest.workgroup_size = like.manifest.workgroup_size.map(|_| entry.workgroup_size);
            // Its memory is not known to be written first.
            rival.manifest.fills_memory = false;
            rival.files = BTreeMap::from([(Target::Wgsl, text.into_bytes())]);
            return Ok(rival);
        }
        Err(why)
    }
}

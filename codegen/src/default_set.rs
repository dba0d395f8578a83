//! The shaders in the repository's folder `shaders-out/`: SRAA with its default options for 4 and for 16 samples, and with
//! its loops left in the shader; an edge filter; and filters of quads.

use crate::compiled::Compiled;
use crate::emit::{EmitOptions, Target};
use crate::kernel::Kernel;
use crate::spec::Settings;
use std::collections::{BTreeMap, BTreeSet};
use straightline_evaluator::diagnostic::{Code, Errors};
use straightline_evaluator::policy::{Transport, Unroll};
use straightline_manifest::Stage;

/// A shader of the set.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name of its files, without extension.
    pub stem: &'static str,
    /// The built-in kernel.
    pub kernel: &'static str,
    /// Options that differ from their defaults.
    pub options: &'static [(&'static str, &'static str)],
    /// Unroll policy for its loops.
    pub unroll: Unroll,
    /// Transport of quad swaps between lanes.
    pub transport: Option<Transport>,
    /// Pipeline stage.
    pub stage: Stage,
}

const SAMPLES4: &[(&str, &str)] = &[("pattern", "latin4")];
const SAMPLES16: &[(&str, &str)] = &[("pattern", "latin16")];

/// Every shader of the set. The set is small, so that each shader can be read.
pub const ENTRIES: &[Entry] = &[
    kernel_entry("sraa4", "sraa", SAMPLES4, Unroll::Full, Stage::Compute),
    kernel_entry("sraa4-fragment", "sraa", SAMPLES4, Unroll::Full, Stage::Fragment),
    kernel_entry("sraa4-looped", "sraa", SAMPLES4, Unroll::None, Stage::Compute),
    kernel_entry("sraa16", "sraa", SAMPLES16, Unroll::Full, Stage::Compute),
    kernel_entry("tabula-rasa", "tabula_rasa", &[], Unroll::Full, Stage::Fragment),
    quad_entry("convolution3", "quad_convolution", &[], Transport::Subgroup),
    quad_entry("convolution3-block", "quad_convolution", &[], Transport::Block),
    quad_entry("upsampling", "quad_upsampling", &[], Transport::Subgroup),
    quad_entry("bilateral5-block", "quad_bilateral", &[], Transport::Block),
    quad_entry("pcf8-derivatives", "pcf", PCF8, Transport::Derivatives),
    quad_entry("pcss", "pcss", &[], Transport::Subgroup),
];

const PCF8: Options = &[("weights", "quadratic"), ("gradient", "prewitt")];

const fn quad_entry(stem: &'static str, kernel: &'static str, options: Options, transport: Transport) -> Entry {
    Entry {
        stem,
        kernel,
        options,
        unroll: Unroll::Full,
        transport: Some(transport),
        stage: match transport {
            Transport::Block => Stage::Compute,
            _ => Stage::Fragment,
        },
    }
}

type Options = &'static [(&'static str, &'static str)];

const fn kernel_entry(
    stem: &'static str,
    kernel: &'static str,
    options: Options,
    unroll: Unroll,
    stage: Stage,
) -> Entry {
    Entry {
        stem,
        kernel,
        options,
        unroll,
        transport: None,
        stage,
    }
}

/// Returns the languages that the shader can be written in.
fn supported_languages(compiled: &Compiled, options: &EmitOptions) -> Result<BTreeSet<Target>, Errors> {
    let mut languages = BTreeSet::new();
    for target in Target::ALL {
        match compiled.emit(&options.clone().targets([target])) {
            Ok(_) => drop(languages.insert(target)),
            Err(errors) if errors.first_code() == Some(Code::NotInTarget) => {}
            Err(errors) => return Err(errors),
        }
    }
    Ok(languages)
}

/// Emits every file of the set, by name: each shader in every language that supports it, and its manifest.
pub fn emit_files() -> Result<BTreeMap<String, Vec<u8>>, Errors> {
    let mut all = BTreeMap::new();
    for entry in ENTRIES {
        let options = entry
            .options
            .iter()
            .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        let settings = Settings::new()
            .set_all(options)
            .unroll(entry.unroll)
            .transport(entry.transport);
        let compiled = Kernel::builtin(entry.kernel)?.compile(&settings)?;
        let options = EmitOptions::new().stage(entry.stage);
        let languages = supported_languages(&compiled, &options)?;
        let emitted = compiled.emit(&options.targets(languages))?;
        all.extend(emitted.named_files(entry.stem));
    }
    Ok(all)
}

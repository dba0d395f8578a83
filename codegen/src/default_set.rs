//! The shaders that are emitted and checked in as `shaders-out/`: SRAA with its default options, for 4 and for 16
//! samples, in both stages, and with its loops kept; and the filters of quads.

use crate::diagnostic::Errors;
use crate::emit::{EmitError, EmitOptions, Target};
use crate::pipeline::{Kernel, Settings};
use crate::policy::{Transport, Unroll};
use std::collections::BTreeMap;
use straightline_manifest::Stage;

/// One shader of the set.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name of its files, without extension.
    pub stem: &'static str,
    /// The built-in kernel.
    pub kernel: &'static str,
    /// Options that are not at their defaults.
    pub options: &'static [(&'static str, &'static str)],
    /// What becomes of loops.
    pub unroll: Unroll,
    /// How lanes of quads hear from each other.
    pub transport: Option<Transport>,
    /// Pipeline stage.
    pub stage: Stage,
}

/// Why the set could not be made.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A kernel is wrong.
    #[error("{0}")]
    Kernel(Errors),
    /// A shader cannot be emitted.
    #[error(transparent)]
    Emit(#[from] EmitError),
}

const SAMPLES4: &[(&str, &str)] = &[("pattern", "latin4")];
const SAMPLES16: &[(&str, &str)] = &[("pattern", "latin16")];

/// Every shader of the set.
pub const ENTRIES: &[Entry] = &[
    entry("sraa4", SAMPLES4, Unroll::Full, Stage::Compute),
    entry("sraa4-fragment", SAMPLES4, Unroll::Full, Stage::Fragment),
    entry("sraa4-looped", SAMPLES4, Unroll::None, Stage::Compute),
    entry("sraa16", SAMPLES16, Unroll::Full, Stage::Compute),
    entry("sraa16-fragment", SAMPLES16, Unroll::Full, Stage::Fragment),
    entry("sraa16-looped", SAMPLES16, Unroll::None, Stage::Compute),
    quads("convolution3", "quad_convolution", &[], Transport::Subgroup),
    quads(
        "convolution3-derivatives",
        "quad_convolution",
        &[],
        Transport::Derivatives,
    ),
    quads("convolution3-block", "quad_convolution", &[], Transport::Block),
    quads("upsampling", "quad_upsampling", &[], Transport::Subgroup),
    quads("upsampling-block", "quad_upsampling", &[], Transport::Block),
    entry_of("downsampling", "downsampling"),
    quads("bilateral5", "quad_bilateral", &[], Transport::Subgroup),
    quads("bilateral5-block", "quad_bilateral", &[], Transport::Block),
    quads("pcf4", "pcf", &[("width", "four")], Transport::Subgroup),
    quads("pcf8", "pcf", PCF8, Transport::Subgroup),
    quads("pcf8-derivatives", "pcf", PCF8, Transport::Derivatives),
    quads("pcss", "pcss", &[], Transport::Subgroup),
    quads("ssao", "quad_ssao", &[], Transport::Subgroup),
    quads("ssao-block", "quad_ssao", &[], Transport::Block),
];

const PCF8: Options = &[("weights", "quadratic"), ("gradient", "prewitt")];

const fn entry_of(stem: &'static str, kernel: &'static str) -> Entry {
    Entry {
        stem,
        kernel,
        options: &[],
        unroll: Unroll::Full,
        transport: None,
        stage: Stage::Compute,
    }
}

const fn quads(stem: &'static str, kernel: &'static str, options: Options, transport: Transport) -> Entry {
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

const fn entry(
    stem: &'static str,
    options: &'static [(&'static str, &'static str)],
    unroll: Unroll,
    stage: Stage,
) -> Entry {
    Entry {
        stem,
        kernel: "sraa",
        options,
        unroll,
        transport: None,
        stage,
    }
}

/// Every file of the set by name: each shader in every language, and its manifest.
pub fn files() -> Result<BTreeMap<String, Vec<u8>>, Error> {
    let mut all = BTreeMap::new();
    for entry in ENTRIES {
        let options = entry
            .options
            .iter()
            .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
            .collect();
        let settings = Settings {
            options,
            unroll: entry.unroll,
            transport: entry.transport,
            ..Settings::default()
        };
        let compiled = Kernel::builtin(entry.kernel)
            .and_then(|k| k.compile(&settings))
            .map_err(Error::Kernel)?;
        // Metal has no fine derivatives.
        let derivatives = entry.transport == Some(Transport::Derivatives);
        let targets = Target::MODERN.into_iter().filter(|t| !derivatives || *t != Target::Msl);
        let emitted = compiled.emit(&EmitOptions::new().stage(entry.stage).targets(targets))?;
        all.extend(emitted.named(entry.stem));
    }
    Ok(all)
}

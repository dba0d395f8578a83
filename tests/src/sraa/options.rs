//! Sets of options: all values of each, and those that a device cannot run.

use super::Random;
use std::sync::LazyLock;
use straightline_codegen::Kernel;
use straightline_codegen::{OptionKind, OptionValues};

/// Names and values, as on the command line.
pub type Options = Vec<(String, String)>;

/// Every option with a few values, with all that it has: `(name, values)`.
pub fn choices() -> Vec<(String, Vec<String>)> {
    let kernel = Kernel::builtin("sraa").and_then(|kernel| kernel.options());
    let options = kernel.unwrap_or_else(|errors| panic!("{errors}"));
    let choices = options.into_iter().filter_map(|option| match option.kind {
        OptionKind::Choice(values) => Some((option.name, values.into_iter().map(|(value, _)| value).collect())),
        _ => None,
    });
    choices.collect()
}

/// Options from words.
pub fn options(words: &[(&str, &str)]) -> Options {
    words
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect()
}

/// Values of all options of the kernel `sraa` under a set.
pub fn values(set: &Options) -> OptionValues {
    static SRAA: LazyLock<Kernel> =
        LazyLock::new(|| Kernel::builtin("sraa").unwrap_or_else(|errors| panic!("{errors}")));
    let values = SRAA.option_values(set);
    values.unwrap_or_else(|errors| panic!("{set:?}:\n{errors}"))
}

/// The value of an option, or its default.
pub fn value<'a>(options: &'a Options, name: &str, default: &'a str) -> &'a str {
    let found = options.iter().rev().find(|(known, _)| known == name);
    found.map_or(default, |(_, value)| value.as_str())
}

/// Adds the data that an option needs: a list.
pub fn completed(mut options: Options) -> Options {
    if value(&options, "pattern", "latin4") == "listed" {
        options.push(("offsets".to_owned(), LISTED.to_owned()));
        options.push(("latin".to_owned(), "true".to_owned()));
    }
    if value(&options, "shading", "centre") == "listed" {
        options.push(("shaded".to_owned(), "1,3".to_owned()));
    }
    options
}

/// A Latin square of five samples, of no standard.
const LISTED: &str = "-0.4,0,-0.2,0.4,0,-0.2,0.2,0.2,0.4,-0.4";

/// Each value of each option by itself, all others at their defaults.
pub fn one_at_a_time() -> Vec<Options> {
    let single = choices().into_iter().flat_map(|(name, values)| {
        values
            .into_iter()
            .map(move |value| completed(vec![(name.clone(), value)]))
    });
    single.collect()
}

/// `count` sets with a random value for every option.
pub fn random(count: usize, seed: u64) -> Vec<Options> {
    let (choices, mut random) = (choices(), Random(seed));
    let mut set = || {
        let chosen = choices.iter().map(|(name, values)| {
            let k = (random.number() % values.len() as u64) as usize;
            (name.clone(), values[k].clone())
        });
        let mut set = completed(chosen.collect());
        // Conflicts with most other options: removed, so that those are tried.
        if refusal(&set) == Some(SEARCH_REFUSED) {
            set.retain(|(name, _)| name != "search" && name != "extra");
        }
        if refusal(&set) == Some(MASK_REFUSED) {
            set.retain(|(name, _)| name != "mask");
        }
        if refusal(&set) == Some(GUIDE_REFUSED) {
            set.retain(|(name, _)| name != "guide");
        }
        set
    };
    (0..count).map(|_| set()).collect()
}

/// Refusal of a search, and of further shading samples.
const SEARCH_REFUSED: &str = "what sets samples apart needs one shading sample a pixel, a box and shifted weights";

/// Refusal of taking light apart from paint.
const MASK_REFUSED: &str = "a mask leaves paint as it is";

/// Refusal of a guide with light that is taken apart.
const GUIDE_REFUSED: &str = "differences from a guide are no light that an albedo divides";

/// Why the kernel refuses a set, by what the options' documentation says; `None` if it takes it.
pub fn refusal(options: &Options) -> Option<&'static str> {
    let is = |name, wanted| value(options, name, "") == wanted;
    let pattern = value(options, "pattern", "latin4");
    if is("layout", "multisampled") && (pattern.starts_with("ordered") || pattern == "latin16") {
        return Some("hardware samples neither grids nor centred patterns of 16");
    }
    if is("normals", "packed") && (is("metric", "normals") || is("metric", "depth")) {
        return Some("a packed texel holds more than this metric reads");
    }
    if is("projection", "parallel") && (is("difference", "relative") || is("depth", "reversed-infinite")) {
        return Some("a parallel projection has no eye to be far from, and a far plane");
    }
    let alone = ["normals", "depth"].iter().any(|metric| is("metric", metric));
    if is("layout", "split") && (is("normals", "packed") || alone) {
        return Some("there is nothing to split");
    }
    let refuses = [
        ("shading", "listed"),
        ("resolve", "tent"),
        ("resolve", "gaussian"),
        ("resolve", "mitchell"),
        ("resolve", "lanczos"),
        ("normalisation", "paper"),
        ("normalisation", "epsilon"),
    ];
    if value(options, "demodulate", "none") != "none" && value(options, "mask", "none") != "none" {
        return Some(MASK_REFUSED);
    }
    if value(options, "demodulate", "none") != "none" && is("guide", "add") {
        return Some(GUIDE_REFUSED);
    }
    if is("demodulate", "albedo-shadow") && is("shading", "listed") {
        return Some("direct light is that of one shading sample");
    }
    if value(options, "demodulate", "none") != "none" && is("rest", "true") && is("shading", "listed") {
        return Some("what does not follow the albedo is that of one shading sample");
    }
    let sets_apart = value(options, "search", "none") != "none" || is("extra", "true");
    if sets_apart && refuses.iter().any(|(name, value)| is(name, value)) {
        return Some(SEARCH_REFUSED);
    }
    None
}

/// Samples of a texel that a device has to have for a set: 1 unless it is multisampled.
pub fn samples_needed(options: &Options) -> u32 {
    if value(options, "layout", "layers") != "multisampled" {
        return 1;
    }
    match value(options, "pattern", "latin4") {
        "standard8" => 8,
        "standard16" => 16,
        // Of five samples, eight are the next that hardware has; the oracle and the interpreter take five.
        "listed" => 5,
        _ => 4,
    }
}

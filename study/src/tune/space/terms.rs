//! Terms of the filter and the values that each can have, the one that computes most first; of what goes beyond the paper,
//! none first.

use super::Preset;
use crate::builtin::Setting;
use straightline_codegen::{Math, Precision};
use straightline_kernels::{OptionValue, OptionValues};

/// A term of a filter that can be left out, be had cheaper, or be added. `docs/tune.md` has the same table, with reasons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// Geometry samples of a pixel.
    Samples,
    /// Metric of surfaces: planes, normals, depth.
    Metric,
    /// Measure of differences in depth: absolute, or as shares of the depth.
    Difference,
    /// Taps of a sample, and their falloff with distance.
    Falloff,
    /// Filtering of pixels without geometric variation.
    Mask,
    /// Test that colours are finite.
    FiniteTest,
    /// Precision of floats.
    Precision,
    /// Algebra: exact, or such that may change roundings.
    Math,
    /// Pixels of one invocation.
    Block,
    /// Shading of pixels where the kernel `sraa_place` says.
    Placing,
    /// Search for surfaces that no tap shows.
    Search,
    /// Borrowing of light apart from paint and shadow.
    Light,
}

impl Term {
    /// Every term, in the order of a variant's values.
    pub const ALL: [Term; 12] = [
        Term::Samples,
        Term::Metric,
        Term::Difference,
        Term::Falloff,
        Term::Mask,
        Term::FiniteTest,
        Term::Precision,
        Term::Math,
        Term::Block,
        Term::Placing,
        Term::Search,
        Term::Light,
    ];

    /// Terms that go beyond the paper: the most general variant has none of them.
    pub const BEYOND: [Term; 3] = [Term::Placing, Term::Search, Term::Light];
}

/// A value that a term can have.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// In words, for tables: `16 samples`.
    pub label: String,
    /// Name of the loss where another value is chosen, and this is the most general one: `normals`. Of a term beyond the paper,
    /// name of the addition: `placing`.
    pub needs: String,
    /// Options of the kernel that it stands for.
    pub options: Vec<Setting>,
    /// Precision that shaders compute in.
    pub precision: Precision,
    /// Algebra that is done.
    pub math: Math,
    /// Pixels of one invocation, across and down.
    pub block: [u32; 2],
    /// True if the value does what the paper's filter does not.
    pub beyond: bool,
}

impl Value {
    pub(super) fn from_parts(label: &str, needs: &str, options: &[(&str, OptionValue)]) -> Value {
        Value {
            label: label.to_owned(),
            needs: needs.to_owned(),
            options: to_settings(options),
            precision: Precision::F32,
            math: Math::Exact,
            block: [1, 1],
            beyond: false,
        }
    }

    /// Returns whether the value gives an option this choice.
    pub(super) fn sets(&self, name: &str, choice: &str) -> bool {
        self.options
            .iter()
            .any(|(n, v)| n == name && v.choice() == Some(choice))
    }
}

/// A set of geometry samples that a subject was sampled at.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleSet {
    /// Geometry samples of a pixel.
    pub count: usize,
    /// The options that say where they are.
    pub options: Vec<Setting>,
}

/// Values that a subject and a device allow to be searched.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Offer {
    /// Sets of geometry samples, the largest first.
    pub samples: Vec<SampleSet>,
    /// True if there are normals.
    pub normals: bool,
    /// True if there is a camera, without which there are no planes.
    pub camera: bool,
    /// With which scale of depth most steps from surface to surface are 1 or more, where there are any.
    pub depth_scale: Option<f64>,
    /// Why half precision is not searched, if it is not.
    pub no_half: Option<String>,
    /// Why shading is not placed, if it is not.
    pub no_placing: Option<String>,
    /// Why nothing is searched for what no tap shows, if it is not.
    pub no_search: Option<String>,
    /// Why light is not borrowed apart from paint and shadow, if it is not.
    pub no_light: Option<String>,
    /// Presets of the kernel.
    pub presets: Vec<Preset>,
    /// Values of options that are not set.
    pub defaults: OptionValues,
    /// Options that all variants have. One that the search varies is thereby taken out of it.
    pub fixed: Vec<Setting>,
}

impl Offer {
    /// Returns whether all variants have an option, whatever its value.
    pub(in crate::tune) fn fixes(&self, option: &str) -> bool {
        self.fixed.iter().any(|(name, _)| name == option)
    }

    /// Why an option that all variants have is not searched.
    pub(super) fn fixed_reason(name: &str, value: &OptionValue) -> String {
        format!("{name}: it was set to {value}")
    }
}

/// The values of every term that an offer leaves open, before options are fixed. What is not searched is said in `left_aside`.
pub(super) fn offered_values(offer: &Offer, left_aside: &mut Vec<String>) -> [Vec<Value>; Term::ALL.len()] {
    let precision = match &offer.no_half {
        Some(why) => {
            left_aside.push(format!("half precision: {why}"));
            vec![Value::from_parts("f32", "f32", &[])]
        }
        None => vec![
            Value::from_parts("f32", "f32", &[]),
            Value {
                precision: Precision::F16,
                ..Value::from_parts("f16", "f16", &[])
            },
        ],
    };
    [
        sample_values(offer),
        metric_values(offer, left_aside),
        difference_values(offer),
        vec![
            Value::from_parts(
                "gaussian",
                "nine taps a sample, weighted",
                &[("falloff", choice_value("gaussian"))],
            ),
            Value::from_parts("no falloff", "nine taps a sample", &[("falloff", choice_value("none"))]),
            Value::from_parts("tent", "tent", &[("falloff", choice_value("tent"))]),
        ],
        mask_values(offer),
        vec![
            Value::from_parts("finite test", "finite test", &[("non-finite", choice_value("skip"))]),
            Value::from_parts(
                "no finite test",
                "no finite test",
                &[("non-finite", choice_value("spread")), ("guards", choice_value("none"))],
            ),
        ],
        precision,
        vec![
            Value::from_parts("exact", "exact mathematics", &[]),
            Value {
                math: Math::Fast,
                ..Value::from_parts("fast", "fast mathematics", &[])
            },
        ],
        vec![
            Value::from_parts("1x1", "one pixel an invocation", &[]),
            Value {
                block: [2, 2],
                ..Value::from_parts("2x2", "blocks of 2x2", &[])
            },
        ],
        placing_values(offer, left_aside),
        extension_values(
            (offer, &offer.no_search),
            Value::from_parts("not searched", "search", &[("search", choice_value("none"))]),
            Value::from_parts("searched", "search", &[("search", choice_value("five"))]),
            left_aside,
        ),
        light_values(offer, left_aside),
    ]
}

/// Sets of samples. Where shading is searched they leave it open.
fn sample_values(offer: &Offer) -> Vec<Value> {
    let value = |set: &SampleSet| {
        let label = format!("{} samples", set.count);
        let mut options = set.options.clone();
        options.retain(|(name, _)| name != "shading" || offer.no_placing.is_some());
        Value {
            options,
            ..Value::from_parts(&label, &label, &[])
        }
    };
    offer.samples.iter().map(value).collect()
}

fn metric_values(offer: &Offer, left_aside: &mut Vec<String>) -> Vec<Value> {
    let all = [
        ("planes-normals", "planes"),
        ("depth-normals", "normals"),
        ("normals", "normals"),
        ("depth", "depth"),
    ];
    let has = |name: &str| match name {
        "planes-normals" => offer.normals && offer.camera,
        "depth" => true,
        _ => offer.normals,
    };
    if !offer.normals {
        left_aside.push("normals and planes: the capture has no normals".to_owned());
    } else if !offer.camera {
        left_aside.push("planes: the capture has no camera".to_owned());
    }
    let values = all.iter().filter(|(name, _)| has(name));
    values
        .map(|(name, needs)| Value::from_parts(name, needs, &[("metric", choice_value(name))]))
        .collect()
}

/// Ways to compare depths. Two of them have a scale of their own, unless one was set: with one a tenth of the depth is a
/// step, and a floor that recedes to the horizon is one surface; the other is what the steps of the view call for.
fn difference_values(offer: &Offer) -> Vec<Value> {
    let coarse = [
        ("difference", choice_value("relative")),
        ("depth-scale", OptionValue::Number(0.1)),
    ];
    let mut values = vec![
        Value::from_parts("relative depth", "relative depth", &coarse[..1]),
        Value::from_parts("coarse relative depth", "coarse relative depth", &coarse),
        Value::from_parts(
            "absolute depth",
            "absolute depth",
            &[("difference", choice_value("absolute"))],
        ),
    ];
    let is_set = offer.fixes("depth-scale");
    if is_set {
        values.remove(1);
    }
    if let Some(scale) = offer.depth_scale.filter(|_| !is_set) {
        let name = "absolute depth, scaled";
        let options = [
            ("difference", choice_value("absolute")),
            ("depth-scale", OptionValue::Number(scale)),
        ];
        values.insert(2, Value::from_parts(name, name, &options));
    }
    values
}

/// A mask that looks within the pixel leaves out the most; one that looks around it, too, if that is set.
fn mask_values(offer: &Offer) -> Vec<Value> {
    let options = [("mask", choice_value("branch")), ("variation", choice_value("within"))];
    let count = if offer.fixes("variation") { 1 } else { 2 };
    vec![
        Value::from_parts(
            "no mask",
            "filter where geometry is even",
            &[("mask", choice_value("none"))],
        ),
        Value::from_parts("mask", "mask", &options[..count]),
    ]
}

fn placing_values(offer: &Offer, left_aside: &mut Vec<String>) -> Vec<Value> {
    let name = "placing";
    extension_values(
        (offer, &offer.no_placing),
        Value::from_parts("shaded at centres", name, &[("shading", choice_value("centre"))]),
        Value::from_parts("placed", name, &[("shading", choice_value("placed"))]),
        left_aside,
    )
}

/// Of `rest` that which is set, if it is; else highlights and haze are borrowed as they are.
fn light_values(offer: &Offer, left_aside: &mut Vec<String>) -> Vec<Value> {
    let name = "light apart from paint and shadow";
    let options = [
        ("demodulate", choice_value("albedo-shadow")),
        ("rest", OptionValue::Flag(true)),
    ];
    let count = if offer.fixes("rest") { 1 } else { 2 };
    extension_values(
        (offer, &offer.no_light),
        Value::from_parts(
            "light with its paint and shadow",
            name,
            &[("demodulate", choice_value("none"))],
        ),
        Value::from_parts(name, name, &options[..count]),
        left_aside,
    )
}

/// The values of a term that goes beyond the paper, or one that says nothing where there is a reason against it.
fn extension_values(
    (offer, no): (&Offer, &Option<String>),
    without: Value,
    with: Value,
    left_aside: &mut Vec<String>,
) -> Vec<Value> {
    let Some(why) = no else {
        return vec![without, Value { beyond: true, ..with }];
    };
    let is_own = |(name, _): &&Setting| without.options.iter().any(|(own, _)| own == name);
    left_aside.push(match offer.fixed.iter().find(is_own) {
        Some((name, value)) => Offer::fixed_reason(name, value),
        None => format!("{}: {why}", without.needs),
    });
    vec![without_options(without)]
}

/// Leaves a value's options to the user who fixed them.
pub(super) fn without_options(value: Value) -> Value {
    Value {
        options: Vec::new(),
        beyond: false,
        ..value
    }
}

/// A choice by its name.
fn choice_value(choice: &str) -> OptionValue {
    OptionValue::Choice(choice.to_owned())
}

fn to_settings(options: &[(&str, OptionValue)]) -> Vec<Setting> {
    let owned = options.iter().map(|(name, value)| ((*name).to_owned(), value.clone()));
    owned.collect()
}

//! What a search varies: terms of the filter, each with its values, the one that computes most first.

use std::collections::BTreeMap;
use straightline_codegen::{Math, Precision, Settings};

/// What can be left out of a filter, or be had cheaper. `docs/tune.md` has the same table, with reasons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// Geometry samples of a pixel.
    Samples,
    /// What tells surfaces apart: planes, normals, depth.
    Metric,
    /// Whether differences in depth count as shares of the depth.
    Difference,
    /// Which taps a sample has, and how distance counts.
    Falloff,
    /// Whether pixels without geometric variation are filtered.
    Mask,
    /// Whether colours are tested to be finite.
    FiniteTest,
    /// Precision of floats.
    Precision,
    /// Whether algebra may change roundings.
    Math,
    /// Pixels of one invocation.
    Block,
}

impl Term {
    /// Every term, in the order of [`Variant`]'s values.
    pub const ALL: [Term; 9] = [
        Term::Samples,
        Term::Metric,
        Term::Difference,
        Term::Falloff,
        Term::Mask,
        Term::FiniteTest,
        Term::Precision,
        Term::Math,
        Term::Block,
    ];
}

/// A value that a term can have.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// In words, for tables: `16 samples`.
    pub label: String,
    /// What is left out where another value is chosen, and this is the most general one: `normals`.
    pub needs: String,
    /// Options of the kernel that it stands for.
    pub options: Vec<(String, String)>,
    /// What shaders compute in.
    pub precision: Precision,
    /// Which algebra is done.
    pub math: Math,
    /// Pixels of one invocation, across and down.
    pub block: [u32; 2],
}

impl Value {
    fn of(label: &str, needs: &str, options: &[(&str, &str)]) -> Value {
        Value {
            label: label.to_owned(),
            needs: needs.to_owned(),
            options: owned(options),
            precision: Precision::F32,
            math: Math::Exact,
            block: [1, 1],
        }
    }
}

/// Ways to compare depths. Two of them have a scale of their own, unless one was set: with one a tenth of the depth is a step, and
/// a floor that recedes to the horizon is one surface; the other is what the steps of the view call for.
fn differences(offer: &Offer) -> Vec<Value> {
    let coarse = [("difference", "relative"), ("depth-scale", "0.1")];
    let mut values = vec![
        Value::of("relative depth", "relative depth", &coarse[..1]),
        Value::of("coarse relative depth", "coarse relative depth", &coarse),
        Value::of("absolute depth", "absolute depth", &[("difference", "absolute")]),
    ];
    let is_set = offer.fixed.iter().any(|(name, _)| name == "depth-scale");
    if is_set {
        values.remove(1);
    }
    if let Some(scale) = offer.depth_scale.filter(|_| !is_set) {
        let name = "absolute depth, scaled";
        let options = [("difference", "absolute"), ("depth-scale", &*scale.to_string())];
        values.insert(2, Value::of(name, name, &options));
    }
    values
}

fn owned(options: &[(&str, &str)]) -> Vec<(String, String)> {
    options
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect()
}

/// A set of geometry samples that a subject was sampled at.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleSet {
    /// Geometry samples of a pixel.
    pub count: usize,
    /// The options that say where they are.
    pub options: Vec<(String, String)>,
}

/// What a subject and a device allow to be searched.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Offer {
    /// Sets of geometry samples, the largest first.
    pub samples: Vec<SampleSet>,
    /// Whether there are normals.
    pub normals: bool,
    /// Whether there is a camera, without which there are no planes.
    pub camera: bool,
    /// With which scale of depth most steps from surface to surface are 1 or more, where there are any.
    pub depth_scale: Option<f64>,
    /// Why half precision is not searched, if it is not.
    pub no_half: Option<String>,
    /// Options that all variants have. One that the search varies is thereby taken out of it.
    pub fixed: Vec<(String, String)>,
}

/// Places of a variant's values in the lists of the terms, in the order of [`Term::ALL`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Variant(pub [usize; Term::ALL.len()]);

impl Variant {
    /// The place of a term's value.
    pub fn at(&self, term: Term) -> usize {
        self.0[term as usize]
    }

    /// The same but for one term.
    pub fn with(mut self, term: Term, value: usize) -> Variant {
        self.0[term as usize] = value;
        self
    }
}

/// All variants of the filter that are searched.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    terms: [Vec<Value>; Term::ALL.len()],
    /// Options that all variants have.
    pub fixed: Vec<(String, String)>,
    /// What is not searched, and why.
    pub left_aside: Vec<String>,
}

impl Space {
    /// The terms that the offer leaves open.
    ///
    /// # Errors
    ///
    /// If a fixed option leaves a term without any value.
    pub fn new(offer: &Offer) -> Result<Space, String> {
        let mut left_aside = Vec::new();
        let samples = offer.samples.iter().map(|set| Value {
            options: set.options.clone(),
            ..Value::of(
                &format!("{} samples", set.count),
                &format!("{} samples", set.count),
                &[],
            )
        });
        let metric = [
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
        let metric = metric.iter().filter(|(name, _)| has(name));
        let mut precision = vec![Value::of("f32", "f32", &[])];
        match &offer.no_half {
            Some(why) => left_aside.push(format!("half precision: {why}")),
            None => precision.push(Value {
                precision: Precision::F16,
                ..Value::of("f16", "f16", &[])
            }),
        }
        let mut terms = [
            samples.collect(),
            metric
                .map(|(name, needs)| Value::of(name, needs, &[("metric", name)]))
                .collect(),
            differences(offer),
            vec![
                Value::of("gaussian", "nine taps a sample, weighted", &[("falloff", "gaussian")]),
                Value::of("no falloff", "nine taps a sample", &[("falloff", "none")]),
                Value::of("tent", "tent", &[("falloff", "tent")]),
            ],
            vec![
                Value::of("no mask", "filter where geometry is even", &[("mask", "none")]),
                Value::of("mask", "mask", &[("mask", "branch")]),
            ],
            vec![
                Value::of("finite test", "finite test", &[("non-finite", "skip")]),
                Value::of(
                    "no finite test",
                    "no finite test",
                    &[("non-finite", "spread"), ("guards", "none")],
                ),
            ],
            precision,
            vec![
                Value::of("exact", "exact mathematics", &[]),
                Value {
                    math: Math::Fast,
                    ..Value::of("fast", "fast mathematics", &[])
                },
            ],
            vec![
                Value::of("1x1", "one pixel an invocation", &[]),
                Value {
                    block: [2, 2],
                    ..Value::of("2x2", "blocks of 2x2", &[])
                },
            ],
        ];
        let mut fixed = offer.fixed.clone();
        for (name, value) in &offer.fixed {
            let Some(term) = terms
                .iter_mut()
                .find(|values| values.iter().any(|v| v.options.iter().any(|(n, _)| n == name)))
            else {
                continue;
            };
            let stands_for = |(n, v): &(String, String)| {
                n == name && (v == value || (name == "mask" && v == "branch" && value == "select"))
            };
            term.retain(|v| v.options.iter().any(stands_for));
            if term.is_empty() {
                return Err(format!("`{name}={value}` leaves nothing to search among what there is"));
            }
            left_aside.push(format!("{name}: it was set to {value}"));
            fixed.retain(|(n, _)| n != name);
        }
        Ok(Space {
            terms,
            fixed,
            left_aside,
        })
    }

    /// The values of a term, the one that computes most first.
    pub fn values(&self, term: Term) -> &[Value] {
        &self.terms[term as usize]
    }

    /// A variant's value of a term.
    pub fn value(&self, variant: Variant, term: Term) -> &Value {
        &self.terms[term as usize][variant.at(term)]
    }

    /// The most general variant: of every term the value that computes most. It is the first of [`variants`](Self::variants).
    pub fn general(&self) -> Variant {
        Variant([0; Term::ALL.len()])
    }

    /// Every variant: all combinations but those that mean the same.
    pub fn variants(&self) -> Vec<Variant> {
        let mut all = vec![self.general()];
        for term in Term::ALL {
            let each = |v: &Variant| {
                (0..self.values(term).len())
                    .map(|k| v.with(term, k))
                    .collect::<Vec<_>>()
            };
            all = all.iter().flat_map(each).collect();
        }
        all.retain(|v| *v == self.canonical(*v));
        all
    }

    /// Where depth is not compared, how it is compared means nothing, and fast mathematics has next to nothing to do where nothing is
    /// tested: of variants that mean the same, the one that is searched.
    pub fn canonical(&self, variant: Variant) -> Variant {
        let variant = match self.value(variant, Term::FiniteTest).label.as_str() {
            "no finite test" => variant.with(Term::Math, 0),
            _ => variant,
        };
        match self.value(variant, Term::Metric).label.as_str() {
            "normals" => variant.with(Term::Difference, 0),
            _ => variant,
        }
    }

    /// The variants that differ in one term.
    pub fn neighbours(&self, variant: Variant) -> Vec<Variant> {
        let of = |term: Term| {
            let others = (0..self.values(term).len()).filter(move |k| *k != variant.at(term));
            others.map(move |k| self.canonical(variant.with(term, k)))
        };
        let mut found: Vec<Variant> = Term::ALL.into_iter().flat_map(of).collect();
        found.retain(|v| *v != variant);
        found.dedup();
        found
    }

    /// The variant that was run for this one's picture: blocks compute the same picture as single pixels, fast mathematics one that
    /// differs by roundings (what is measured is judged by its own), and a filter without the finite test the same if all colours are
    /// finite.
    pub fn picture_of(&self, variant: Variant, finite: bool) -> Variant {
        let single = variant.with(Term::Block, 0).with(Term::Math, 0);
        if finite {
            single.with(Term::FiniteTest, 0)
        } else {
            single
        }
    }

    /// How the kernel is generated for a variant.
    pub fn settings(&self, variant: Variant) -> Settings {
        let terms = Term::ALL.into_iter().filter(|term| self.counts(variant, *term));
        let block = self.value(variant, Term::Block).block;
        let mut options = self.fixed.clone();
        options.extend(terms.flat_map(|term| self.value(variant, term).options.iter().cloned()));
        // The pixels of a block go the same way: there the mask selects.
        for (name, value) in &mut options {
            if name == "mask" && value == "branch" && block != [1, 1] {
                *value = "select".to_owned();
            }
        }
        Settings {
            options,
            block,
            math: self.value(variant, Term::Math).math,
            ..Settings::default()
        }
    }

    /// Whether a term does anything in a variant: normals alone have no depths to compare.
    fn counts(&self, variant: Variant, term: Term) -> bool {
        term != Term::Difference || self.value(variant, Term::Metric).label != "normals"
    }

    /// A variant's precision.
    pub fn precision(&self, variant: Variant) -> Precision {
        self.value(variant, Term::Precision).precision
    }

    /// A variant in words, term by term.
    pub fn name(&self, variant: Variant) -> String {
        let labels = Term::ALL.into_iter().filter(|term| self.counts(variant, *term));
        let labels: Vec<&str> = labels.map(|term| self.value(variant, term).label.as_str()).collect();
        labels.join(", ")
    }

    /// The variant that has the kernel's defaults, if it is searched.
    pub fn of_defaults(&self, defaults: &BTreeMap<String, String>) -> Option<Variant> {
        let all_default = |value: &&Value| value.options.iter().all(|(name, v)| defaults.get(name) == Some(v));
        let mut variant = self.general();
        for term in Term::ALL {
            let values = self.values(term);
            let place = values.iter().position(|v| all_default(&v))?;
            variant = variant.with(term, place);
        }
        Some(self.canonical(variant))
    }

    /// What a variant lacks that the most general one has: the term, in words, and the variant with that put back.
    pub fn left_out(&self, variant: Variant) -> Vec<(String, Variant)> {
        let mut found = Vec::new();
        for term in Term::ALL {
            // A block leaves nothing out.
            if variant.at(term) == 0 || term == Term::Block {
                continue;
            }
            // Neither does another scale.
            let own = &self.value(variant, term).options;
            if term == Term::Difference && own.iter().any(|(_, value)| value == "relative") {
                continue;
            }
            if term == Term::Metric {
                let label = |k: usize| self.values(term)[k].label.as_str();
                let own = label(variant.at(term));
                for place in 0..variant.at(term) {
                    let lacks = match (label(place), own) {
                        ("planes-normals", _) => "planes",
                        ("depth-normals", "normals") => "depth",
                        ("depth-normals", "depth") => "normals",
                        _ => continue,
                    };
                    found.push((lacks.to_owned(), self.canonical(variant.with(term, place))));
                }
                continue;
            }
            let needs = self.values(term)[0].needs.clone();
            found.push((needs, self.canonical(variant.with(term, 0))));
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn offer() -> Offer {
        let set = |count: usize, pattern: &str| SampleSet {
            count,
            options: owned(&[("pattern", pattern)]),
        };
        Offer {
            samples: vec![set(16, "latin16"), set(8, "standard8"), set(4, "latin4")],
            normals: true,
            camera: true,
            depth_scale: Some(0.5),
            ..Offer::default()
        }
    }

    #[test]
    fn every_variant_is_searched_once() {
        let space = Space::new(&offer()).unwrap();
        let all = space.variants();
        // Thirteen ways to tell surfaces apart, normals alone having no depth to compare.
        // Fast mathematics where there are finite tests.
        assert_eq!(all.len(), 3 * 13 * 3 * 2 * 3 * 2 * 2);
        let settings: BTreeSet<String> = all
            .iter()
            .map(|v| format!("{:?} {}", space.settings(*v), space.precision(*v)))
            .collect();
        assert_eq!(settings.len(), all.len());
        assert_eq!(all[0], space.general());
        let general = space.settings(space.general());
        for option in [
            ("pattern", "latin16"),
            ("metric", "planes-normals"),
            ("non-finite", "skip"),
        ] {
            assert!(general.options.contains(&owned(&[option])[0]), "{option:?}");
        }
    }

    #[test]
    fn neighbours_differ_in_one_term_and_are_searched() {
        let space = Space::new(&offer()).unwrap();
        let all: BTreeSet<Variant> = space.variants().into_iter().collect();
        for variant in &all {
            for neighbour in space.neighbours(*variant) {
                assert!(all.contains(&neighbour), "{}", space.name(neighbour));
                assert_ne!(neighbour, *variant);
            }
        }
    }

    #[test]
    fn what_is_missing_or_fixed_is_not_searched_and_that_is_said() {
        let bare = Offer {
            normals: false,
            no_half: Some("the device has none".to_owned()),
            ..offer()
        };
        let space = Space::new(&bare).unwrap();
        assert_eq!(space.values(Term::Metric).len(), 1);
        assert_eq!(space.values(Term::Precision).len(), 1);
        assert_eq!(space.left_aside.len(), 2, "{:?}", space.left_aside);

        let set = Offer {
            fixed: owned(&[("falloff", "tent"), ("tau", "300"), ("depth-scale", "2")]),
            ..offer()
        };
        let space = Space::new(&set).unwrap();
        assert_eq!(space.values(Term::Falloff).len(), 1);
        assert!(
            space
                .settings(space.general())
                .options
                .contains(&owned(&[("tau", "300")])[0])
        );
        assert_eq!(space.values(Term::Difference).len(), 2);

        let no_such = Offer {
            fixed: owned(&[("metric", "planes-normals")]),
            normals: false,
            ..offer()
        };
        assert!(Space::new(&no_such).unwrap_err().contains("metric=planes-normals"));
    }

    #[test]
    fn a_block_selects_where_a_pixel_branches() {
        let space = Space::new(&offer()).unwrap();
        let masked = space.general().with(Term::Mask, 1);
        let mask = |v: Variant| {
            let settings = space.settings(v);
            settings.options.into_iter().find(|(n, _)| n == "mask").unwrap().1
        };
        assert_eq!(mask(masked), "branch");
        assert_eq!(mask(masked.with(Term::Block, 1)), "select");
    }

    #[test]
    fn what_is_left_out_is_named() {
        let space = Space::new(&offer()).unwrap();
        let names = |v: Variant| -> Vec<String> { space.left_out(v).into_iter().map(|(name, _)| name).collect() };
        assert!(names(space.general().with(Term::Block, 1)).is_empty());
        assert_eq!(names(space.general().with(Term::Metric, 3)), ["planes", "normals"]);
        assert_eq!(names(space.general().with(Term::Metric, 2)), ["planes", "depth"]);
        let four = space.general().with(Term::Samples, 2).with(Term::Precision, 1);
        assert_eq!(names(four), ["16 samples", "f32"]);
    }
}

//! Presets of the kernel as starting points of a search.

use super::{Offer, Space, Term, Value, Variant};
use crate::builtin::Setting;

/// Options for which a variant needs inputs or passes that only a searched term provides.
const NEEDY: [&str; 4] = ["shading", "search", "demodulate", "guide"];

/// A preset of the kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Preset {
    /// As in `--set preset=NAME`.
    pub name: String,
    /// Options that it sets.
    pub options: Vec<Setting>,
}

/// A preset as a variant.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Start {
    pub name: String,
    /// Options of the preset that its values of the terms leave open.
    pub options: Vec<Setting>,
    /// The preset at the fewest geometry samples.
    pub variant: Variant,
}

impl Space {
    /// Makes a start of each preset whose values are searched. An option that all variants have replaces that of a preset.
    pub(super) fn add_presets(&mut self, offer: &Offer) {
        for preset in &offer.presets {
            match self.find_start(offer, preset) {
                Ok(start) => self.starts.push(start),
                Err(option) => {
                    let line = format!("preset {}: {option} is not searched", preset.name);
                    self.left_aside.push(line);
                }
            }
        }
    }

    /// Returns the start of a preset, or the option that no searched value has.
    fn find_start(&self, offer: &Offer, preset: &Preset) -> Result<Start, String> {
        let own = |name: &str| preset.options.iter().find(|(n, _)| n == name).map(|(_, value)| value);
        // The option of a value that the preset has otherwise. A preset goes with any samples.
        let contradicts = |term: Term, value: &Value| {
            let default = |name: &str| offer.defaults.get(name).filter(|_| term != Term::Samples);
            let mut options = value.options.iter().filter(|(name, _)| !offer.fixes(name));
            options.find_map(|(name, v)| {
                let wanted = own(name).or(default(name)).filter(|wanted| *wanted != v)?;
                Some(format!("{name}={wanted}"))
            })
        };
        let mut variant = self.general();
        for term in Term::ALL {
            let values = self.term_values(term);
            let fits = |value: &Value| contradicts(term, value).is_none();
            // The fewest samples, of which the patterns of presets are.
            let found = match term {
                Term::Samples => values.iter().rposition(fits),
                _ => values.iter().position(fits),
            };
            let refused = || contradicts(term, &values[0]).unwrap_or_default();
            variant = variant.with_value(term, found.ok_or_else(refused)?);
        }
        let varied = Term::ALL.map(|term| &self.variant_value(variant, term).options);
        let is_varied = |name: &str| varied.iter().any(|options| options.iter().any(|(n, _)| n == name));
        let others = preset
            .options
            .iter()
            .filter(|(name, _)| !offer.fixes(name) && !is_varied(name));
        let options: Vec<Setting> = others.cloned().collect();
        if let Some((name, value)) = options.iter().find(|(name, _)| NEEDY.contains(&name.as_str())) {
            return Err(format!("{name}={value}"));
        }
        // A preset without other options is one of the variants by terms alone.
        variant.start = if options.is_empty() { 0 } else { self.starts.len() + 1 };
        Ok(Start {
            name: preset.name.clone(),
            options,
            variant,
        })
    }

    /// Returns each preset with each set of geometry samples.
    pub fn preset_variants(&self) -> Vec<Variant> {
        let samples = 0..self.term_values(Term::Samples).len();
        let starts = self.starts.iter();
        let all = starts.flat_map(|start| samples.clone().map(|k| start.variant.with_value(Term::Samples, k)));
        all.collect()
    }

    /// Name of the preset that a variant comes from, if it comes from one.
    pub fn preset_name(&self, variant: Variant) -> Option<&str> {
        self.start_of(variant).map(|start| start.name.as_str())
    }

    pub(super) fn start_of(&self, variant: Variant) -> Option<&Start> {
        let at_its_samples = |start: &&Start| {
            start.variant == variant.with_value(Term::Samples, start.variant.value_index(Term::Samples))
        };
        match variant.start {
            0 => self.starts.iter().find(at_its_samples),
            number => self.starts.get(number - 1),
        }
    }

    /// Name of a variant that comes from a preset: the preset, and the values that it has not.
    pub(super) fn changed_preset_name(&self, variant: Variant, start: &Start) -> String {
        let changed = Term::ALL.into_iter().filter(|term| {
            self.has_effect(variant, *term) && variant.value_index(*term) != start.variant.value_index(*term)
        });
        let changed: Vec<&str> = changed
            .map(|term| self.variant_value(variant, term).label.as_str())
            .collect();
        match changed[..] {
            [] => start.name.clone(),
            _ => format!("{} with {}", start.name, changed.join(", ")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{offer, parse_sraa};
    use super::*;
    use crate::builtin::{load_builtin, spell_settings};
    use std::collections::BTreeSet;

    /// An offer with the presets of the kernel.
    fn offer_of_presets() -> Offer {
        let kernel = load_builtin("sraa").expect("it is built in");
        let presets = kernel.presets().iter().map(|preset| Preset {
            name: preset.name.to_owned(),
            options: parse_sraa(&preset.options().collect::<Vec<_>>()),
        });
        Offer {
            presets: presets.collect(),
            defaults: kernel.option_values(&[]).expect("defaults"),
            ..offer()
        }
    }

    #[test]
    fn presets_are_variants_with_their_options() {
        let offer = offer_of_presets();
        let space = Space::new(&offer).unwrap();
        let starts = space.preset_variants();
        let names: Vec<String> = starts.iter().map(|v| space.variant_name(*v)).collect();
        let of_each = |name: &str| {
            [
                format!("{name} with 16 samples"),
                format!("{name} with 8 samples"),
                name.to_owned(),
            ]
        };
        assert_eq!(names, ["paper", "fast", "edges", "full"].map(of_each).concat());
        assert_eq!(space.left_aside, ["preset guided: guide=add is not searched"]);
        let kernel = load_builtin("sraa").expect("it is built in");
        for (preset, start) in offer.presets.iter().zip(starts.chunks(3)) {
            let values = |options: &[Setting]| kernel.option_values(&spell_settings(options)).expect("values");
            assert_eq!(
                values(&space.variant_options(start[2])),
                values(&preset.options),
                "{}",
                preset.name
            );
            assert_eq!(space.preset_name(start[0]), Some(preset.name.as_str()));
            assert!(space.canonical(start[2]) == start[2]);
        }
        // The paper's filter is one of the others by its terms; each other variant is still searched once.
        assert!(space.base_variants().contains(&starts[2]) && !starts[2].has_preset_options());
        assert!(
            starts[3..]
                .iter()
                .all(|v| v.has_preset_options() && !space.base_variants().contains(v))
        );
        assert_eq!(space.preset_name(space.general()), None);
    }

    #[test]
    fn a_variant_beside_a_preset_is_named_by_its_difference() {
        let space = Space::new(&offer_of_presets()).unwrap();
        let edges = space.preset_variants()[8];
        let changed = edges.with_value(Term::Falloff, 0).with_value(Term::FiniteTest, 1);
        assert_eq!(space.variant_name(changed), "edges with gaussian, no finite test");
        let options = space.variant_options(changed);
        for option in [
            ("search", "five"),
            ("search-threshold", "0.004"),
            ("falloff", "gaussian"),
            ("guards", "none"),
        ] {
            assert!(options.contains(&parse_sraa(&[option])[0]), "{option:?}");
        }
        // A term's own option replaces that of the preset.
        let coarse = space.variant_options(edges.with_value(Term::Difference, 1));
        let scales: Vec<&Setting> = coarse.iter().filter(|(name, _)| name == "depth-scale").collect();
        assert_eq!(scales, [&parse_sraa(&[("depth-scale", "0.1")])[0]]);
        assert!(space.neighbours(edges).iter().all(|v| v.has_preset_options()));
        // A preset keeps its mask with what goes beyond the paper, but not with light apart.
        let full = space.preset_variants()[11];
        assert_eq!(full.value_index(Term::Mask), 1);
        let apart = space.canonical(full.with_value(Term::Light, 1));
        assert_eq!((apart.value_index(Term::Mask), apart.value_index(Term::Search)), (0, 1));
    }

    #[test]
    fn presets_follow_what_is_set_and_what_there_is() {
        let set = Offer {
            fixed: parse_sraa(&[("search", "none"), ("shading", "centre"), ("tau", "300")]),
            ..offer_of_presets()
        };
        let space = Space::new(&set).unwrap();
        for start in space.preset_variants() {
            let options = space.variant_options(start);
            for option in [("tau", "300"), ("search", "none"), ("shading", "centre")] {
                let value = &parse_sraa(&[option])[0];
                let same: Vec<&Setting> = options.iter().filter(|(name, _)| *name == value.0).collect();
                assert_eq!(same, [value], "{}", space.variant_name(start));
            }
        }
        assert_eq!(space.preset_variants().len(), 4 * 3);
        let bare = Offer {
            camera: false,
            no_placing: Some("a capture keeps its own".to_owned()),
            no_search: Some("without a reference it cannot be judged".to_owned()),
            ..offer_of_presets()
        };
        let space = Space::new(&bare).unwrap();
        let names: BTreeSet<&str> = space
            .preset_variants()
            .into_iter()
            .filter_map(|v| space.preset_name(v))
            .collect();
        assert_eq!(names, BTreeSet::from(["fast", "paper"]));
        for line in [
            "preset edges: metric=planes-normals",
            "preset full: shading=placed",
            "preset guided: ",
        ] {
            assert!(
                space.left_aside.iter().any(|said| said.starts_with(line)),
                "{:?}",
                space.left_aside
            );
        }
    }
}

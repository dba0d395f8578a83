//! Space of a search: all variants of the filter, and their neighbourhood.

mod presets;
mod terms;

use crate::builtin::{Setting, spell_settings};
use presets::Start;
use straightline_codegen::{Precision, Settings};
use straightline_kernels::OptionValue;

pub use presets::Preset;
pub use terms::{Offer, SampleSet, Term, Value};

/// A variant of the filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Variant {
    /// Places of its values in the lists of the terms, in the order of [`Term::ALL`].
    values: [usize; Term::ALL.len()],
    /// Number of the preset whose other options it has, from 1; 0 if all others have their defaults.
    start: usize,
}

impl Variant {
    /// The place of a term's value.
    pub fn value_index(&self, term: Term) -> usize {
        self.values[term as usize]
    }

    /// Returns whether it has options of a preset that no term varies.
    pub fn has_preset_options(self) -> bool {
        self.start != 0
    }

    /// Changes one term.
    pub fn with_value(mut self, term: Term, value: usize) -> Variant {
        self.values[term as usize] = value;
        self
    }
}

/// A term beyond the paper, and a variant with it and without.
#[derive(Clone, Debug, PartialEq)]
pub struct Added {
    /// In words: placing, search, light apart from paint and shadow.
    pub term: String,
    /// True if the variant has it.
    pub is_there: bool,
    /// The variant without it.
    pub without: Variant,
    /// The variant with it.
    pub with: Variant,
}

/// All variants of the filter that are searched.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    terms: [Vec<Value>; Term::ALL.len()],
    starts: Vec<Start>,
    /// Options that all variants have.
    pub fixed: Vec<Setting>,
    /// Parts that are not searched, and why.
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
        let mut terms = terms::offered_values(offer, &mut left_aside);
        let mut fixed = offer.fixed.clone();
        for (name, value) in &offer.fixed {
            let varies = |values: &Vec<Value>| values.iter().any(|v| v.options.iter().any(|(n, _)| n == name));
            let Some(place) = terms.iter().position(varies) else {
                continue;
            };
            let term = &mut terms[place];
            let selects = name == "mask" && value.choice() == Some("select");
            let stands_for = |(n, v): &Setting| n == name && (v == value || (selects && v.choice() == Some("branch")));
            let line = Offer::fixed_reason(name, value);
            if !left_aside.contains(&line) {
                left_aside.push(line);
            }
            let found = term.iter().any(|v| v.options.iter().any(stands_for));
            // Terms beyond the paper have more values than are searched.
            if !found && Term::BEYOND.iter().any(|beyond| *beyond as usize == place) {
                term.truncate(1);
                term[0] = terms::without_options(term[0].clone());
                continue;
            }
            term.retain(|v| v.options.iter().any(stands_for));
            if term.is_empty() {
                return Err(format!("`{name}={value}` leaves nothing to search among what there is"));
            }
            fixed.retain(|(n, _)| n != name);
        }
        let light = &terms[Term::Light as usize][0];
        let is_apart = |(name, value): &Setting| name == "demodulate" && value.choice() != Some("none");
        if fixed.iter().chain(&light.options).any(is_apart) {
            terms[Term::Mask as usize].retain(|v| v.sets("mask", "none"));
            left_aside.push("mask: it would leave paint and shadow as they are".to_owned());
        }
        let mut space = Space {
            terms,
            starts: Vec::new(),
            fixed,
            left_aside,
        };
        space.add_presets(offer);
        Ok(space)
    }

    /// Leaves but the first value of a term, and says why.
    pub(in crate::tune) fn leave_aside(&mut self, term: Term, why: String) {
        self.terms[term as usize].truncate(1);
        self.left_aside.push(why);
    }

    /// The values of a term, the one that computes most first.
    pub fn term_values(&self, term: Term) -> &[Value] {
        &self.terms[term as usize]
    }

    /// A variant's value of a term.
    pub fn variant_value(&self, variant: Variant, term: Term) -> &Value {
        &self.terms[term as usize][variant.value_index(term)]
    }

    /// The most general variant: of every term the value that computes most, and nothing beyond the paper that is not set.
    /// It is the first of [`base_variants`](Self::base_variants).
    pub fn general(&self) -> Variant {
        Variant {
            values: [0; Term::ALL.len()],
            start: 0,
        }
    }

    /// Every variant that adds nothing to the most general one: all combinations but those that mean the same.
    pub fn base_variants(&self) -> Vec<Variant> {
        let mut all = vec![self.general()];
        for term in Term::ALL.into_iter().filter(|term| !Term::BEYOND.contains(term)) {
            all = self.vary_term(&all, term);
        }
        all.retain(|v| *v == self.canonical(*v));
        all
    }

    /// A variant with everything that goes beyond the paper, in all combinations, and nothing else changed. None of one
    /// that is not [`plain_variant`](Self::plain_variant).
    pub fn extended_variants(&self, variant: Variant) -> Vec<Variant> {
        let bare = self.without_extensions(variant);
        if self.plain_variant(bare) != bare {
            return Vec::new();
        }
        let mut all = vec![bare];
        for term in Term::BEYOND {
            all = self.vary_term(&all, term);
        }
        all.retain(|v| self.without_extensions(*v) != *v);
        all
    }

    fn vary_term(&self, variants: &[Variant], term: Term) -> Vec<Variant> {
        let values = 0..self.term_values(term).len();
        let all = variants
            .iter()
            .flat_map(|v| values.clone().map(move |k| v.with_value(term, k)));
        all.collect()
    }

    /// A variant without what is added to the most general one.
    pub fn without_extensions(&self, variant: Variant) -> Variant {
        Term::BEYOND.into_iter().fold(variant, |v, term| v.with_value(term, 0))
    }

    /// A variant as it can be added to: all pixels filtered, each by its own invocation, in whole floats, by exact
    /// mathematics. More is not searched, so that the space stays small.
    pub fn plain_variant(&self, variant: Variant) -> Variant {
        let cheaper = [Term::Mask, Term::Precision, Term::Math, Term::Block];
        cheaper.into_iter().fold(variant, |v, term| v.with_value(term, 0))
    }

    /// Returns the representative of equivalent variants. Without a comparison of depth, its mode is irrelevant; without
    /// tests, fast mathematics has almost nothing to do. Among equivalent additions beyond the paper, the plain variant is
    /// chosen, except of a preset, whose mask stays.
    pub fn canonical(&self, variant: Variant) -> Variant {
        let variant = match (self.without_extensions(variant) == variant, variant.start) {
            (true, _) => variant,
            (false, 0) => self.plain_variant(variant),
            // A mask would leave paint as it is, and a search is no block's.
            (false, _) if variant.value_index(Term::Light) != 0 => self.plain_variant(variant),
            (false, _) => variant.with_value(Term::Block, 0),
        };
        let variant = match self.variant_value(variant, Term::FiniteTest).label.as_str() {
            "no finite test" => variant.with_value(Term::Math, 0),
            _ => variant,
        };
        match self.variant_value(variant, Term::Metric).label.as_str() {
            "normals" => variant.with_value(Term::Difference, 0),
            _ => variant,
        }
    }

    /// The variants that differ in one term.
    pub fn neighbours(&self, variant: Variant) -> Vec<Variant> {
        let of = |term: Term| {
            let others = (0..self.term_values(term).len()).filter(move |k| *k != variant.value_index(term));
            others.map(move |k| self.canonical(variant.with_value(term, k)))
        };
        let mut found: Vec<Variant> = Term::ALL.into_iter().flat_map(of).collect();
        found.retain(|v| *v != variant);
        found.dedup();
        found
    }

    /// The variant that was run for this one's picture: blocks compute the same picture as single pixels, fast mathematics
    /// one that differs by roundings (what is measured is judged by its own), and a filter without the finite test the same
    /// if all colours are finite.
    pub fn picture_of(&self, variant: Variant, finite: bool) -> Variant {
        let single = variant.with_value(Term::Block, 0).with_value(Term::Math, 0);
        if finite {
            single.with_value(Term::FiniteTest, 0)
        } else {
            single
        }
    }

    /// Returns the settings with which the kernel is generated for a variant.
    pub fn variant_settings(&self, variant: Variant) -> Settings {
        Settings::new()
            .set_all(spell_settings(&self.variant_options(variant)))
            .block(
                self.variant_value(variant, Term::Block).block[0],
                self.variant_value(variant, Term::Block).block[1],
            )
            .math(self.variant_value(variant, Term::Math).math)
    }

    /// Options that a variant sets.
    pub fn variant_options(&self, variant: Variant) -> Vec<Setting> {
        let terms = Term::ALL.into_iter().filter(|term| self.has_effect(variant, *term));
        let block = self.variant_value(variant, Term::Block).block;
        let mut options = self.fixed.clone();
        let start = self.starts.get(variant.start.wrapping_sub(1));
        options.extend(terms.flat_map(|term| self.variant_value(variant, term).options.iter().cloned()));
        let unset = start.map_or(&[][..], |start| &start.options).iter();
        let unset: Vec<Setting> = unset
            .filter(|(name, _)| options.iter().all(|(n, _)| n != name))
            .cloned()
            .collect();
        options.extend(unset);
        // The pixels of a block go the same way: there the mask selects.
        for (name, value) in &mut options {
            if name == "mask" && value.choice() == Some("branch") && block != [1, 1] {
                *value = OptionValue::Choice("select".to_owned());
            }
        }
        options
    }

    /// Returns whether a term does anything in a variant: normals alone have no depths to compare.
    fn has_effect(&self, variant: Variant, term: Term) -> bool {
        term != Term::Difference || self.variant_value(variant, Term::Metric).label != "normals"
    }

    /// A variant's precision.
    pub fn precision(&self, variant: Variant) -> Precision {
        self.variant_value(variant, Term::Precision).precision
    }

    /// A variant in words: a preset and what is changed of it, or term by term; what is not added is not mentioned.
    pub fn variant_name(&self, variant: Variant) -> String {
        if let Some(start) = self.start_of(variant) {
            return self.changed_preset_name(variant, start);
        }
        let is_said = |term: &Term| !Term::BEYOND.contains(term) || self.variant_value(variant, *term).beyond;
        let labels = Term::ALL.into_iter().filter(|term| self.has_effect(variant, *term));
        let labels = labels.filter(is_said);
        let labels: Vec<&str> = labels
            .map(|term| self.variant_value(variant, term).label.as_str())
            .collect();
        labels.join(", ")
    }

    /// Returns whether a variant's pixels are shaded where the kernel `sraa_place` says.
    pub fn is_placed(&self, variant: Variant) -> bool {
        self.variant_value(variant, Term::Placing).sets("shading", "placed")
    }

    /// Terms that can be added to a variant, or were: in words, whether they were, and the variant without it and with it, both
    /// as they are searched.
    pub fn addable_terms(&self, variant: Variant) -> Vec<Added> {
        let open = Term::BEYOND
            .into_iter()
            .filter(|term| self.term_values(*term).len() > 1);
        let added = open.map(|term| Added {
            term: self.term_values(term)[0].needs.clone(),
            is_there: variant.value_index(term) != 0,
            without: self.plain_variant(variant).with_value(term, 0),
            with: self.plain_variant(variant).with_value(term, 1),
        });
        added.collect()
    }

    /// Terms that a variant lacks and the most general one has: the term, in words, and the variant with that put back.
    pub fn left_out(&self, variant: Variant) -> Vec<(String, Variant)> {
        let mut found = Vec::new();
        for term in Term::ALL {
            // A block leaves nothing out, and `added` has the terms that are added.
            if variant.value_index(term) == 0 || term == Term::Block || Term::BEYOND.contains(&term) {
                continue;
            }
            // Neither does another scale.
            let own = &self.variant_value(variant, term).options;
            if term == Term::Difference && own.iter().any(|(_, value)| value.choice() == Some("relative")) {
                continue;
            }
            if term == Term::Metric {
                let label = |k: usize| self.term_values(term)[k].label.as_str();
                let own = label(variant.value_index(term));
                for place in 0..variant.value_index(term) {
                    let lacks = match (label(place), own) {
                        ("planes-normals", _) => "planes",
                        ("depth-normals", "normals") => "depth",
                        ("depth-normals", "depth") => "normals",
                        _ => continue,
                    };
                    found.push((lacks.to_owned(), self.canonical(variant.with_value(term, place))));
                }
                continue;
            }
            let needs = self.term_values(term)[0].needs.clone();
            found.push((needs, self.canonical(variant.with_value(term, 0))));
        }
        found
    }
}

#[cfg(test)]
mod tests;

use super::*;
use crate::builtin::{load_builtin, parse_settings};
use std::collections::BTreeSet;

pub(super) fn parse_sraa(options: &[(&str, &str)]) -> Vec<Setting> {
    let options = options
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
    let kernel = load_builtin("sraa").expect("it is built in");
    parse_settings(&kernel, &options.collect::<Vec<_>>()).expect("options of sraa")
}

pub(super) fn offer() -> Offer {
    let set = |count: usize, pattern: &str| SampleSet {
        count,
        options: parse_sraa(&[("pattern", pattern), ("shading", "centre")]),
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
    let all = space.base_variants();
    // Thirteen ways to tell surfaces apart, normals alone having no depth to compare.
    // Fast mathematics where there are finite tests.
    assert_eq!(all.len(), 3 * 13 * 3 * 2 * 3 * 2 * 2);
    let settings: BTreeSet<String> = all
        .iter()
        .map(|v| format!("{:?} {}", space.variant_settings(*v), space.precision(*v)))
        .collect();
    assert_eq!(settings.len(), all.len());
    assert_eq!(all[0], space.general());
    let general = space.variant_options(space.general());
    for option in [
        ("pattern", "latin16"),
        ("metric", "planes-normals"),
        ("non-finite", "skip"),
    ] {
        assert!(general.contains(&parse_sraa(&[option])[0]), "{option:?}");
    }
}

#[test]
fn neighbours_differ_in_one_term_and_are_searched() {
    let space = Space::new(&offer()).unwrap();
    let mut all: BTreeSet<Variant> = space.base_variants().into_iter().collect();
    let extended: Vec<Variant> = all.iter().flat_map(|v| space.extended_variants(*v)).collect();
    all.extend(extended);
    for variant in &all {
        for neighbour in space.neighbours(*variant) {
            assert!(all.contains(&neighbour), "{}", space.variant_name(neighbour));
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
    assert_eq!(space.term_values(Term::Metric).len(), 1);
    assert_eq!(space.term_values(Term::Precision).len(), 1);
    assert_eq!(space.left_aside.len(), 2, "{:?}", space.left_aside);

    let set = Offer {
        fixed: parse_sraa(&[("falloff", "tent"), ("tau", "300"), ("depth-scale", "2")]),
        ..offer()
    };
    let space = Space::new(&set).unwrap();
    assert_eq!(space.term_values(Term::Falloff).len(), 1);
    assert!(
        space
            .variant_options(space.general())
            .contains(&parse_sraa(&[("tau", "300")])[0])
    );
    assert_eq!(space.term_values(Term::Difference).len(), 2);
    // Spelled otherwise it is the same.
    let spelled = Offer {
        fixed: parse_sraa(&[("falloff", "tent"), ("tau", "3e2"), ("depth-scale", "2.0")]),
        ..offer()
    };
    assert_eq!(Space::new(&spelled).unwrap(), space);

    let no_such = Offer {
        fixed: parse_sraa(&[("metric", "planes-normals")]),
        normals: false,
        ..offer()
    };
    assert!(Space::new(&no_such).unwrap_err().contains("metric=planes-normals"));
}

#[test]
fn a_block_selects_where_a_pixel_branches() {
    let space = Space::new(&offer()).unwrap();
    let masked = space.general().with_value(Term::Mask, 1);
    let mask = |v: Variant| {
        let settings = space.variant_settings(v);
        settings.options.into_iter().find(|(n, _)| n == "mask").unwrap().1
    };
    assert_eq!(mask(masked), "branch");
    assert_eq!(mask(masked.with_value(Term::Block, 1)), "select");
}

#[test]
fn a_mask_looks_within_the_pixel_unless_it_is_set_otherwise() {
    let variation = |offer: &Offer| {
        let space = Space::new(offer).unwrap();
        let settings = space.variant_settings(space.general().with_value(Term::Mask, 1));
        let found: Vec<String> = settings
            .options
            .into_iter()
            .filter(|(name, _)| name == "variation")
            .map(|(_, value)| value)
            .collect();
        found
    };
    assert_eq!(variation(&offer()), ["within"]);
    let around = Offer {
        fixed: parse_sraa(&[("variation", "around")]),
        ..offer()
    };
    assert_eq!(variation(&around), ["around"]);
}

#[test]
fn what_is_left_out_is_named() {
    let space = Space::new(&offer()).unwrap();
    let names = |v: Variant| -> Vec<String> { space.left_out(v).into_iter().map(|(name, _)| name).collect() };
    assert!(names(space.general().with_value(Term::Block, 1)).is_empty());
    assert_eq!(
        names(space.general().with_value(Term::Metric, 3)),
        ["planes", "normals"]
    );
    assert_eq!(names(space.general().with_value(Term::Metric, 2)), ["planes", "depth"]);
    let four = space
        .general()
        .with_value(Term::Samples, 2)
        .with_value(Term::Precision, 1);
    assert_eq!(names(four), ["16 samples", "f32"]);
}

/// Each of the general variant's options that goes beyond the paper.
fn beyond(space: &Space, variant: Variant) -> Vec<Setting> {
    let names = ["shading", "search", "demodulate", "rest"];
    let mut options = space.variant_options(variant);
    options.retain(|(name, _)| names.contains(&name.as_str()));
    options
}

#[test]
fn what_goes_beyond_the_paper_is_added_to_plain_variants_alone() {
    let space = Space::new(&offer()).unwrap();
    let general = space.general();
    let none = parse_sraa(&[("shading", "centre"), ("search", "none"), ("demodulate", "none")]);
    assert_eq!(beyond(&space, general), none);
    let extended = space.extended_variants(general);
    assert_eq!(extended.len(), 2 * 2 * 2 - 1);
    let all = general
        .with_value(Term::Placing, 1)
        .with_value(Term::Search, 1)
        .with_value(Term::Light, 1);
    assert!(extended.contains(&all));
    let options = [
        ("shading", "placed"),
        ("search", "five"),
        ("demodulate", "albedo-shadow"),
        ("rest", "true"),
    ];
    assert_eq!(beyond(&space, all), parse_sraa(&options));
    assert!(space.is_placed(all) && !space.is_placed(general));
    for cheaper in [Term::Mask, Term::Precision, Term::Math, Term::Block] {
        let cheap = general.with_value(cheaper, 1);
        assert!(
            space.extended_variants(cheap).is_empty(),
            "{}",
            space.variant_name(cheap)
        );
        assert_eq!(
            space.canonical(cheap.with_value(Term::Search, 1)),
            general.with_value(Term::Search, 1)
        );
    }
    // A variant that has some of it already is extended to the same.
    assert_eq!(space.extended_variants(all), extended);
    assert!(
        space
            .variant_name(all)
            .ends_with("1x1, placed, searched, light apart from paint and shadow")
    );
    assert!(space.variant_name(general).ends_with("1x1"));
}

#[test]
fn what_was_added_is_told_apart_from_what_can_be() {
    let space = Space::new(&offer()).unwrap();
    let masked = space.general().with_value(Term::Mask, 1);
    let added = space.addable_terms(masked);
    let terms: Vec<&str> = added.iter().map(|added| added.term.as_str()).collect();
    assert_eq!(terms, ["placing", "search", "light apart from paint and shadow"]);
    // A mask leaves out what it leaves out: placing is judged without.
    assert!(
        added
            .iter()
            .all(|added| !added.is_there && added.without == space.general())
    );
    assert_eq!(added[0].with, space.general().with_value(Term::Placing, 1));
    let searched = space.general().with_value(Term::Search, 1);
    let added = space.addable_terms(searched);
    assert_eq!(
        added.iter().map(|a| a.is_there).collect::<Vec<_>>(),
        [false, true, false]
    );
    assert_eq!((added[1].without, added[1].with), (space.general(), searched));
    assert_eq!(added[2].with, searched.with_value(Term::Light, 1));
    assert!(space.left_out(searched).is_empty());
}

#[test]
fn options_beyond_the_paper_can_be_set_as_all_others() {
    let set = |options: &[(&str, &str)]| {
        let fixed = parse_sraa(options);
        Space::new(&Offer { fixed, ..offer() }).unwrap()
    };
    let searched = |space: &Space| -> Vec<Term> {
        let open = |term: &Term| space.term_values(*term).len() > 1;
        Term::BEYOND.into_iter().filter(open).collect()
    };
    let none = set(&[("search", "none"), ("demodulate", "none"), ("shading", "centre")]);
    assert!(searched(&none).is_empty() && none.extended_variants(none.general()).is_empty());
    assert!(none.addable_terms(none.general()).is_empty());
    assert!(none.left_aside.iter().any(|line| line == "search: it was set to none"));

    // Terms that all variants have are part of the baseline: they may go with all else.
    let placed = set(&[("shading", "placed")]);
    assert_eq!(searched(&placed), [Term::Search, Term::Light]);
    assert!(placed.is_placed(placed.general()) && placed.variant_name(placed.general()).ends_with("placed"));
    assert_eq!(placed.base_variants().len(), set(&[]).base_variants().len());
    // Options that are not searched may be set.
    let seven = set(&[("search", "seven")]);
    assert_eq!(searched(&seven), [Term::Placing, Term::Light]);
    assert_eq!(
        beyond(&seven, seven.general())[0],
        parse_sraa(&[("search", "seven")])[0]
    );
    // A mask would leave paint as it is.
    let albedo = set(&[("demodulate", "albedo")]);
    assert_eq!(albedo.term_values(Term::Mask).len(), 1);
    assert!(albedo.left_aside.iter().any(|line| line.starts_with("mask:")));
    let apart = set(&[("demodulate", "albedo-shadow")]);
    assert_eq!(apart.term_values(Term::Mask)[0].label, "no mask");
    let without_rest = set(&[("rest", "false")]);
    let light = without_rest.general().with_value(Term::Light, 1);
    assert!(beyond(&without_rest, light).contains(&parse_sraa(&[("rest", "false")])[0]));
}

#[test]
fn reasons_against_what_goes_beyond_the_paper_are_said() {
    let space = Space::new(&Offer {
        no_placing: Some("a capture keeps its own".to_owned()),
        no_light: Some("there is no albedo".to_owned()),
        ..offer()
    });
    let space = space.unwrap();
    assert_eq!(space.extended_variants(space.general()).len(), 1);
    // Then the samples say where it is shaded.
    assert_eq!(
        beyond(&space, space.general()),
        parse_sraa(&[("shading", "centre"), ("search", "none")])
    );
    for line in [
        "placing: a capture keeps its own",
        "light apart from paint and shadow: there is no albedo",
    ] {
        assert!(
            space.left_aside.iter().any(|said| said == line),
            "{:?}",
            space.left_aside
        );
    }
}

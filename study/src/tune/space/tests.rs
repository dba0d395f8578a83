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

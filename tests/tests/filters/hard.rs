//! Hard cases: every kernel in its default forms stays finite and within its bound, by every interpreter and on the device.
//! This is the net that a change of a kernel has to pass; `straightline study hard` prints what it finds.

use crate::common;

use common::bench;
use std::collections::BTreeSet;
use straightline_bench::execute::Clock;
use straightline_codegen::{Kernel, OptionKind, Precision, Settings};
use straightline_kernels::{CATALOGUE, HalfPrecision};
use straightline_study::hard::{self, HardError, KernelForm, Selection};
use straightline_study::progress::Silent;
use straightline_study::record::{Circumstances, Executor, HardRecord, IntervalKind, Record};
use straightline_tests::impatient::StopsAfter;

fn circumstances() -> Circumstances {
    Circumstances {
        command: String::new(),
        date: String::new(),
        adapter: String::new(),
        processor: String::new(),
        clock: Clock::WallClock,
        size: [0, 0],
        rounds: 0,
        intervals: IntervalKind::Blocks,
        complete: true,
    }
}

fn run(selection: &Selection) -> HardRecord {
    let found = hard::run_cases(selection, Some(&bench()), circumstances(), &mut Silent);
    found.unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn promised_results_are_finite_and_within_their_bounds_and_printed_ones_are_not() {
    let selection = Selection {
        precisions: vec![Precision::F32],
        ..Selection::default()
    };
    assert!(selection.cases.len() >= 40, "{} cases", selection.cases.len());
    let record = run(&selection);
    let broken: Vec<String> = record
        .broken_results()
        .map(|(case, r)| format!("{} on `{}` by {:?}: {r:?}", r.kernel, case.name, r.executor))
        .collect();
    assert!(broken.is_empty(), "{} results:\n{}", broken.len(), broken.join("\n"));
    let [promised, printed] = record.non_finite();
    assert_eq!(promised, 0);
    println!("pixels that are not finite as printed: {printed}");
    // The listing computes 0/0 where all weights underflow: the net catches that, and reports the place.
    let lost = record
        .cases
        .iter()
        .find(|case| case.name == "lost-samples")
        .expect("the case");
    let paper = lost.results.iter().filter(|r| r.kernel == "sraa paper");
    // A shader may take a NaN for a 0, and give black.
    for r in paper.filter(|r| r.executor != Executor::Gpu) {
        assert!(r.non_finite > 0, "{r:?}");
        if r.executor == Executor::Interpreter {
            let born = r.born.as_deref().expect("where it was born");
            assert!(born.contains("kernels/src/sraa/mod.rs"), "{born}");
        }
    }
    // All executors ran every case for every form, and nothing was left out in silence.
    for case in &record.cases {
        let executors: BTreeSet<String> = case.results.iter().map(|r| format!("{:?}", r.executor)).collect();
        assert_eq!(executors.len(), 4, "{}", case.name);
        for r in &case.results {
            assert_eq!(r.refused, None, "{} on `{}` by {:?}", r.kernel, case.name, r.executor);
            assert!(
                !r.promised || r.bound.is_some(),
                "{} on `{}` has no bound",
                r.kernel,
                case.name
            );
        }
    }
}

/// Bounds that hold whatever comes are of no use: on the plain cases they are small.
#[test]
fn bounds_are_as_tight_as_rounding() {
    let names = [
        "two-walls",
        "one-wall",
        "sky-behind",
        "thin-wire",
        "lost-samples",
        "nan-normals",
        "all-sky",
        "black",
    ];
    let selection = Selection {
        cases: names.map(|name| hard::find_case(name).expect("a case")).into(),
        forms: KernelForm::all()
            .into_iter()
            .filter(|form| form.name.starts_with("sraa") && form.promises)
            .collect(),
        precisions: vec![Precision::F32],
    };
    let found = hard::run_cases(&selection, None, circumstances(), &mut Silent).expect("it runs");
    for case in &found.cases {
        for r in case
            .results
            .iter()
            .filter(|r| r.executor == Executor::Interpreter && r.refused.is_none())
        {
            // A plane that is seen askance is extrapolated: its depth is a sum of larger numbers. Otherwise 1 - a·b is off by
            // roundings of 1, and 721 times that is an exponent's.
            let most = match (r.kernel.as_str(), case.name.as_str()) {
                ("sraa planes-normals" | "sraa planes of taps", _) => 1.0e-2,
                // Either of the two decides, the depth or the normal that is no number.
                ("sraa fallback", "nan-normals") => 1.1,
                _ => 1.0e-3,
            };
            let bound = r.bound.expect("a bound");
            assert!(bound <= most, "{} on `{}`: {bound:e}", r.kernel, case.name);
        }
    }
}

/// The error analysis holds in 16 bits too, where it allows more than can be seen.
#[test]
fn half_precision_keeps_to_its_analysis() {
    let selection = Selection {
        cases: hard::all_cases().into_iter().filter(|case| case.common).collect(),
        forms: KernelForm::all()
            .into_iter()
            .filter(|form| form.kernel == "sraa" && form.promises)
            .collect(),
        precisions: vec![Precision::F16],
    };
    let record = hard::run_cases(&selection, None, circumstances(), &mut Silent).expect("it runs");
    let mut compared = 0;
    for case in &record.cases {
        for r in case.results.iter().filter(|r| r.refused.is_none()) {
            // Only cases in which nothing is lost by underflow are analysed.
            let Some(most) = r.analysed else { continue };
            let off = r.difference.unwrap_or(0.0);
            assert!(
                off <= most,
                "{} on `{}` by {:?}: {off:e}, {most:e}",
                r.kernel,
                case.name,
                r.executor
            );
            compared += usize::from(most < 0.5);
        }
    }
    assert!(compared > 100, "only {compared} bounds say anything");
}

/// A slightly wrong kernel is caught: the definition of tau = 500 against shaders whose tau is off by 1/500.
#[test]
fn the_net_catches() {
    let case = hard::find_case("round-edge").expect("a case");
    let form = |tau: &str| KernelForm {
        options: vec![("tau".to_owned(), tau.to_owned())],
        ..KernelForm::all().remove(0)
    };
    for (tau, kept) in [("500", true), ("501", false)] {
        let found = hard::judged_as(&case, &form(tau), &form("500")).expect("it runs");
        assert_eq!(found.len(), 3);
        for r in found {
            assert_eq!(
                r.kept, kept,
                "tau {tau} by {:?}: {:?} of {:?}",
                r.executor, r.difference, r.bound
            );
        }
    }
}

#[test]
fn half_precision_is_allowed_where_it_cannot_be_seen() {
    let verdict = |kernel: &str, options: &[(&str, &str)]| {
        let options: Vec<_> = options
            .iter()
            .map(|(n, v)| ((*n).to_owned(), (*v).to_owned()))
            .collect();
        hard::half_precision_verdict(kernel, &options).expect("it is studied")
    };
    for (kernel, options) in [("sraa", &[("metric", "normals")][..]), ("quad_bilateral", &[])] {
        let allowed = verdict(kernel, options);
        assert_eq!(allowed.reason, None, "{kernel}");
        assert!(allowed.difference <= allowed.limit && allowed.cases > 10, "{allowed:?}");
    }
    for (kernel, options) in [("sraa", &[][..]), ("stalker", &[]), ("tabula_rasa", &[])] {
        let refused = verdict(kernel, options);
        let reason = refused
            .reason
            .as_deref()
            .unwrap_or_else(|| panic!("{kernel}: {refused:?}"));
        assert!(reason.contains("2^-11") || reason.contains("11 bits"), "{reason}");
        assert!(refused.broken > 0 && refused.cases > 10, "{refused:?}");
    }
    let error = hard::half_precision_verdict("kuwahara", &[]).expect_err("not studied");
    assert!(matches!(error, HardError::NotStudied(_)), "{error}");
}

/// The statements that `emit` and `build.rs` use agree with the results of the cases, option by option.
#[test]
fn the_catalogue_says_of_half_precision_what_the_cases_show() {
    for entry in CATALOGUE {
        let kernel = Kernel::builtin(entry.name).expect("built in");
        let options = kernel.options().expect("options");
        let choices = options.iter().filter_map(|option| match &option.kind {
            OptionKind::Choice(values) => Some(
                values
                    .iter()
                    .map(|(value, _)| vec![(option.name.clone(), value.clone())]),
            ),
            _ => None,
        });
        let mut settings: Vec<Vec<(String, String)>> = choices.flatten().collect();
        if entry.name == "sraa" {
            let normals = ("metric".to_owned(), "normals".to_owned());
            settings.extend(
                settings
                    .clone()
                    .into_iter()
                    .map(|set| [vec![normals.clone()], set].concat()),
            );
        }
        settings.push(Vec::new());
        for set in settings {
            let chosen = Settings::new().set_all(set.clone());
            let Ok(compiled) = kernel.compile(&chosen) else {
                continue;
            };
            let said = compiled.half_precision();
            match (hard::half_precision_verdict(entry.name, &set), said) {
                // Weights are lost whatever the colours are.
                (Err(HardError::NotStudied(_)), HalfPrecision::Lost(_)) if entry.name == "sraa" => {}
                (Err(HardError::NotStudied(_)), said) => assert_eq!(said, HalfPrecision::Unstudied, "{}", entry.name),
                (Ok(found), HalfPrecision::Kept) if found.reason.is_none() => {}
                (Ok(found), HalfPrecision::Lost(_)) if found.reason.is_some() => {}
                (found, said) => panic!("{} {set:?}: {said:?}, and the cases show {found:?}", entry.name),
            }
        }
    }
}

#[test]
fn a_case_by_name_and_none_by_another() {
    let case = hard::find_case("reversed-sky").expect("a case");
    assert!(case.about.contains("sky"), "{}", case.about);
    let error = hard::find_case("reversed-sea").expect_err("no case");
    assert!(
        error.to_string().contains("`reversed-sea`") && error.to_string().contains("--list"),
        "{error}"
    );
    let names: BTreeSet<&str> = hard::all_cases().iter().map(|case| case.name).collect();
    assert_eq!(names.len(), hard::all_cases().len(), "names are unique");
}

#[test]
fn what_was_done_is_kept_and_a_record_is_read_as_it_was_written() {
    let selection = Selection {
        cases: hard::all_cases()
            .into_iter()
            .filter(|case| case.options.is_empty())
            .take(6)
            .collect(),
        forms: KernelForm::all().into_iter().take(1).collect(),
        precisions: vec![Precision::F32],
    };
    // Compiles one form, and runs two cases.
    let found = hard::run_cases(&selection, None, circumstances(), &mut StopsAfter(3)).expect("it runs");
    assert_eq!((found.cases.len(), found.circumstances.complete), (2, false));
    let without = found.cases[0].results.iter().filter(|r| r.refused.is_some());
    assert_eq!(without.map(|r| r.executor).collect::<Vec<_>>(), [Executor::Gpu]);
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("hard");
    found.write(&folder).expect("it is written");
    let back = HardRecord::read(&folder.join("hard.json")).expect("it is read");
    assert_eq!(back.cases.len(), 2);
    let csv = std::fs::read_to_string(folder.join("hard.csv")).expect("a table");
    assert_eq!(
        csv.lines().count(),
        1 + found.cases.iter().map(|case| case.results.len()).sum::<usize>()
    );
}

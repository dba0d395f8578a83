//! The page made of records: whole, self-contained, and saying what the records say.

use glam::{Vec4, uvec2};
use straightline_bench::execute::{Clock, Times};
use straightline_kernels::prelude::Frame;
use straightline_scene::picture;
use straightline_study::record::*;
use straightline_study::report;
use straightline_study::statistics::Interval;

fn circumstances() -> Circumstances {
    Circumstances {
        command: "straightline study --quick".to_owned(),
        date: "2026-01-02T03:04:05Z".to_owned(),
        adapter: "an adapter (a driver <1.2>, Vulkan)".to_owned(),
        processor: "a processor, 2 threads".to_owned(),
        clock: Clock::WallClock,
        size: [64, 48],
        rounds: 3,
        intervals: IntervalKind::Blocks,
        complete: true,
    }
}

fn times(median_ms: f64) -> Times {
    Times {
        median_ms,
        min_ms: median_ms * 0.75,
        max_ms: median_ms * 1.25,
        rounds: 3,
        rounds_ms: vec![median_ms; 3],
    }
}

fn ratio(median: f64) -> Interval {
    Interval {
        median,
        low: median * 0.95,
        high: median * 1.05,
    }
}

fn loops() -> LoopsRecord {
    let form = |kind, ms, faster| FormRecord {
        kind,
        hash: Some(format!("{kind:?}")),
        loops: 2,
        statements: 120,
        reads: 35,
        spirv_bytes: 20480,
        pipeline_ms: 12.5,
        time: times(ms),
        ratio: ratio(faster),
        difference_999: Some(1e-7),
        difference: Some(2e-6),
    };
    let kernel = KernelForms {
        kernel: "SRAA 4".to_owned(),
        options: vec![("metric".to_owned(), "depth".to_owned())],
        input: "the scene roof".to_owned(),
        forms: vec![
            form(FormKind::Looped, 40.0, 1.0),
            form(FormKind::Full, 10.0, 4.0),
            // Two equal shaders of which one seems a tenth faster, so that ratios of 0.91 to 1.1 mean nothing.
            FormRecord {
                hash: Some(format!("{:?}", FormKind::Full)),
                ..form(FormKind::FullUnshared, 11.0, 3.6)
            },
            form(FormKind::Partial2, 38.0, 1.05),
            form(FormKind::Floor, 5.0, 8.0),
        ],
        absent: vec![(FormKind::LoopedByHand, "nobody wrote it".to_owned())],
    };
    LoopsRecord {
        circumstances: circumstances(),
        kernels: vec![kernel],
    }
}

fn quality(pictures: bool) -> QualityRecord {
    let method = |name: &str, family, psnr, ms: Option<f64>| MethodErrors {
        method: name.to_owned(),
        family,
        options: vec![("pattern".to_owned(), "latin4".to_owned())],
        psnr,
        ssim: 0.98,
        flip: 0.0123,
        psnr_geometry: Some(psnr - 6.0),
        psnr_shading: None,
        psnr_flat: Some(MOST_DB),
        worst: None,
        gap_closed: Some(0.5),
        temporal: Some(0.01),
        time: ms.map(times),
        bytes: 5_500_000,
        extra: None,
        non_finite: 0,
        picture: pictures.then(|| format!("pictures/{name}.png")),
    };
    let scene = SceneErrors {
        scene: "roof".to_owned(),
        purpose: "everything".to_owned(),
        shares: Shares {
            geometry: 0.1,
            shading: 0.05,
            flat: 0.85,
            unseen: 0.01,
        },
        reference: pictures.then(|| "pictures/reference.png".to_owned()),
        methods: vec![
            method("1x", Family::None, 30.0, None),
            method("SRAA", Family::Sraa, 38.0, Some(9.0)),
            method("FXAA", Family::Picture, 33.0, Some(4.0)),
        ],
        absent: vec![("SMAA".to_owned(), "nobody made it".to_owned())],
        gaps: vec![Gap {
            method: "SRAA 4".to_owned(),
            bound: "4x".to_owned(),
            psnr: 38.0,
            ideal_psnr: 38.5,
            bound_psnr: 39.25,
            psnr_seen: Some(41.0),
            bound_psnr_seen: None,
            error_unseen: 0.375,
        }],
    };
    QualityRecord {
        circumstances: circumstances(),
        timed_on: vec!["roof".to_owned()],
        pan_frames: 8,
        scenes: vec![scene],
    }
}

fn hard() -> HardRecord {
    let result = |executor, non_finite, kept| HardResult {
        kernel: "sraa default".to_owned(),
        options: Vec::new(),
        precision: "f32".to_owned(),
        executor,
        pixels: 64,
        non_finite,
        difference: Some(3e-7),
        ulps: Some(2.5),
        born: (non_finite > 0).then(|| "metric.rs:12: 0 / 0".to_owned()),
        bound: Some(1e-5),
        kept,
        promised: true,
        analysed: None,
        refused: None,
    };
    HardRecord {
        circumstances: circumstances(),
        cases: vec![HardCase {
            name: "nan-colour".to_owned(),
            about: "one colour is NaN".to_owned(),
            common: false,
            results: vec![result(Executor::Interpreter, 0, true), result(Executor::Gpu, 7, false)],
        }],
        half: vec![HalfVerdict {
            kernel: "sraa default".to_owned(),
            options: Vec::new(),
            worst: Some("steps".to_owned()),
            difference: Some(0.5),
            loosest: None,
            limit: Some(0.004),
            broken: 3,
            cases: 10,
            reason: Some("depth has too few bits".to_owned()),
        }],
    }
}

fn tune() -> TuneRecord {
    let candidate = |options: &[(&str, &str)], error, ms: Option<f64>, front| Candidate {
        name: options.iter().map(|(a, b)| format!("{a} {b}")).collect(),
        preset: None,
        options: options.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect(),
        precision: "f32".to_owned(),
        math: "exact".to_owned(),
        block: [1, 1],
        error,
        non_finite: 0,
        reads: 22.0,
        statements: 100.0,
        gbuffer_bytes: 4_000_000,
        predicted: 10.0,
        time: ms.map(times),
        cycles: None,
        ratio: ms.map(|ms| ratio(20.0 / ms)),
        front,
    };
    TuneRecord {
        circumstances: circumstances(),
        cost: "time".to_owned(),
        compiled_for: None,
        scene: "floor".to_owned(),
        metric: "psnr".to_owned(),
        max_error: 0.5,
        best: 40.0,
        reference: "256 samples a pixel".to_owned(),
        unfiltered: 31.5,
        fixed: vec![("shading".to_owned(), "centre".to_owned())],
        terms: vec![TermWorth {
            term: "normals".to_owned(),
            instead: "depth".to_owned(),
            cost: 0.125,
            ratio: Some(ratio(2.5)),
            candidate: 1,
        }],
        refused: vec![Refused {
            variant: "f16".to_owned(),
            reason: "the adapter has none".to_owned(),
        }],
        not_searched: Vec::new(),
        candidates: vec![
            candidate(&[("metric", "planes-normals")], 40.0, Some(20.0), true),
            candidate(&[("metric", "depth")], 39.8, Some(8.0), true),
            candidate(&[("metric", "normals")], 35.0, None, false),
        ],
        chosen: Some(1),
        general: 0,
        left_out: vec![LeftOut {
            term: "normals".to_owned(),
            cost: 0.2,
        }],
        needed: vec![LeftOut {
            term: "placing".to_owned(),
            cost: 1.25,
        }],
        model: Model {
            terms: vec![("reads".to_owned(), 0.02), ("unused".to_owned(), 0.0)],
            learned_from: 24,
            tested_on: 12,
            mean_error: 0.07,
            largest_error: 0.2,
        },
    }
}

#[test]
fn the_page_says_what_the_records_say() {
    let folder = std::env::temp_dir().join(format!("straightline-page-{}", std::process::id()));
    let pictures = folder.join("pictures");
    std::fs::create_dir_all(&pictures).unwrap();
    for (name, light) in [("1x", 0.2), ("SRAA", 0.4), ("FXAA", 0.3), ("reference", 0.5)] {
        let frame = Frame::new(uvec2(64, 48), vec![Vec4::splat(light); 64 * 48]);
        picture::write_picture(&pictures.join(format!("{name}.png")), &frame).unwrap();
    }
    loops().write(&folder).unwrap();
    quality(true).write(&folder).unwrap();
    hard().write(&folder).unwrap();
    tune().write(&folder).unwrap();
    let path = report::write_report(&folder).unwrap();
    let html = std::fs::read_to_string(&path).unwrap().replace("&#x2F;", "/");
    for expected in [
        "an adapter (a driver &lt;1.2&gt;, Vulkan)",
        "straightline study --quick",
        "2026-01-02",
        "unrolled: 4× as fast as looped (3.8 to 4.2), 10 ms",
        "nobody wrote it",
        "A pair of equal shaders has a ratio of 0.91 to 1.10; ratios within that are marked ≈.",
        "<td>1.05 (1.00 to 1.10) ≈",
        "<td>4.00 (3.80 to 4.20)<td>",
        "38.00",
        "10.0 % of its pixels have an edge of geometry",
        "born at metric.rs:12: 0 / 0",
        "not finite: 1",
        "depth has too few bits",
        "3 of 10",
        "<code>metric depth ← chosen</code>",
        "<code>metric depth</code>, 39.8000",
        "<td>0.1250<td>2.50 (2.38 to 2.62)",
        "would lose without: placing (1.250)",
        "Refused: f16: the adapter has none",
        "off by 7.0 % in the mean and 20.0 % at most",
        "<td>-1.25<td>-0.75<td>-0.50<td>37.5 %",
        "No SMAA: nobody made it",
        "class=\"pair\"",
        "data:image/png;base64,",
    ] {
        assert!(html.contains(expected), "the page lacks {expected:?}");
    }
    assert_eq!(
        html.matches("<svg ").count(),
        4,
        "a plot each but for hard cases, and two of loops"
    );
    // Whole in itself: nothing is fetched.
    for outside in ["src=", "href=\"http", "@import", "url(http"] {
        assert!(!html.contains(outside), "{outside}");
    }
    // Without pictures the rest is there.
    quality(false).write(&folder).unwrap();
    assert!(!report::render_page(&folder).unwrap().contains("class=\"pair\""));
    std::fs::remove_file(pictures.join("SRAA.png")).unwrap();
    quality(true).write(&folder).unwrap();
    let error = report::render_page(&folder).unwrap_err().to_string();
    assert!(error.contains("SRAA.png"), "{error}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn records_are_read_as_they_were_written() {
    let folder = std::env::temp_dir().join(format!("straightline-records-{}", std::process::id()));
    loops().write(&folder).unwrap();
    quality(false).write(&folder).unwrap();
    hard().write(&folder).unwrap();
    tune().write(&folder).unwrap();
    assert_eq!(LoopsRecord::read(&folder.join("loops.json")).unwrap(), loops());
    assert_eq!(QualityRecord::read(&folder.join("error.json")).unwrap(), quality(false));
    assert_eq!(HardRecord::read(&folder.join("hard.json")).unwrap(), hard());
    assert_eq!(TuneRecord::read(&folder.join("tune.json")).unwrap(), tune());
    let csv = std::fs::read_to_string(folder.join("tune.csv")).unwrap();
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!(rows.len(), 4);
    assert!(rows[2].starts_with("metric=depth,f32,exact,1x1,39.8,8,"), "{csv}");
    assert!(
        std::fs::read_to_string(folder.join("hard.csv"))
            .unwrap()
            .contains("metric.rs:12: 0 / 0")
    );
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_time_beyond_all_measure_is_refused() {
    let folder = std::env::temp_dir().join(format!("straightline-vast-{}", std::process::id()));
    let mut record = loops();
    for form in &mut record.kernels[0].forms {
        form.time = times(1e308);
        form.ratio = ratio(1e308);
    }
    record.write(&folder).unwrap();
    let start = std::time::Instant::now();
    let said = report::write_report(&folder).unwrap_err().to_string();
    assert!(said.contains("e308") && said.contains("measure again"), "{said}");
    assert!(start.elapsed().as_secs() < 10);
    std::fs::remove_dir_all(&folder).unwrap();
}

//! `study error`: baselines and methods on a GPU driver, on small pictures.

use crate::common;

use common::bench;
use std::path::Path;
use straightline_bench::execute::Inputs;
use straightline_codegen::{Settings, Stage};
use straightline_kernels::prelude::*;
use straightline_oracle::metrics;
use straightline_scene::capture::Capture;
use straightline_scene::picture;
use straightline_scene::scene::Scene;
use straightline_study::baselines::{Smaa, Transfer, apply_mlaa, fxaa_kernel};
use straightline_study::progress::Silent;
use straightline_study::quality::{Method, Outcome, QualityError, Setup, Source, list_losses, study_quality};
use straightline_study::record::Family;
use straightline_tests::impatient::StopsAfter;

/// A line of slope 1/5 between light and dark: each pixel shaded at its centre, and the reference.
fn slope() -> (Frame<Vec4>, Frame<Vec4>) {
    let size = uvec2(64, 40);
    let light = |place: Vec2| if place.y < 12.0 + place.x / 5.0 { 0.8 } else { 0.05 };
    let pixels = || (0..size.x * size.y).map(|k| vec2((k % 64) as f32, (k / 64) as f32));
    let grey = |v: f32| vec4(v, v, v, 1.0);
    let plain = pixels().map(|p| grey(light(p + 0.5))).collect();
    let perfect = pixels().map(|p| {
        let places = (0..256).map(|k| vec2((k % 16) as f32 + 0.5, (k / 16) as f32 + 0.5) / 16.0);
        grey(places.map(|by| light(p + by)).sum::<f32>() / 256.0)
    });
    (Frame::new(size, plain), Frame::new(size, perfect.collect()))
}

fn even(color: Vec4) -> Frame<Vec4> {
    Frame::new(uvec2(33, 21), vec![color; 33 * 21])
}

fn by_fxaa(picture: &Frame<Vec4>, transfer: Transfer) -> Frame<Vec4> {
    let compiled = fxaa_kernel().compile(&Settings::default()).expect("it compiles");
    let inputs = Inputs::new(picture.size()).with_image("color", transfer.encode_picture(picture));
    transfer.decode_picture(&bench().run(&compiled, Stage::Compute, &inputs).expect("it runs"))
}

fn by_smaa(picture: &Frame<Vec4>, transfer: Transfer) -> Frame<Vec4> {
    let mut smaa = Smaa::new(&bench(), picture.size(), transfer).expect("it is made");
    let first = smaa.run(picture).expect("it runs");
    let took = smaa.time_passes().expect("it is timed");
    assert!(took.as_nanos() > 0);
    let second = smaa.run(picture).expect("it runs");
    assert_eq!(metrics::max_abs_difference(&first, &second), 0.0);
    first
}

fn by_mlaa(picture: &Frame<Vec4>, transfer: Transfer) -> Frame<Vec4> {
    transfer.decode_picture(&apply_mlaa(&transfer.encode_picture(picture)))
}

#[test]
fn filters_of_the_picture_smooth_a_line_and_leave_evenness_alone() {
    let (plain, perfect) = slope();
    let before = metrics::psnr(&plain, &perfect);
    let color = vec4(0.6, 0.3, 0.1, 1.0);
    for transfer in [Transfer::Srgb, Transfer::Linear] {
        for (name, filter) in [
            ("FXAA", by_fxaa as fn(&Frame<Vec4>, Transfer) -> Frame<Vec4>),
            ("SMAA", by_smaa),
            ("MLAA", by_mlaa),
        ] {
            let after = metrics::psnr(&filter(&plain, transfer), &perfect);
            println!("{name} on {transfer:?}: {before:.2} dB before, {after:.2} dB after");
            assert!(after > before + 1.0, "{name} {transfer:?}: {before} {after}");
            // A filter leaves an even picture unchanged: exactly in 8 bits, up to the rounding of its 16 bits in
            // floats.
            let shown = picture::at_eight_bits(&even(color));
            assert_eq!(
                picture::at_eight_bits(&filter(&shown, transfer)),
                shown,
                "{name} {transfer:?}"
            );
            let left = metrics::max_abs_difference(&filter(&even(color), transfer), &even(color));
            assert!(left < 2e-3, "{name} {transfer:?} changes an even picture by {left}");
        }
    }
}

fn setup(pictures: bool) -> Setup {
    Setup {
        size: uvec2(96, 54),
        rounds: 2,
        quick: true,
        pan_frames: 2,
        post_processed: false,
        timed_scenes: 1,
        pictures,
        only: Vec::new(),
        own: Vec::new(),
    }
}

fn source(name: &str) -> Source {
    Source::Scene {
        name: name.to_owned(),
        purpose: "a test".to_owned(),
        scene: Box::new(Scene::from_name(name).expect("a scene")),
    }
}

/// User kernels have the same interface as the built-in methods: a kernel that returns the picture equals 1x, and
/// SRAA with default options equals SRAA 4.
#[test]
fn methods_of_the_users_own() {
    let folder = std::env::temp_dir().join(format!("straightline-own-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("own.rs");
    let text = "pub fn same(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) }\n\
        pub fn nearest(depth: &FrameLayers<f32>, pixel: IVec2) -> Vec4 { Vec4::ONE * depth.load(pixel, 3) }\n\
        pub fn lights(light: &Frame<Vec4>, pixel: IVec2) -> Vec4 { light.load(pixel) }\n";
    std::fs::write(&file, text).expect("a file");
    let own = |text: String| Method::parse_own(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let with = |methods: Vec<Method>| Setup {
        own: methods,
        only: ["SRAA 4", "1x", "SRAA 4, two shading samples"]
            .map(str::to_owned)
            .to_vec(),
        pan_frames: 0,
        post_processed: false,
        ..setup(false)
    };
    let setup = with(vec![
        own(format!("the same={}::same", file.display())),
        own("my sraa=sraa,tau=500,metric=depth-normals".to_owned()),
        own("listed=sraa,shading=listed,shaded=0,3".to_owned()),
        own(format!("depths={}::nearest", file.display())),
        own("blur=../examples/methods/edge_blur.rs,weight=0.2".to_owned()),
    ]);
    let outcome = study_quality(&bench(), vec![source("railings")], &setup, &mut Silent).expect("figures");
    let [scene] = &outcome.scenes[..] else {
        panic!("one scene, not {}", outcome.scenes.len());
    };
    // The named methods, and the user's.
    assert_eq!(scene.methods.len(), 3 + 5);
    let of = |name: &str| {
        let found = scene.methods.iter().find(|method| method.method == name);
        found.unwrap_or_else(|| panic!("no {name}"))
    };
    let figures = |name: &str| (of(name).psnr, of(name).ssim, of(name).flip, of(name).psnr_geometry);
    assert_eq!(figures("the same"), figures("1x"));
    assert_eq!(figures("my sraa"), figures("SRAA 4"));
    assert_eq!(figures("listed"), figures("SRAA 4, two shading samples"));
    assert_eq!(of("the same").family, Family::Own);
    assert!(of("the same").time.is_some() && of("depths").psnr < of("1x").psnr);
    assert!(
        of("blur").psnr > of("1x").psnr + 0.5,
        "{} {}",
        of("blur").psnr,
        of("1x").psnr
    );
    // The error names an input that the scene does not provide.
    let setup = with(vec![own(format!("lights={}::lights", file.display()))]);
    let error = study_quality(&bench(), vec![source("railings")], &setup, &mut Silent).expect_err("no such picture");
    assert!(error.to_string().contains("`lights` reads `light`"), "{error}");
    std::fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn methods_on_a_scene() {
    let sources = vec![source("railings")];
    let Outcome {
        scenes,
        complete,
        timed_on,
        pictures,
    } = study_quality(&bench(), sources, &setup(true), &mut Silent).unwrap_or_else(|e| panic!("{e}"));
    assert!(complete && timed_on == ["railings"]);
    let scene = &scenes[0];
    let method = |name: &str| {
        let found = scene.methods.iter().find(|m| m.method == name);
        found.unwrap_or_else(|| panic!("{name} is missing"))
    };
    for m in &scene.methods {
        println!(
            "{:28} {:.2} dB, SSIM {:.4}, FLIP {:.4}, {} B",
            m.method, m.psnr, m.ssim, m.flip, m.bytes
        );
        assert_eq!(m.non_finite, 0, "{}", m.method);
        assert!(m.bytes >= 96 * 54 * 16, "{}", m.method);
        assert_eq!(m.time.is_some(), m.family != Family::None, "{}", m.method);
        if let Some(picture) = &m.picture {
            assert!(pictures.contains_key(picture), "{picture}");
        }
    }
    assert_eq!(
        method("SRAA 4").picture.as_deref(),
        Some("pictures/railings/sraa-4.png")
    );
    // Invariants of every scene.
    assert_eq!(
        (method("1x").gap_closed, method("16x").gap_closed),
        (Some(0.0), Some(1.0))
    );
    assert!(method("1x").psnr < method("SRAA 4").psnr && method("SRAA 4").psnr < method("4x").psnr);
    assert!(method("4x").psnr < method("16x").psnr && method("MSAA 4").psnr <= method("4x").psnr + 0.5);
    assert!(method("16x").flip < method("4x").flip && method("4x").flip < method("1x").flip);
    assert!(
        method("16x")
            .temporal
            .is_some_and(|own| method("1x").temporal.is_some_and(|plain| own < plain))
    );
    let shares = &scene.shares;
    assert!((shares.geometry + shares.shading + shares.flat - 1.0).abs() < 1e-9);
    assert!(shares.unseen > 0.0 && shares.unseen < shares.geometry, "{shares:?}");
    // The errors of the pixels, combined, equal that of the picture.
    let mse = |db: Option<f64>| db.map_or(0.0, |db| 10f64.powf(-db / 10.0));
    let plain = method("1x");
    let parts = shares.geometry * mse(plain.psnr_geometry)
        + shares.shading * mse(plain.psnr_shading)
        + shares.flat * mse(plain.psnr_flat);
    assert!((parts - mse(Some(plain.psnr))).abs() < 1e-6 * parts, "{parts}");
    assert_eq!(scene.gaps.len(), 2);
    for gap in &scene.gaps {
        assert!(gap.ideal_psnr <= gap.bound_psnr + 0.5, "{gap:?}");
        assert!(
            gap.bound_psnr_seen >= Some(gap.bound_psnr) && gap.error_unseen > 0.0,
            "{gap:?}"
        );
    }
    // The figures match those computed from the written pictures.
    let folder = std::env::temp_dir().join(format!("straightline-quality-{}", std::process::id()));
    let read = |stem: &str| {
        let bytes = &pictures[&format!("pictures/railings/{stem}.png")];
        let path = folder.join(format!("{stem}.png"));
        std::fs::create_dir_all(&folder)
            .and_then(|()| std::fs::write(&path, bytes))
            .expect("a file");
        picture::read_picture(&path).expect("a picture")
    };
    let reference = read("reference");
    for (name, stem) in [("1x", "1x"), ("SRAA 16", "sraa-16"), ("SMAA", "smaa"), ("16x", "16x")] {
        let shown = read(stem);
        assert_eq!(metrics::psnr(&shown, &reference), method(name).psnr, "{name}");
        assert_eq!(metrics::flip(&shown, &reference), method(name).flip, "{name}");
    }
    std::fs::remove_dir_all(&folder).expect("the folder goes");
    // The gain of a second shading sample justifies its cost.
    let two = method("SRAA 4, two shading samples");
    assert!(two.psnr > method("SRAA 4").psnr + 0.5, "{}", two.psnr);
    println!("{:#?}", list_losses(scene));
}

#[test]
fn what_is_finished_is_kept_when_it_is_stopped() {
    let setup = Setup {
        pan_frames: 0,
        post_processed: false,
        size: uvec2(32, 18),
        ..setup(false)
    };
    let run = |patience| {
        let mut watch = StopsAfter(patience);
        let outcome = study_quality(&bench(), vec![source("sky"), source("wires")], &setup, &mut watch);
        (outcome.unwrap_or_else(|e| panic!("{e}")), patience - watch.0)
    };
    let (all, steps) = run(usize::MAX);
    assert!(all.complete && all.scenes.len() == 2);
    let (some, _) = run(steps - 3);
    assert!(!some.complete && some.scenes.len() == 1 && some.scenes[0].scene == "sky");
    let (none, _) = run(1);
    assert!(!none.complete && none.scenes.is_empty());
}

/// Made by `examples/captures/spheres.py`.
fn spheres() -> Capture {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/captures/spheres");
    Capture::read(&folder).unwrap_or_else(|e| panic!("{e}"))
}

fn of_capture(capture: Capture) -> Result<Outcome, QualityError> {
    let source = Source::Capture {
        name: "spheres".to_owned(),
        capture: Box::new(capture),
    };
    study_quality(&bench(), vec![source], &setup(false), &mut Silent)
}

#[test]
fn a_capture_of_another_program() {
    let outcome = of_capture(spheres()).unwrap_or_else(|e| panic!("{e}"));
    let scene = &outcome.scenes[0];
    let psnr = |name: &str| scene.methods.iter().find(|m| m.method == name).map(|m| m.psnr);
    println!(
        "1x {:?}, SRAA 4 {:?}, SMAA {:?}",
        psnr("1x"),
        psnr("SRAA 4"),
        psnr("SMAA")
    );
    assert!(
        psnr("SRAA 4")
            .zip(psnr("1x"))
            .is_some_and(|(ours, plain)| ours > plain + 3.0)
    );
    assert!(psnr("SRAA 4, planes and normals").is_some() && psnr("16x").is_none());
    assert!(
        scene
            .absent
            .iter()
            .any(|(what, why)| what.contains("16x") && why.contains("every sample"))
    );
    assert!(
        scene.shares.geometry > 0.02 && scene.shares.shading > 0.005,
        "{:?}",
        scene.shares
    );
    assert!(
        scene
            .methods
            .iter()
            .all(|m| m.gap_closed.is_none() && m.temporal.is_none())
    );
}

#[test]
fn a_capture_that_lacks_something_says_so() {
    let without_normals = Capture {
        normal: None,
        camera: None,
        ..spheres()
    };
    let scene = of_capture(without_normals)
        .unwrap_or_else(|e| panic!("{e}"))
        .scenes
        .remove(0);
    let names: Vec<&str> = scene.methods.iter().map(|m| m.method.as_str()).collect();
    assert_eq!(
        names,
        [
            "1x",
            "SRAA 4, depth",
            "FXAA",
            "FXAA on light",
            "SMAA",
            "SMAA on light",
            "MLAA"
        ]
    );
    assert!(
        scene
            .absent
            .iter()
            .any(|(what, why)| what.contains("S.T.A.L.K.E.R.") && why.contains("normal.exr"))
    );
    let blind = Capture {
        albedo: None,
        direct: None,
        rest: None,
        guide: None,
        reference: None,
        ..spheres()
    };
    let error = of_capture(blind)
        .expect_err("there is nothing to compare with")
        .to_string();
    assert!(
        error.contains("reference.exr") && error.contains("docs/captures.md"),
        "{error}"
    );
}

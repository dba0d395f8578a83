//! The figures of the documents are those of the records that they cite.
//!
//! After new measurements: `STRAIGHTLINE_BLESS=1 cargo test --workspace --test studies readme::`.

use std::path::Path;
use straightline_study::record::{QualityRecord, Record, read_file};
use straightline_tests::readme::{GEOMETRIC, filled};

#[test]
fn tables_are_what_their_records_say() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut tables = 0;
    let documents = std::fs::read_dir(root.join("docs")).expect("docs");
    let documents = documents.map(|entry| entry.expect("an entry").path());
    let documents = documents.filter(|path| path.extension().is_some_and(|kind| kind == "md"));
    for path in documents.chain(["README.md", "ARCHITECTURE.md"].map(|name| root.join(name))) {
        let name = path.display();
        let document = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        let expected = filled(&document, &root.join("study/records")).unwrap_or_else(|error| panic!("{name}: {error}"));
        tables += document.lines().filter(|line| line.starts_with("<!-- table ")).count();
        if document != expected && std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
            std::fs::write(&path, &expected).expect("the document is written");
        } else {
            assert!(
                document == expected,
                "{name} and study/records/ disagree: measure again, or run STRAIGHTLINE_BLESS=1 cargo test --workspace --test studies readme::"
            );
        }
    }
    assert!(tables >= 15, "the documents cite {tables} records");
}

/// Statements of `docs/sraa.md` on roundings.
#[test]
fn what_is_said_of_roundings_is_so() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |name: &str| std::fs::read_to_string(root.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let document = read("docs/sraa.md").replace('\n', " ");
    let records = ["lavapipe", "swiftshader"].map(|driver| -> serde_json::Value {
        let path = root.join(format!("study/records/sraa-error-{driver}.json.gz"));
        let text = read_file(&path).unwrap_or_else(|error| panic!("{error}"));
        serde_json::from_slice(&text).expect("a record")
    });
    let rows = |name: &str| -> Vec<serde_json::Value> {
        let all = records.iter().flat_map(|record| record[name].as_array().expect("rows"));
        all.cloned().collect()
    };
    let number = |row: &serde_json::Value, name: &str| row[name].as_f64();
    let largest =
        |rows: &[serde_json::Value], name: &str| rows.iter().filter_map(|row| number(row, name)).fold(0.0, f64::max);
    let (all, scenes) = (rows("rows"), rows("scenes"));
    let run = all.iter().filter(|row| row["not_run"].is_null()).count();
    let relative_floor: Vec<_> = scenes
        .iter()
        .filter(|row| row["scene"] == "floor" && row["options"]["metric"] == "planes-normals")
        .filter(|row| row["options"]["difference"] == "relative")
        .cloned()
        .collect();
    let off = "largest_difference_to_f64";
    for said in [
        format!("{} shaders on each of two", run / 2),
        format!("off by {:.1e} at most for colours", largest(&all, off)),
        format!("and {} that are refused", (all.len() - run) / 2),
        format!(
            "off by {:.1e} at most: planes with absolute depths",
            largest(&scenes, off)
        ),
        format!("`difference=relative` it is {:.1e}", largest(&relative_floor, off)),
        format!("the largest of a pixel is {:.1},", largest(&scenes, "largest_bound")),
    ] {
        assert!(document.contains(&said), "docs/sraa.md does not say `{said}`");
    }
    assert_eq!(largest(&scenes, "pixels_beyond_their_bound"), 0.0);
}

/// Statements in words of `docs/study.md` and `docs/sraa.md`.
#[test]
fn what_is_said_of_sraa_is_so() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../study/records/error-lavapipe.json");
    let record = QualityRecord::read(&path).unwrap_or_else(|error| panic!("{error}"));
    for scene in &record.scenes {
        let name = scene.scene.as_str();
        let of = |method: &str| {
            let found = scene.methods.iter().find(|m| m.method == method);
            found.unwrap_or_else(|| panic!("{name} has no {method}"))
        };
        for ours in ["SRAA 4", "SRAA 16"] {
            let relative = of(&format!("{ours}, relative depth")).psnr - of(ours).psnr;
            let said = if name == "emissive" { -0.84..=-0.4 } else { -0.04..=0.84 };
            assert!(said.contains(&relative), "{name}, {ours}: {relative}");
            for other in ["FXAA", "FXAA on light", "SMAA", "SMAA on light"] {
                let (ours_is, other_is) = (of(ours), of(other));
                assert!(
                    !GEOMETRIC.contains(&name) || (ours_is.psnr > other_is.psnr && ours_is.flip < other_is.flip),
                    "{name}: {ours} against {other}"
                );
            }
            assert_eq!(of(ours).non_finite, 0, "{name}");
        }
    }
}

#[test]
fn a_changed_figure_is_noticed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let records = root.join("study/records");
    let made =
        filled("<!-- table loops of loops-lavapipe.json -->\n<!-- end -->\n", &records).expect("the record is there");
    let digit = made.rfind(|c: char| c.is_ascii_digit()).expect("a figure");
    let mut changed = made.clone();
    changed.replace_range(digit..=digit, if &made[digit..=digit] == "9" { "8" } else { "9" });
    assert_eq!(filled(&changed, &records).expect("filled"), made);
    assert_ne!(changed, made);
}

#[test]
fn bad_markers_are_told() {
    let records = Path::new("nowhere");
    for (document, expected) in [
        ("<!-- table loops -->\n<!-- end -->\n", "names no record"),
        ("<!-- table loops of a.json -->\n<!-- end -->\n", "a.json"),
        ("<!-- table lops of a.json -->\n<!-- end -->\n", "no table `lops`"),
    ] {
        let error = filled(document, records).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn only_runs_of_the_same_study_can_agree() {
    let records = Path::new(env!("CARGO_MANIFEST_DIR")).join("../study/records");
    for (files, expected) in [
        ("loops-lavapipe.json", "needs two records"),
        ("loops-lavapipe.json loops-swiftshader.json", "not of the same kernels"),
    ] {
        let document = format!("<!-- table agreement of {files} -->\n<!-- end -->\n");
        let error = filled(&document, &records).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

/// The text that the README shows is one of those that are emitted.
#[test]
fn the_shader_shown_is_emitted() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |name: &str| std::fs::read_to_string(root.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let (page, shader) = (read("README.md"), read("shaders-out/sraa4.wgsl"));
    let (_, behind) = page.split_once("```wgsl\n").expect("a shader in the README");
    let (shown, _) = behind.split_once("```").expect("its end");
    assert!(
        shown.lines().count() > 3 && shader.contains(shown),
        "sraa4.wgsl does not have:\n{shown}"
    );
}

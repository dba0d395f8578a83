//! `test`: properties of kernels' files, run as shaders.

use crate::common;

use common::{fails, finishes, here, scratch, straightline, write};
use std::process::Command;

/// A file with tests of these bodies, named `a`, `b` and so on.
fn file_of(bodies: &[&str]) -> String {
    let mut text = "use straightline_kernels::prelude::*;\n\n/// Twice a number.\npub fn twice(x: f32) -> f32 {\n    \
                    x + x\n}\n\n#[cfg(test)]\nmod tests {\n    use super::*;\n    use straightline_kernels::testing::*;\n"
        .to_owned();
    for (name, body) in ('a'..).zip(bodies) {
        text += &format!("\n    #[test]\n    fn {name}() {{\n        {body}\n    }}\n");
    }
    text + "}\n"
}

const HOLDS: &str = "for_all(|x: f32| assert_eq!(twice(x), 2.0 * x));";
const FAILS: &str = "for_all(|x: f32| assert!(twice(x) >= x));";

#[test]
fn tests_that_hold_pass_by_interpreter_and_driver() {
    let folder = scratch("testing-passes");
    let path = write(&folder, "twice.rs", &file_of(&[HOLDS, "assert_eq!(twice(1.5), 3.0);"]));
    let said = finishes(&["test", &path, "--without-gpu"]);
    assert!(
        said.starts_with(&format!("running 2 tests of {path} by the interpreter\n")),
        "{said}"
    );
    assert!(said.contains("test tests::a ... ok\ntest tests::b ... ok\n"), "{said}");
    assert!(
        said.contains("test result: ok. 2 passed; 0 failed; 0 ignored; finished in "),
        "{said}"
    );
    let said = finishes(&["test", &path, "tests::b"]);
    assert!(
        said.contains("by the interpreter and ") && said.contains("1 passed"),
        "{said}"
    );
}

#[test]
fn drivers_run_the_same_cases() {
    let folder = scratch("testing-driver");
    let kinds = "for_all(|v: Vec3, n: IVec2, u: u32, on: bool, taps: [Vec2; 2], s: f32| {\
                 let x = if on { v.x } else { taps[1].y };\
                 assert_eq!(x * 0.5 + x * 0.5, x); assert_eq!(n.x ^ n.y ^ n.y, n.x); assert!(u | 1 >= 1); assert_eq!(s, s); });";
    let luma = "for_all(|grey: f32| assert_close(Vec3::splat(grey).dot(vec3(0.2126, 0.7152, 0.0722)), grey, ulp(3)));";
    let path = write(&folder, "kinds.rs", &file_of(&[kinds, luma]));
    let said = finishes(&["test", &path]);
    assert!(said.contains("test result: ok. 2 passed"), "{said}");
}

#[test]
fn a_failure_is_printed_in_every_format() {
    let folder = scratch("testing-fails");
    let path = write(&folder, "twice.rs", &file_of(&[HOLDS, FAILS]));
    let xml = folder.join("results.xml");
    let arguments = ["test", &path, "--without-gpu", "--junit", xml.to_str().expect("UTF-8")];
    fails(&arguments, 1, &["error: 1 of 2 tests failed"]);
    let said = String::from_utf8_lossy(&straightline(&arguments).stdout).into_owned();
    for part in [
        "test tests::b ... FAILED",
        "error[E0511]: `tests::b` fails by the interpreter, f32",
        "`twice(x)` is -2.0, `x` is -1.0",
        "let x: f32 = -1.0;",
        "test result: FAILED. 1 passed; 1 failed",
    ] {
        assert!(said.contains(part), "{part} is missing:\n{said}");
    }
    let xml = std::fs::read_to_string(xml).expect("it is written");
    assert!(
        xml.contains("tests=\"2\" failures=\"1\"") && xml.contains("<failure message=\"`tests::b` fails"),
        "{xml}"
    );

    let output = straightline(&["test", &path, "--without-gpu", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    let events: Vec<serde_json::Value> = lines
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    assert_eq!(events[0]["test_count"], 2);
    let failed = events
        .iter()
        .find(|event| event["event"] == "failed" && event["type"] == "test")
        .expect("a failure");
    assert_eq!(
        (&failed["name"], &failed["line"]),
        (&"tests::b".into(), &20.into()),
        "{failed}"
    );
    assert_eq!(
        (&failed["left"], &failed["inputs"][0]),
        (&"-2.0".into(), &"let x: f32 = -1.0;".into())
    );
    assert_eq!(events.last().map(|event| event["failed"].clone()), Some(1.into()));
}

#[test]
fn a_wrong_test_does_not_stop_the_others() {
    let folder = scratch("testing-refused");
    let path = write(
        &folder,
        "twice.rs",
        &file_of(&["for_all(|x: f64| assert!(x > 0.0));", HOLDS]),
    );
    let said = String::from_utf8_lossy(&straightline(&["test", &path, "--without-gpu"]).stdout).into_owned();
    assert!(
        said.contains("test tests::a ... FAILED\ntest tests::b ... ok\n"),
        "{said}"
    );
    assert!(
        said.contains("an argument of the type `f64`") && said.contains("= help: take f32"),
        "{said}"
    );
}

#[test]
fn coverage_is_written_as_lcov_and_printed() {
    let folder = scratch("testing-coverage");
    let path = write(&folder, "twice.rs", &file_of(&["assert_eq!(twice(1.5), 3.0);", HOLDS]));
    let info = folder.join("twice.info").display().to_string();
    let arguments = ["test", &path, "--without-gpu", "--cases", "7", "--coverage", &info];
    let said = finishes(&arguments);
    let line = format!("\n{path}  100.0 % of lines, 0 of 0 branches\n");
    assert!(said.ends_with(&line), "{said}");
    let text = std::fs::read_to_string(&info).expect("it is written");
    let counts = "FN:4,twice\nFNDA:8,twice\nFNF:1\nFNH:1\nBRF:0\nBRH:0\nDA:4,8\nDA:5,8\nLF:2\nLH:2\nend_of_record\n";
    assert_eq!(text, format!("TN:\nSF:{path}\n{counts}"));
    let lines = String::from_utf8_lossy(&straightline(&[&arguments[..], &["--json"]].concat()).stdout).into_owned();
    let last: serde_json::Value = serde_json::from_str(lines.lines().last().expect("a line")).expect("JSON");
    assert_eq!(
        (&last["type"], &last["lines"]["run"]),
        (&"coverage".into(), &2.into()),
        "{last}"
    );
    // A test that fails or is refused does not keep the others from being counted.
    let path = write(
        &folder,
        "twice.rs",
        &file_of(&[FAILS, "for_all(|x: f64| assert!(x > 0.0));"]),
    );
    fails(
        &["test", &path, "--without-gpu", "--cases", "7", "--coverage", &info],
        1,
        &["2 of 2 tests failed"],
    );
    let text = std::fs::read_to_string(&info).expect("it is written");
    assert!(text.contains("FNDA:7,twice"), "{text}");
}

#[test]
fn files_and_names_without_tests_are_refused() {
    let folder = scratch("testing-none");
    let path = write(&folder, "none.rs", "pub fn twice(x: f32) -> f32 { x + x }\n");
    fails(
        &["test", &path, "--without-gpu"],
        1,
        &["has no tests", "help: write one: `#[test]"],
    );
    let path = write(&folder, "twice.rs", &file_of(&[HOLDS]));
    fails(
        &["test", &path, "nothing", "--without-gpu"],
        2,
        &["no test of", "there are tests::a"],
    );
    fails(
        &["test", "missing.rs"],
        2,
        &["cannot read the kernel file `missing.rs`"],
    );
    fails(&["test", &path, "--cases", "0"], 2, &["0"]);
    fails(
        &["test", &path, "--adapter", "no such adapter"],
        2,
        &["no adapter is called"],
    );
}

#[test]
fn the_example_of_the_documents_prints_what_they_say() {
    let page = here("docs/testing.md");
    let document = std::fs::read_to_string(&page).expect("the page is there");
    let (_, rest) = document.split_once("```rust\n").expect("a file");
    let (text, _) = rest.split_once("```").expect("its end");
    let folder = scratch("testing-document");
    write(&folder, "sharpen.rs", text);
    let mut command = Command::new(env!("CARGO_BIN_EXE_straightline"));
    command
        .args(["test", "sharpen.rs", "--without-gpu"])
        .current_dir(&folder);
    let said = String::from_utf8_lossy(&command.output().expect("it runs").stdout).into_owned();
    let (said, _) = said.split_once("; finished in ").expect("a summary");
    let (before, rest) = document.split_once("```text\n").expect("an output");
    let (shown, after) = rest.split_once("```").expect("its end");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&page, format!("{before}```text\n{said}\n```{after}")).expect("the page is written");
    } else {
        assert_eq!(shown.trim_end(), said, "STRAIGHTLINE_BLESS=1 writes it");
    }
}

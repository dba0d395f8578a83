//! `study all` as its user sees it.

use crate::common;

use common::{fails, finishes, scratch};
use serde_json::Value;

#[test]
fn records_are_taken_once() {
    let folder = scratch("all-records");
    let out = folder.to_str().unwrap();
    let words = ["study", "all", "--quick", "--only", "split-lavapipe", "--out", out];
    let output = finishes(&words);
    for said in [
        "1 record, about 5 s",
        "0 complete already",
        "1/1 split-lavapipe",
        "took ",
    ] {
        assert!(output.contains(said), "no `{said}` in:\n{output}");
    }
    let path = folder.join("split-lavapipe.json");
    let read = || std::fs::read_to_string(&path).expect("a record");
    let first = read();
    assert!(finishes(&words).contains("1 complete already"));
    assert_eq!(read(), first);
    // An interrupted record is taken again.
    let mut record: Value = serde_json::from_str(&first).expect("JSON");
    record["complete"] = false.into();
    std::fs::write(&path, record.to_string()).expect("a file is written");
    finishes(&words);
    let again: Value = serde_json::from_str(&read()).expect("JSON");
    assert_eq!(again["complete"], true);
    assert_eq!(again["variants"][0]["settings"], record["variants"][0]["settings"]);
}

#[test]
fn requests_without_a_duration_are_refused() {
    let folder = scratch("all-refused");
    let refused = |more: &[&str], says: &str| {
        let out = ["study", "all", "--out", folder.to_str().unwrap()];
        fails(&[&out, more].concat(), 2, &[says]);
    };
    refused(&[], "add --quick (about ");
    refused(&["--full", "--quick"], "cannot be used with");
    refused(
        &["--quick", "--rounds", "3"],
        "leave out --size, --rounds and --adapter",
    );
    refused(&["--quick", "--only", "loops"], "no record is called `loops`");
}

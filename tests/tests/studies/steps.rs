//! Steps of `study all`, and documents whose shaders have changed since they were measured.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use straightline_codegen::Kernel;
use straightline_study::record::{Record, SweepRecord, read_file};
use straightline_study::steps::{Changes, Folders, Steps};

/// Files of `study/records` that no command of the command line writes, beside those of `others`.
const BY_HAND: [&str; 5] = [
    "mutants",
    "quads-error-lavapipe",
    "quads-error-swiftshader",
    "quads-minified",
    "random-kernels",
];

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// The records by name without extensions.
fn records() -> BTreeMap<String, PathBuf> {
    let folder = std::fs::read_dir(here("study/records")).expect("records");
    let paths = folder.map(|entry| entry.expect("an entry").path());
    let named = paths.map(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let stem = name.split('.').next().unwrap_or_default().to_owned();
        (stem, path)
    });
    named.collect()
}

/// A command without the places of its output and its device, which differ from run to run.
fn without_places(command: &str) -> String {
    let mut words = command.split(' ');
    let mut left = Vec::new();
    while let Some(word) = words.next() {
        match word {
            "--out" | "--record" | "--adapter" => drop(words.next()),
            _ => left.push(word.rsplit('/').next().unwrap_or(word).replace(".json.gz", ".json")),
        }
    }
    left.join(" ")
}

#[test]
fn steps_are_the_commands_of_the_records() {
    let steps = Steps::list();
    let records = records();
    let folder = Path::new("out");
    let folders = Folders {
        records: folder,
        own: folder,
    };
    let mut known: BTreeSet<String> = BY_HAND.map(str::to_owned).into();
    for step in &steps.steps {
        let name = &step.record;
        assert!(known.insert(name.clone()), "{name} has two steps");
        let path = records.get(name).unwrap_or_else(|| panic!("there is no record {name}"));
        // The record of hard cases is a table alone.
        if !path.to_string_lossy().contains(".json") {
            continue;
        }
        let record: Value = serde_json::from_slice(&read_file(path).expect("a record")).expect("JSON");
        let own = format!("straightline {}", step.command(false, folders).join(" "));
        let recorded = record["command"].as_str().expect("a command");
        assert_eq!(without_places(&own), without_places(recorded), "{name}");
        let adapter = record["adapter"].as_str().unwrap_or_default().to_lowercase();
        let device = step.option("--adapter").unwrap_or_default();
        assert!(adapter.contains(device), "{name}: {adapter}");
    }
    for other in &steps.others {
        known.insert(other.record.clone());
    }
    for name in records.keys() {
        assert!(
            known.contains(name),
            "study/src/steps/steps.json has no step for {name}"
        );
    }
}

/// Tables of documents by the record that they are made of: `docs/study.md: speed`.
fn tables() -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let documents = std::fs::read_dir(here("docs")).expect("docs");
    let documents = documents.map(|entry| entry.expect("an entry").path());
    for path in documents.filter(|path| path.extension().is_some_and(|kind| kind == "md")) {
        let text = std::fs::read_to_string(&path).expect("a document");
        for marker in text.lines().filter_map(|line| line.strip_prefix("<!-- table ")) {
            let (table, files) = marker.trim_end_matches(" -->").split_once(" of ").expect("a record");
            let place = format!("docs/{}: {table}", path.file_name().unwrap_or_default().display());
            for file in files.split(' ') {
                let record = file.split('.').next().unwrap_or_default();
                found.entry(record.to_owned()).or_default().push(place.clone());
            }
        }
    }
    found
}

/// Lists tables whose shaders have changed since; an error with `STRAIGHTLINE_RELEASE=1`. `tests/run` prints the list.
#[test]
fn tables_of_changed_shaders_are_listed() {
    let (records, tables) = (records(), tables());
    let (mut changed, mut unknown) = (Vec::new(), Vec::new());
    for step in &Steps::list().steps {
        let Some(places) = tables.get(&step.record) else {
            continue;
        };
        let changes = Changes::since_record(step, &here(""), &records[&step.record]);
        match changes.unwrap_or_else(|error| panic!("{error}")) {
            Some(changes) if changes.changed > 0 => changed.push(format!(
                "stale: {}, {} of {} shaders: {}",
                step.record,
                changes.changed,
                changes.hashed,
                places.join(", ")
            )),
            Some(changes) if changes.hashed > 0 => {}
            _ => unknown.push(step.record.as_str()),
        }
    }
    let list = changed.join("\n");
    if !unknown.is_empty() {
        println!("without hashes of shaders: {}", unknown.join(", "));
    }
    if !changed.is_empty() {
        println!("{list}");
        let is_release = std::env::var_os("STRAIGHTLINE_RELEASE").is_some_and(|value| value == "1");
        assert!(
            !is_release,
            "take these records again (straightline study all --full --only RECORD --out DIR):\n{list}"
        );
    }
}

#[test]
fn a_changed_shader_is_found() {
    let path = here("study/records/split-lavapipe.json");
    let mut record = SweepRecord::read(&path).expect("a record");
    let kernel = Kernel::builtin("sraa").expect("it is built in");
    let all = Changes::since_sweep(None, &record);
    assert_eq!((all.hashed, all.changed), (2, 2));
    for swept in &mut record.variants {
        let measured = swept.measured.as_mut().expect("a variant that was measured");
        measured.hash = Changes::hash_of_variant(&kernel, &record.axes, &swept.settings).expect("a shader");
    }
    assert_eq!(Changes::since_sweep(Some(&kernel), &record).changed, 0);
    let measured = record.variants[1]
        .measured
        .as_mut()
        .expect("a variant that was measured");
    measured.hash.push('0');
    assert_eq!(Changes::since_sweep(Some(&kernel), &record).changed, 1);
}

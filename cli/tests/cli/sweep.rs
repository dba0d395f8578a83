//! `study sweep` as its user sees it, and what reads its records.

use crate::common;

use common::{fails, finishes, here, is_empty, scratch, straightline, write};
use serde_json::Value;
use std::path::Path;

/// Of a few pixels and rounds: what is said of time does not matter here.
const SMALL: [&str; 4] = ["--size", "48x32", "--rounds", "3"];

fn sweep(kernel: &str, out: &Path, more: &[&str]) -> String {
    let words = ["study", "sweep", kernel, "--out", out.to_str().unwrap()];
    finishes(&[&words[..], &SMALL, more].concat())
}

fn record(out: &Path) -> Value {
    let text = std::fs::read_to_string(out.join("sweep.json")).expect("a record");
    serde_json::from_str(&text).expect("JSON")
}

fn variants(record: &Value) -> &Vec<Value> {
    record["variants"].as_array().expect("variants")
}

#[test]
fn every_combination_is_measured_beside_its_baseline() {
    let out = scratch("sweep-product").join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let more = [
        "--set",
        "radius=1..=2",
        "--unroll",
        "none,2,full",
        "--stage",
        "compute,fragment",
        "--workgroup",
        "8x8,16x4",
    ];
    let table = sweep(&kernel, &out, &more);
    let record = record(&out);
    // Two radii, three policies; two workgroups of compute, and fragments.
    assert_eq!(variants(&record).len(), 2 * 3 * 3);
    for variant in variants(&record) {
        let measured = &variant["measured"];
        assert_eq!(measured["rounds_ms"].as_array().map(Vec::len), Some(3), "{variant}");
        assert!(measured["difference"].as_f64().unwrap() < 1e-6, "{variant}");
        assert!(measured["speedup"]["median"].as_f64().unwrap() > 0.0, "{variant}");
        let taps = match variant["settings"]["radius"].as_str() {
            Some("1") => 3,
            _ => 5,
        };
        assert_eq!(measured["reads"], taps);
        let is_loop = measured["loops"] == 1;
        assert!(is_loop || variant["settings"]["unroll"] != "none", "{variant}");
        assert!(variant["refused"].is_null());
    }
    assert_eq!(record["baseline"]["unroll"], "none");
    assert_eq!(record["input"], "the test card");
    for word in ["radius", "partial(2)", "fragment", "16x4", "over unroll=none"] {
        assert!(table.contains(word), "no {word} in:\n{table}");
    }
    let csv = std::fs::read_to_string(out.join("sweep.csv")).expect("a table");
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 1 + 18 * 3);
    assert!(lines[0].starts_with("radius,unroll,loops,stage,workgroup,block,rival,round,ms,"));
    let columns = lines[0].split(',').count();
    assert!(lines.iter().all(|line| line.split(',').count() == columns));
}

/// Further settings of a shader are axes as options are.
#[test]
fn further_settings_are_varied() {
    let out = scratch("sweep-vary").join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let more = [
        "--vary",
        "math=exact,fast",
        "--vary",
        "repeat-loads=false,true",
        "--unroll",
        "full",
    ];
    sweep(
        &kernel,
        &out,
        &[&more[..], &["--set", "radius=3", "--baseline", "repeat-loads=true"]].concat(),
    );
    let record = record(&out);
    assert_eq!(variants(&record).len(), 4);
    for variant in variants(&record) {
        let (settings, measured) = (&variant["settings"], &variant["measured"]);
        let fast = settings["math"] == "fast";
        assert_eq!(variant["refused"], Value::Null, "{variant}");
        assert_eq!(measured["speedup"].is_null(), measured.is_null(), "{variant}");
        let difference = measured["difference"].as_f64().expect("a number");
        assert!(difference < if fast { 1e-4 } else { 1e-6 }, "{variant}");
    }
    let reads = |repeated: &str| {
        let of = variants(&record)
            .iter()
            .find(|variant| variant["settings"]["repeat-loads"] == repeated);
        of.map(|variant| variant["measured"]["reads"].as_u64().expect("a number"))
    };
    assert!(reads("true") >= reads("false"), "{record}");
}

/// Two shaders that are equal are recognised, and their ratio is marked as noise.
#[test]
fn variants_are_compiled_for_gpus_that_are_not_there() {
    let out = scratch("sweep-isa").join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let more = ["--set", "radius=2,6", "--unroll", "none,full", "--isa", "amd:navi21"];
    let table = sweep(&kernel, &out, &more);
    for word in [
        "amd:navi21 cycles",
        "amd:navi21 registers",
        "amd:navi21 loops kept",
        "NAVI21",
    ] {
        assert!(table.contains(word), "`{word}` is not in {table}");
    }
    let record = record(&out);
    let figure = |name: &str| -> Vec<u64> {
        let machine = variants(&record)
            .iter()
            .map(|v| &v["measured"]["machine"]["amd:navi21"]);
        machine
            .map(|machine| machine[name].as_u64().expect("a figure"))
            .collect()
    };
    // A wider filter has more of everything, and the loop costs more than its text.
    let cycles = figure("cycles");
    assert!(cycles[1] < cycles[0] && cycles[1] < cycles[3], "{cycles:?}");
    assert!(figure("instructions")[1] < figure("instructions")[3]);
    assert_eq!(figure("spilled"), [0; 4]);
    let rows = std::fs::read_to_string(out.join("sweep.csv")).expect("a table");
    assert!(
        rows.lines()
            .next()
            .is_some_and(|head| head.contains("amd:navi21 at once")),
        "{rows}"
    );
    fails(
        &[
            "study",
            "sweep",
            &kernel,
            "--isa",
            "navi99",
            "--out",
            out.to_str().unwrap(),
        ],
        2,
        &["navi99", "--isa"],
    );
}

#[test]
fn equal_shaders_show_the_noise() {
    let folder = scratch("sweep-noise");
    let out = folder.join("out");
    let text = "pub fn copy(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel)\n}\n";
    let kernel = write(&folder, "copy.rs", text);
    let more = [
        "--vary",
        "repeat-loads=false,true",
        "--unroll",
        "full",
        "--baseline",
        "repeat-loads=false",
    ];
    let table = sweep(&kernel, &out, &more);
    let hashes: Vec<_> = variants(&record(&out))
        .iter()
        .map(|of| of["measured"]["hash"].clone())
        .collect();
    assert_eq!(hashes[0], hashes[1]);
    assert!(table.contains("A pair of equal shaders has a ratio of"), "{table}");
    let other = table.lines().find(|line| line.starts_with("true")).expect("a row");
    assert!(other.contains(" ≈ "), "{table}");
    assert_eq!(record(&out)["intervals"], "blocks");
}

#[test]
fn what_is_refused_stays_in_the_record_with_the_reason() {
    let folder = scratch("sweep-refused");
    let out = folder.join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let table = sweep(&kernel, &out, &["--set", "radius=4,99", "--unroll", "none"]);
    let record = record(&out);
    let [good, bad] = &variants(&record)[..] else {
        panic!("two variants")
    };
    assert!(good["refused"].is_null() && bad["measured"].is_null());
    assert!(bad["refused"].as_str().unwrap().contains("99"), "{bad}");
    assert!(table.contains("not measured, radius=99"), "{table}");
}

#[test]
fn rivals_are_measured_along() {
    let folder = scratch("sweep-rivals");
    let out = folder.join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    for radius in ["2", "3"] {
        let set = format!("radius={radius}");
        let name = format!("row-{radius}");
        let folder = folder.to_str().unwrap();
        let emit = [
            "emit",
            &kernel,
            "--set",
            &set,
            "--unroll",
            "none",
            "--format",
            "rgba32float",
        ];
        finishes(&[&emit[..], &["--workgroup", "8x4", "--name", &name, "--out", folder]].concat());
    }
    write(&folder, "row-4.wgsl", "@compute @workgroup_size(1) fn other() {}\n");
    let pattern = format!("{}/row-{{radius}}.wgsl", folder.display());
    let table = sweep(&kernel, &out, &["--set", "radius=2..=5", "--against", &pattern]);
    let record = record(&out);
    let rivals: Vec<&Value> = variants(&record).iter().filter(|v| !v["rival"].is_null()).collect();
    assert_eq!(rivals.len(), 4);
    for rival in &rivals[..2] {
        let measured = &rival["measured"];
        assert!(measured["difference"].as_f64().unwrap() < 1e-6, "{rival}");
        assert!(measured["loops"].is_null() && !measured["speedup"].is_null());
    }
    let refused = |k: usize| rivals[k]["refused"].as_str().unwrap();
    assert!(
        refused(2).contains("no compute entry point `convolution`"),
        "{}",
        refused(2)
    );
    assert!(refused(3).contains("cannot read"), "{}", refused(3));
    assert!(table.contains("row-2.wgsl"), "{table}");
}

#[test]
fn shards_are_joined_and_runs_compared() {
    let folder = scratch("sweep-shards");
    let kernel = here("examples/sweeps/convolution.rs");
    let [first, second, whole] = ["first", "second", "whole"].map(|name| folder.join(name));
    let vary = ["--set", "radius=1..=3"];
    sweep(&kernel, &first, &[&vary[..], &["--shard", "1/2"]].concat());
    sweep(&kernel, &second, &[&vary[..], &["--shard", "2/2"]].concat());
    let json = |folder: &Path| folder.join("sweep.json").to_str().unwrap().to_owned();
    let (one, two) = (json(&first), json(&second));
    finishes(&["study", "merge", &two, &one, "--out", whole.to_str().unwrap()]);
    let record = record(&whole);
    let radius = |variant: &Value| variant["settings"]["radius"].as_str().unwrap().to_owned();
    let radii: Vec<String> = variants(&record).iter().map(radius).collect();
    assert_eq!(radii, ["1", "1", "2", "2", "3", "3"]);
    assert!(record["shard"].is_null());

    fails(
        &["study", "merge", &one, "--out", whole.to_str().unwrap()],
        1,
        &["missing: 2/2"],
    );
    fails(
        &["study", "merge", &one, &one, "--out", whole.to_str().unwrap()],
        1,
        &["shard 1/2 is there twice"],
    );
    let all = json(&whole);
    fails(
        &["study", "merge", &all, "--out", whole.to_str().unwrap()],
        1,
        &["no shard: it has the whole sweep"],
    );

    // A record does not differ from itself, and does from one in which unrolled shaders took half the time.
    assert!(finishes(&["study", "compare", &all, &all]).contains("second by first"));
    // Times of this machine would differ between rounds, so both records have made ones.
    let timed = |ms_of: fn(&Value, usize) -> f64| {
        let mut made = record.clone();
        for variant in made["variants"].as_array_mut().unwrap() {
            let settings = variant["settings"].clone();
            let rounds = variant["measured"]["rounds_ms"].as_array_mut().unwrap();
            for (k, ms) in rounds.iter_mut().enumerate() {
                *ms = ms_of(&settings, k).into();
            }
        }
        made.to_string()
    };
    let steady = timed(|_, k| 1.0 + 0.01 * k as f64);
    let faster = timed(|settings, k| (1.0 + 0.01 * k as f64) * if settings["unroll"] == "full" { 0.5 } else { 1.0 });
    let steady = write(&folder, "steady.json", &steady);
    let faster = write(&folder, "faster.json", &faster);
    let output = straightline(&["study", "compare", &steady, &faster]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("differs"));
    assert!(String::from_utf8_lossy(&output.stderr).contains("3 of 3 variants differ"));
}

/// A property of a record, as a path of names, and another value for it.
type Change = (&'static [&'static str], Value);

/// Every refusal names the shards that it is about.
#[test]
fn shards_that_do_not_belong_together_are_named() {
    let folder = scratch("sweep-unlike");
    let kernel = here("examples/sweeps/convolution.rs");
    let shards = ["1/3", "2/3", "3/3"].map(|shard| {
        let out = folder.join(shard.replace('/', "-of-"));
        sweep(&kernel, &out, &["--set", "radius=1..=3", "--shard", shard]);
        out.join("sweep.json").to_str().unwrap().to_owned()
    });
    let [one, two, three] = &shards;
    let out = folder.join("whole");
    let refused = |records: &[&str], says: &[&str]| {
        let out = ["--out", out.to_str().unwrap()];
        fails(&[&["study", "merge"], records, &out].concat(), 1, says);
    };
    let changed = |(path, value): Change| {
        let text = std::fs::read_to_string(two).expect("a record");
        let mut record: Value = serde_json::from_str(&text).expect("JSON");
        *path.iter().fold(&mut record, |at, name| &mut at[*name]) = value;
        write(&folder, "changed.json", &record.to_string())
    };
    let changes: [(Change, &[&str]); 7] = [
        (
            (&["adapter"], "another".into()),
            &["different adapters: ", "(1/3, 3/3), `another` (2/3)"],
        ),
        (
            (&["size"], [64, 32].into()),
            &["different sizes: `48x32` (1/3, 3/3), `64x32` (2/3)"],
        ),
        ((&["source"], "0".into()), &["different source texts: ", "`0` (2/3)"]),
        (
            (&["rounds"], 5.into()),
            &["different numbers of rounds: `3` (1/3, 3/3), `5` (2/3)"],
        ),
        (
            (&["environment", "commit"], "0abc".into()),
            &["different commits: ", "`0abc` (2/3)"],
        ),
        (
            (&["complete"], false.into()),
            &["shards are interrupted: 2/3; measure them again"],
        ),
        (
            (&["shard", "count"], 4.into()),
            &["different divisions of the sweep: 1/3, 2/4, 3/3"],
        ),
    ];
    for (change, says) in changes {
        refused(&[one, &changed(change), three], says);
    }
    refused(&[three], &["shards are missing: 1/3, 2/3; measure them again"]);
    let gone = folder.join("gone.json").to_str().unwrap().to_owned();
    refused(&[one, &gone, "nowhere.json"], &["gone.json", "nowhere.json"]);
    assert!(is_empty(&out));
}

/// An engine sees by the status that a shard is to be taken again.
#[cfg(unix)]
#[test]
fn an_interrupted_shard_is_a_failure() {
    let out = scratch("sweep-interrupted").join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let words = ["study", "sweep", &kernel, "--size", "48x32", "--rounds", "1000"];
    let more = [
        "--set",
        "radius=1..=9",
        "--shard",
        "2/3",
        "--out",
        out.to_str().unwrap(),
    ];
    // On a busy machine a signal may come before the sweep listens, and nothing is measured.
    for seconds in [2, 4, 8] {
        let child = std::process::Command::new(env!("CARGO_BIN_EXE_straightline"))
            .args([&words[..], &more].concat())
            .stderr(std::process::Stdio::piped())
            .stdout(std::process::Stdio::null())
            .spawn()
            .expect("the binary runs");
        std::thread::sleep(std::time::Duration::from_secs(seconds));
        let killed = std::process::Command::new("kill")
            .args(["-TERM", &child.id().to_string()])
            .status();
        assert!(killed.expect("kill").success());
        let output = child.wait_with_output().expect("an end");
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{error}");
        if !is_empty(&out) {
            assert!(error.contains("shard 2/3 was interrupted"), "{error}");
            break;
        }
    }
    assert_eq!(record(&out)["complete"], false);
}

#[test]
fn settings_that_are_no_axes_are_refused() {
    let kernel = here("examples/sweeps/convolution.rs");
    for (vary, says) in [
        ("mat=exact,fast", "did you mean `math`?"),
        ("math=exact,quick", "unknown mathematics `quick`"),
        ("unroll=full", "`unroll` is an axis of every sweep: --unroll"),
        ("group=0,1", "`group` is no axis"),
        ("budget=10,20", "`budget` is no axis"),
        ("math", "is not of the form"),
    ] {
        fails(
            &["study", "sweep", &kernel, "--out", "nowhere", "--vary", vary],
            2,
            &[says],
        );
    }
    let twice = [
        "study",
        "sweep",
        &kernel,
        "--out",
        "nowhere",
        "--vary",
        "math=exact",
        "--vary",
        "math=fast",
    ];
    fails(&twice, 2, &["--vary math is given twice"]);
}

#[test]
fn what_cannot_be_swept_is_refused_before_any_work() {
    let folder = scratch("sweep-bad");
    let out = folder.join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let bad = |more: &[&str], status: i32, says: &[&str]| {
        let words = ["study", "sweep", &kernel, "--out", out.to_str().unwrap()];
        fails(&[&words[..], &SMALL, more].concat(), status, says);
    };
    bad(&["--set", "radius=8..1"], 2, &["`8..1` is an empty range"]);
    bad(&["--set", "radius=1..x"], 2, &["`1..x` is no range of integers"]);
    bad(&["--set", "radius"], 2, &["OPTION=VALUE"]);
    bad(&["--set", "radius=1,1"], 2, &["`1` twice"]);
    bad(
        &["--set", "radius=1", "--set", "radius=2"],
        2,
        &["`radius` is given twice"],
    );
    bad(&["--set", "block=1"], 2, &["`block` cannot be swept"]);
    bad(&["--set", "raduis=1,2"], 2, &["raduis", "radius"]);
    bad(&["--unroll", "some"], 2, &["some"]);
    bad(&["--unroll", "none,none"], 2, &["`none` twice"]);
    bad(&["--loops", "forever"], 2, &["neither `bounded` nor `unbounded`"]);
    bad(&["--baseline", "unroll=4"], 2, &["unroll=4", "none, full"]);
    bad(&["--baseline", "colour=red"], 2, &["`colour`, which is not varied"]);
    bad(&["--until", "2"], 2, &["2%"]);
    bad(&["--shard", "3/2"], 2, &["1/8 to 8/8"]);
    bad(&["--shard", "1/2"], 2, &["1 groups", "2 shards"]);
    bad(&["--input", "nowhere.png"], 1, &["nowhere.png"]);
    bad(&["--against", "nowhere.wgsl"], 2, &["there is no file nowhere.wgsl"]);
    bad(&["--against", "row-{unroll}.wgsl"], 2, &["`{unroll}`"]);
    assert!(is_empty(&out));
    let broken = write(&folder, "broken.rs", "pub fn broken(pixel: IVec2) -> Vec4 { 1.0 }\n");
    fails(
        &["study", "sweep", &broken, "--out", out.to_str().unwrap()],
        1,
        &["broken.rs:1"],
    );
    let other = write(&folder, "other.json", "{}");
    fails(
        &["study", "compare", &other, &other],
        1,
        &["other.json", "not a record of this study"],
    );
}

/// The picture of a user's own is what is read, and its size is that of the frames.
#[test]
fn inputs_are_those_that_are_given() {
    let folder = scratch("sweep-inputs");
    let out = folder.join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let picture = folder.join("grey.png").to_str().unwrap().to_owned();
    let text = "pub fn grey(pixel: IVec2) -> Vec4 { Vec4::splat(0.5) }\n";
    let grey = write(&folder, "grey.rs", text);
    finishes(&["run", &grey, "--size", "24x20", "--out", &picture]);
    let words = ["study", "sweep", &kernel, "--rounds", "2", "--input", &picture];
    finishes(&[&words[..], &["--out", out.to_str().unwrap()]].concat());
    let record = record(&out);
    assert_eq!(record["size"], serde_json::json!([24, 20]));
    assert!(record["input"].as_str().unwrap().contains("grey.png"));
}

/// Rounds end when all ratios are sure enough.
#[test]
fn rounds_end_when_all_is_sure() {
    let out = scratch("sweep-until").join("out");
    let kernel = here("examples/sweeps/convolution.rs");
    let words = [
        "study", "sweep", &kernel, "--size", "48x32", "--rounds", "40", "--until", "100%",
    ];
    finishes(&[&words[..], &["--out", out.to_str().unwrap()]].concat());
    // A busy machine needs more of them, but not all.
    for variant in variants(&record(&out)) {
        let rounds = variant["measured"]["rounds_ms"].as_array().map_or(0, Vec::len);
        assert!(rounds.is_multiple_of(10) && (10..40).contains(&rounds), "{rounds}");
    }
}

//! Standard output that is closed, or full; messages about long values; what is left behind.
#![cfg(unix)]

use crate::common;

use common::{fails, finishes, is_empty, scratch, straightline, write};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_straightline"));
    command.args(arguments);
    command
}

#[test]
fn a_pipe_that_closes_early_is_no_error() {
    for arguments in [
        &["list"][..],
        &["explain", "sraa", "--dump"],
        &["--help"],
        &["scenes", "--json"],
    ] {
        let mut child = command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        // As `head -1` does, or one that reads nothing.
        let mut first = [0];
        let mut pipe = child.stdout.take().expect("a pipe");
        pipe.read_exact(&mut first).expect("a byte");
        drop(pipe);
        let mut said = String::new();
        child
            .stderr
            .take()
            .expect("a pipe")
            .read_to_string(&mut said)
            .expect("text");
        let status = child.wait().expect("an end");
        assert!(status.success() && said.is_empty(), "{arguments:?}: {status}, {said}");
    }
}

#[test]
fn output_that_is_full_is_an_error_and_no_panic() {
    for arguments in [&["list"][..], &["explain", "stalker"], &["--help"]] {
        let full = File::options().write(true).open("/dev/full").expect("a full device");
        let output = command(arguments).stdout(full).output().expect("the binary runs");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
        assert!(
            said.contains("cannot write to standard output") && !said.contains("panicked"),
            "{said}"
        );
    }
    // The exit status reports errors that cannot be written.
    let full = File::options().write(true).open("/dev/full").expect("a full device");
    let status = command(&["emit", "nothing", "--out", "x"]).stderr(full).status();
    assert_eq!(status.expect("the binary runs").code(), Some(2));
}

#[test]
fn long_values_are_shortened() {
    let long = "9".repeat(100_000);
    let set = format!("pattern={long}");
    for arguments in [
        &["explain", "sraa", "--set", set.as_str()][..],
        &["explain", "sraa", "--set", long.as_str()],
        &["explain", long.as_str()],
        &["explain", "sraa", "--unroll", long.as_str()],
        &["explain", "sraa", "--block", long.as_str()],
        &["budget", "--shading-cost", long.as_str()],
        &["run", "sraa", "--size", long.as_str(), "--out", "x.png"],
        &["capture", "--scene", long.as_str(), "--out", "x"],
    ] {
        let output = straightline(arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success(), "{said}");
        assert!(
            said.len() < 3000 && said.contains("99"),
            "{}: {}",
            said.len(),
            arguments[0]
        );
    }
}

#[test]
fn values_that_say_nothing_are_refused() {
    fails(
        &["explain", "sraa", "--set", "pattern=latin4", "--set", "pattern=latin16"],
        2,
        &["`pattern` is set twice, to `latin4` and to `latin16`"],
    );
    fails(
        &[
            "explain",
            "sraa",
            "--unroll-loop",
            "tap=none",
            "--unroll-loop",
            "tap=full",
        ],
        2,
        &["loop `tap` is given two policies"],
    );
}

/// Options that another option makes void.
#[test]
fn options_that_do_nothing_are_refused() {
    let refused = |kernel: &str, set: &[&str], says: &str| {
        let mut words = vec!["explain", kernel];
        words.extend(set.iter().flat_map(|option| ["--set", option]));
        fails(&words, 1, &[says]);
    };
    let gradient = "gradient is of method=quad alone";
    for method in ["method=naive", "method=bilinear", "method=gather"] {
        refused("pcf", &[method, "gradient=prewitt"], gradient);
        refused("pcf", &[method, "spread=2"], "spread is of method=quad alone");
    }
    refused("pcf", &["method=gather", "width=four"], "8 by 8 texels");
    refused(
        "quad_upsampling",
        &["reads=packed", "normals=true"],
        "no room for normals",
    );
    let weights = format!("given={}", vec!["1"; 49].join(","));
    refused(
        "quad_convolution",
        &["weights=given", &weights, "radius=4"],
        "a radius of 3",
    );
    refused("quad_convolution", &["weights=given", "radius=2"], "all 49 are 0");
    finishes(&["explain", "pcf", "--set", "method=gather", "--set", "weights=quadratic"]);
    finishes(&[
        "explain",
        "quad_upsampling",
        "--set",
        "reads=apart",
        "--set",
        "normals=true",
    ]);
    finishes(&[
        "explain",
        "quad_convolution",
        "--set",
        "weights=given",
        "--set",
        &weights,
    ]);
}

#[test]
fn only_regular_files_are_read() {
    let folder = scratch("devices");
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    let pipe = folder.join("pipe.rs");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    let says = &["only regular files are read"];
    fails(&["explain", pipe.to_str().unwrap()], 2, says);
    let layer = folder.join("layer.exr");
    assert!(Command::new("mkfifo").arg(&layer).status().expect("mkfifo").success());
    let input = format!("image={}", layer.display());
    fails(&["run", "quad_convolution", "--input", &input, "--out", out], 1, says);
    let zero = folder.join("zero.png");
    std::os::unix::fs::symlink("/dev/zero", &zero).expect("a link");
    let input = format!("image={}", zero.display());
    fails(&["run", "quad_convolution", "--input", &input, "--out", out], 1, says);
}

/// Long-running commands find out first that they cannot write, and leave nothing over.
#[test]
fn folders_that_cannot_be_written_are_found_out_first() {
    let folder = scratch("unwritable");
    let file = write(&folder, "file", "");
    let below = format!("{file}/out");
    let record = format!("{file}/record.json");
    let start = Instant::now();
    for out in [&file, &below] {
        for words in [
            &["tune", "--scene", "roof", "--max-error", "1", "--out", out.as_str()][..],
            &["study", "loops", "--out", out.as_str()],
            &["study", "--out", out.as_str()],
            &["demo", "--out", out.as_str()],
            &["quads", "--pictures", out.as_str()],
        ] {
            fails(words, 1, &["cannot write", &file]);
        }
    }
    for command in ["quads", "budget"] {
        fails(&[command, "--record", &record], 1, &["cannot write", "record.json"]);
        fails(&[command, "--record", folder.to_str().unwrap()], 1, &["cannot write"]);
    }
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    std::fs::remove_file(&file).unwrap();
    assert!(is_empty(&folder));
}

/// A full disk in the middle of a set: here, a folder where one of its files should be.
#[test]
fn a_set_is_whole_or_not_there() {
    let folder = scratch("half-a-set");
    let out = folder.join("shaders");
    std::fs::create_dir_all(out.join("stalker.wgsl")).unwrap();
    let emit = ["emit", "stalker", "--target", "glsl450,wgsl", "--out"];
    fails(&[&emit[..], &[out.to_str().unwrap()]].concat(), 1, &["stalker.wgsl"]);
    let left: Vec<_> = std::fs::read_dir(&out)
        .unwrap()
        .map(|e| e.unwrap().file_name())
        .collect();
    assert_eq!(left, ["stalker.wgsl"]);
}

fn interrupt(child: &std::process::Child) {
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(killed.expect("kill").success());
}

#[test]
fn an_interrupt_leaves_nothing_unfinished() {
    let folder = scratch("interrupted");
    let out = folder.join("frame");
    let arguments = [
        "capture",
        "--size",
        "640x360",
        "--pattern",
        "latin16",
        "--out",
        out.to_str().unwrap(),
    ];
    let mut interrupted = 0;
    for _ in 0..3 {
        let mut child = command(&arguments)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the binary runs");
        // Until it has begun to write.
        let partial = || entries(&folder).iter().any(|name| name.contains(".partial-"));
        while !partial() && child.try_wait().expect("a status").is_none() {
            std::thread::sleep(Duration::from_micros(500));
        }
        interrupt(&child);
        match child.wait().expect("an end").code() {
            Some(0) => std::fs::remove_dir_all(&out).unwrap(),
            code => {
                assert_eq!(code, Some(130));
                interrupted += 1;
            }
        }
        assert!(is_empty(&folder), "{:?}", entries(&folder));
    }
    assert!(interrupted > 0, "it was always done before it could be interrupted");
}

/// A disk that is full after so many half kilobytes in each file must leave nothing new, and the earlier contents.
#[test]
fn a_full_disk_leaves_what_was_there() {
    let folder = scratch("full-disk");
    let record = write(&folder, "budget.json", "the old record");
    let full = |blocks: u32, arguments: &[&str]| {
        let limited = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
        let output = Command::new("sh")
            .args(["-c", &limited, env!("CARGO_BIN_EXE_straightline")])
            .args(arguments)
            .output()
            .expect("a shell");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
        assert!(
            said.contains("cannot write") && said.contains("File too large"),
            "{said}"
        );
        assert_eq!(entries(&folder), ["budget.json"], "{arguments:?} leaves more");
        assert_eq!(std::fs::read_to_string(&record).unwrap(), "the old record");
    };
    let below = folder.join("deep/deeper");
    let below = below.to_str().unwrap();
    let small = ["--size", "16x16", "--rounds", "1"];
    full(1, &["budget", "--size", "16x16", "--rounds", "3", "--record", &record]);
    full(8, &[&["demo", "--out", below], &small[..]].concat());
    full(8, &["capture", "--size", "64x64", "--out", below]);
    full(8, &["emit", "sraa", "--out", below]);
}

fn entries(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    entries
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect()
}

#[test]
fn a_record_is_replaced_whole_or_left() {
    let folder = scratch("records");
    let record = write(&folder, "budget.json", "the old record");
    let words = ["budget", "--size", "16x16", "--rounds", "3", "--record", &record];
    finishes(&words);
    let text = std::fs::read_to_string(&record).unwrap();
    assert!(text.starts_with('{') && text.contains("\"filters\""), "{text}");
    assert_eq!(entries(&folder), ["budget.json"]);
}

//! Measuring on a GPU: `tools/gpu`, and the driver of this machine's own GPU.

use crate::common;

use common::{fails, here, scratch};
use std::process::Command;

#[test]
fn the_script_writes_each_record_and_packs_them() {
    let folder = scratch("tools-gpu");
    let out = folder.join("records");
    let run = Command::new("bash")
        .arg(here("tools/gpu"))
        .args([out.as_os_str(), "3".as_ref()])
        .env("STRAIGHTLINE", env!("CARGO_BIN_EXE_straightline"))
        .env("STEPS", "adapters budget slang frame")
        .envs([("SIZE", "64x36"), ("ROUNDS", "3")])
        .output()
        .expect("bash runs");
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(run.status.success(), "{said}{}", String::from_utf8_lossy(&run.stderr));
    for step in ["adapters: done", "budget: done", "slang: done"] {
        assert!(said.contains(step), "{said}");
    }
    // Without records of errors there is no frame to plot, and the script says so and goes on.
    assert!(said.contains("frame: failed with 1"), "{said}");
    assert!(out.join("slang/sweep.json").is_file() && out.join("budget/budget.json").is_file());
    assert!(folder.join("records.tar.gz").is_file());
    std::fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn minutes_are_a_whole_number() {
    let folder = scratch("tools-gpu-minutes");
    let run = Command::new("bash")
        .arg(here("tools/gpu"))
        .args([folder.join("out").as_os_str(), "3.5".as_ref()])
        .output()
        .expect("bash runs");
    assert_eq!(run.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&run.stderr).contains("not '3.5'"));
    std::fs::remove_dir_all(&folder).expect("removed");
}

/// Software drivers do not report on what they compile.
#[test]
fn a_driver_that_reports_nothing_is_named() {
    fails(
        &["explain", "stalker", "--isa", "device"],
        1,
        &[
            "the driver of this machine's GPU cannot be asked",
            "VK_KHR_pipeline_executable_properties",
        ],
    );
    fails(
        &[
            "tune",
            "--scene",
            "roof",
            "--cost",
            "isa:device",
            "--max-error",
            "1",
            "--out",
            "nowhere",
        ],
        2,
        &["states no cycles"],
    );
}

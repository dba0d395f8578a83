//! Chains of passes, as each command takes them.

use crate::common;

use common::{example, fails, finishes, here, is_empty, scratch, straightline, write};
use straightline_manifest::chain::ChainPlan;

/// A chain whose picture a sampler reads.
const GLOW: &str = "
pub fn glow(color: &Texture<Vec4>, linear: &Sampler) -> Texture<Vec4> {
    let small: Texture<Vec4> = draw(color.size() / 2, |pixel| color.load(pixel * 2));
    draw(color.size(), |pixel| {
        let uv = (pixel.as_vec2() + 0.5) / color.size().as_vec2();
        small.sample(linear, uv)
    })
}";

fn bloom() -> String {
    here("examples/chains/bloom.rs")
}

#[test]
fn a_chain_is_checked_explained_and_listed() {
    assert!(finishes(&["check", &bloom()]).contains("no errors"));
    let listed = finishes(&["list", &bloom()]);
    assert!(
        listed.contains("a chain of passes") && listed.contains("levels"),
        "{listed}"
    );
    let explain = |fuse: &str| finishes(&["explain", &bloom(), "--set", "levels=3", "--fuse", fuse]);
    let contains = |explained: &str, texts: &[&str]| {
        for text in texts {
            assert!(explained.contains(text), "no `{text}` in:\n{explained}");
        }
    };
    let light = "`light` is stored: 17 reads of it cost less than";
    contains(&explain("auto"), &["6 passes of 4 shaders", "color.size() / 8", light]);
    let shared = "`bloom_cascade`: workgroups compute up, up_2, result, in tiles of";
    contains(&explain("share"), &["2 passes of 2 shaders", "light, down", shared]);
    contains(
        &explain("share:up_2"),
        &["5 passes of 4 shaders", "workgroups compute up_2, result"],
    );
    let json = finishes(&["explain", &bloom(), "--fuse", "share", "--json"]);
    assert!(json.contains("\"picture\": \"down_5\""), "{json}");
    let json = finishes(&["explain", &here("examples/chains/blur.rs"), "--fuse", "all", "--json"]);
    assert!(json.contains("\"fused\": [\n    \"rows\"\n  ]"), "{json}");
}

#[test]
fn a_chain_is_emitted_with_its_plan() {
    let folder = scratch("chain-emit");
    let out = folder.to_str().expect("a path of text");
    let printed = finishes(&[
        "emit",
        &bloom(),
        "--target",
        "wgsl,hlsl",
        "--name",
        "glow",
        "--out",
        out,
    ]);
    assert_eq!(printed.lines().count(), 4 * 3 + 1, "{printed}");
    let text = std::fs::read_to_string(folder.join("glow.chain.json")).expect("a plan");
    let plan = ChainPlan::from_json(&text).unwrap_or_else(|e| panic!("{e}"));
    plan.check().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(plan.passes.len(), 12);
    assert_eq!(plan.shaders(), ["glow_light", "glow_down", "glow_up", "glow"]);
    for shader in plan.shaders() {
        let manifest = std::fs::read_to_string(folder.join(format!("{shader}.json"))).expect("a manifest");
        assert!(manifest.contains(&format!("\"wgsl\": \"{shader}.wgsl\"")), "{manifest}");
    }
}

#[test]
fn both_executors_draw_a_chain() {
    let folder = scratch("chain-run");
    let [gpu, cpu] = ["gpu.png", "cpu.png"].map(|name| folder.join(name).display().to_string());
    let picture = here("docs/detail.png");
    let words = [
        "run",
        &bloom(),
        "--input",
        &picture,
        "--uniform",
        "threshold=0.5",
        "--uniform",
        "strength=0.4",
    ];
    let set = ["--set", "levels=2"];
    finishes(&[&words[..], &set, &["--out", &gpu]].concat());
    finishes(&[&words[..], &set, &["--executor", "cpu", "--out", &cpu]].concat());
    let compared = finishes(&["compare", &gpu, &cpu]);
    let found = compared
        .split_whitespace()
        .filter_map(|word| word.parse::<f64>().ok())
        .next();
    assert!(
        found.is_some_and(|decibels| decibels > 40.0) || compared.contains("equal"),
        "{compared}"
    );
}

#[test]
fn requests_that_mean_nothing_are_refused() {
    let folder = scratch("chain-refused");
    let out = folder.to_str().expect("a path of text");
    fails(
        &["emit", &example("median"), "--fuse", "all", "--out", out],
        2,
        &["is one pass", "--fuse"],
    );
    fails(
        &["emit", &bloom(), "--engine", "godot", "--out", out],
        1,
        &[
            "E0801",
            "`bloom` does not fit Godot: it has 12 passes, and Godot takes one",
            "webgpu",
            "--fuse all",
        ],
    );
    let glow = write(&folder, "glow.rs", GLOW);
    for fuse in ["small", "share:small"] {
        let refused = [
            "the picture `small` cannot be fused: a sampler reads it",
            "leave it out of `--fuse`",
        ];
        fails(&["emit", &glow, "--fuse", fuse, "--out", out], 1, &refused);
    }
    let blur = here("examples/chains/blur.rs");
    let shared = ["emit", &blur, "--fuse", "share", "--out", out];
    for (option, value) in [
        ("--stage", "fragment"),
        ("--form", "function"),
        ("--origin", "lower-left"),
        ("--workgroup", "8x8"),
        ("--share", "workgroup"),
        ("--block", "2x2"),
        ("--reads", "gather"),
    ] {
        let knob = option.trim_start_matches('-');
        let unfit = format!("pictures cannot be shared by workgroups with this `{knob}`");
        let instead = format!("leave `{knob}` out");
        fails(&[&shared[..], &[option, value]].concat(), 1, &[&unfit, &instead]);
    }
    let no_memory = [
        "computes `result` and others in the memory of workgroups",
        "leave `share` out of `--fuse`",
    ];
    fails(&[&shared[..], &["--engine", "webgpu"]].concat(), 1, &no_memory);
    fails(
        &["emit", &blur, "--fuse", "share:result", "--out", out],
        1,
        &["no later pass reads it"],
    );
    fails(
        &["emit", &blur, "--fuse", "rows,share:rows", "--out", out],
        2,
        &["`rows` is given twice"],
    );
    fails(
        &["run", &bloom(), "--input", &here("docs/detail.png"), "--out", "x.png"],
        2,
        &["--uniform threshold=VALUE"],
    );
    fails(&["explain", &bloom(), "--draw", "x.svg"], 2, &["--draw is for kernels"]);
    let broken = write(
        &folder,
        "broken.rs",
        "pub fn broken(color: &Texture<Vec4>) -> Texture<Vec4> { color }\n",
    );
    let output = straightline(&["check", &broken]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("E0412"));
    std::fs::remove_file(&broken).expect("the file");
    std::fs::remove_file(&glow).expect("the file");
    assert!(is_empty(&folder));
}

/// An engine takes a chain of which one pass is left.
#[test]
fn an_engine_takes_a_fused_chain() {
    let folder = scratch("chain-engine");
    let out = folder.to_str().expect("a path of text");
    finishes(&[
        "emit",
        &here("examples/chains/blur.rs"),
        "--set",
        "radius=1",
        "--fuse",
        "all",
        "--engine",
        "godot",
        "--out",
        out,
    ]);
    assert!(!is_empty(&folder));
}

/// Passes have names of their own where functions of the files have theirs.
#[test]
fn the_passes_of_smaa_are_emitted() {
    let folder = scratch("chain-smaa");
    let out = folder.to_str().expect("a path of text");
    let chain = here("examples/chains/smaa.rs");
    let files = ["edges", "weights", "blend"].map(|name| here(&format!("examples/gallery/smaa_{name}.rs")));
    let mut words = vec!["emit", &chain, "--out", out];
    files.iter().for_each(|file| words.extend(["--source", file.as_str()]));
    finishes(&words);
    let text = std::fs::read_to_string(folder.join("smaa.chain.json")).expect("a plan");
    let plan = ChainPlan::from_json(&text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(plan.shaders(), ["smaa_edges_pass", "smaa_weights_pass", "smaa"]);
    assert_eq!(plan.inputs.join(" "), "color area search linear");
    let formats: Vec<&str> = plan.pictures.iter().map(|picture| picture.format.wgsl_name()).collect();
    assert_eq!(formats, ["rgba8unorm", "rgba8unorm", "rgba16float"]);
}

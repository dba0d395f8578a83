//! `emit` refuses what is broken: one clear error, an exit status that says whose fault it is, no partial file.

mod common;

use common::{example, fails, finishes, is_empty, scratch, write};

#[test]
fn a_syntax_error_is_shown_with_its_place() {
    let folder = scratch("syntax");
    let kernel = write(
        &folder,
        "broken.rs",
        "use straightline_kernels::prelude::*;\npub fn broken(pixel: IVec2) -> Vec4 {\n    let x = ;\n}\n",
    );
    let out = folder.join("out");
    fails(
        &["emit", &kernel, "--out", out.to_str().unwrap()],
        1,
        &["broken.rs:3:13", "not valid Rust"],
    );
    assert!(is_empty(&out));
}

#[test]
fn every_unsupported_construct_is_named_with_help() {
    let folder = scratch("unsupported");
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let f = unsafe { 1.0 };\n    let n = async { 1.0 };\n    color.load(pixel)\n}\n";
    let kernel = write(&folder, "k.rs", text);
    let says = [
        "k.rs:2:13",
        "`unsafe`",
        "k.rs:3:13",
        "`async`",
        "a kernel computes its value at once",
    ];
    fails(
        &["emit", &kernel, "--out", folder.join("out").to_str().unwrap()],
        1,
        &says,
    );
    assert!(is_empty(&folder.join("out")));
}

#[test]
fn errors_of_evaluation_have_their_place_too() {
    let folder = scratch("evaluation");
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let a = [1.0, 2.0];\n    let b = a[2];\n    let c = color.lod(pixel);\n    Vec4::splat(b) + c\n}\n";
    let kernel = write(&folder, "k.rs", text);
    fails(
        &["explain", &kernel],
        1,
        &["k.rs:3:13", "index 2 of an array of 2", "k.rs:4:13", "no method `lod`"],
    );
}

#[test]
fn unknown_names_and_values_are_bad_use() {
    fails(&["explain", "sraaa"], 2, &["no kernel `sraaa`", "sraa"]);
    fails(&["explain", "E9999"], 2, &["error[E0211]", "no kernel `E9999`"]);
    assert!(finishes(&["explain", "E0301"]).starts_with("E0301: mismatched types\n\n"));
    let json: serde_json::Value = serde_json::from_str(&finishes(&["explain", "E0301", "--json"])).expect("JSON");
    assert_eq!(json["code"], "E0301");
    fails(
        &["explain", "sraa", "--set", "pattrn=latin4"],
        2,
        &["no option `pattrn`", "pattern"],
    );
    fails(
        &["explain", "sraa", "--set", "pattern=latin5"],
        2,
        &["latin5", "latin16"],
    );
    fails(&["explain", "sraa", "--set", "tau=-1"], 2, &["`-1`", "0 to 1000000"]);
    fails(&["explain", "sraa", "--set", "tau=many"], 2, &["`many`"]);
    fails(&["explain", "sraa", "--set", "tau"], 2, &["OPTION=VALUE"]);
    fails(
        &["emit", "sraa", "--target", "cg", "--out", "nowhere"],
        2,
        &["cg", "glsl450"],
    );
    fails(&["no-such-command"], 2, &["no-such-command"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = scratch("unwritable");
    // A file where the folder should be: refused to everyone, root included.
    let blocked = write(&folder, "blocked", "");
    fails(
        &["emit", "sraa", "--out", &format!("{blocked}/shaders")],
        1,
        &["blocked", "cannot write"],
    );
    fails(
        &["demo", "--out", &format!("{blocked}/demo"), "--size", "16x16"],
        1,
        &["blocked", "cannot write"],
    );
}

#[test]
fn transports_that_a_stage_does_not_have_are_refused() {
    let folder = scratch("transports");
    let out = folder.join("out");
    let out = out.to_str().unwrap();
    fails(
        &["emit", "pcf", "--transport", "subgroup", "--out", out],
        1,
        &["no pixel quads", "`block`"],
    );
    fails(
        &[
            "emit",
            "pcf",
            "--transport",
            "block",
            "--stage",
            "fragment",
            "--out",
            out,
        ],
        1,
        &["a fragment writes one"],
    );
    fails(
        &[
            "emit",
            "sraa",
            "--transport",
            "subgroup",
            "--stage",
            "fragment",
            "--out",
            out,
        ],
        1,
        &["sends no messages", "pixel: Quad<IVec2>"],
    );
    fails(
        &["emit", "pcf", "--transport", "telepathy", "--out", out],
        2,
        &["subgroup, derivatives or block"],
    );
    fails(
        &["emit", "pcf", "--block", "2x3", "--out", out],
        1,
        &["a block of 2x3 pixels has other", "whole quads"],
    );
    assert!(is_empty(&folder.join("out")));
}

#[test]
fn workgroups_share_texels_where_they_are_asked_to() {
    let folder = scratch("shared");
    let out = folder.to_str().unwrap();
    let kernel = common::here("kernels/filters/bilateral.rs");
    let emit = |given: &[&str]| {
        finishes(&[&["emit", &kernel, "--out", out], given].concat());
        std::fs::read_to_string(folder.join("bilateral.wgsl")).expect("a shader")
    };
    let wgsl = emit(&["--share", "workgroup"]);
    assert!(wgsl.contains("var<workgroup> color_tile: array<vec4f, 484>;"), "{wgsl}");
    assert!(wgsl.contains("22x22 of color (2 reads instead of 49)"), "{wgsl}");
    for wgsl in [
        emit(&["--share", "workgroup", "--workgroup", "32x4"]),
        emit(&["--share", "workgroup(32x4)", "--workgroup", "32x4"]),
        emit(&["--share", "workgroup(32x4)"]),
    ] {
        assert!(wgsl.contains("@workgroup_size(32, 4, 1)"), "{wgsl}");
        assert!(wgsl.contains("color_tile: array<vec4f, 380>;"), "{wgsl}");
    }
    let explained = finishes(&["explain", "sraa", "--share", "workgroup"]);
    for told in [
        "reads of shared memory",
        "18x18 from (-1, -1)",
        "4 reads of `depth` not shared: a pixel reads one texel",
    ] {
        assert!(explained.contains(told), "{told}: {explained}");
    }
    let json = finishes(&["explain", "sraa", "--share", "workgroup", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["sharing"]["workgroup"], serde_json::json!([16, 16]));
    assert_eq!(json["sharing"]["tiles"][0]["reads_of_a_thread"], 2);
    assert_eq!(json["barriers"], 1);
    let of_loops = &json["loops_of_the_source"];
    let of_loops = of_loops.as_array().expect("a list of loops");
    assert!(!of_loops.is_empty(), "{json}");
    for of_loop in of_loops {
        assert!(
            of_loop["unroll"] == "full" && of_loop["line"].as_u64() > Some(0),
            "{of_loop}"
        );
    }
    fails(
        &["explain", "sraa", "--share", "quad"],
        2,
        &["unknown sharing `quad`", "workgroup(WxH)"],
    );
    fails(
        &["explain", "sraa", "--share", "workgroup(64x64)"],
        1,
        &["a workgroup of 64x64 threads", "use 1 to 256 threads"],
    );
    fails(
        &[
            "emit",
            &kernel,
            "--share",
            "workgroup",
            "--stage",
            "fragment",
            "--out",
            out,
        ],
        1,
        &["shares texels by workgroup", "emit it for compute"],
    );
}

#[test]
fn places_names_forms_and_origins_are_the_users() {
    let folder = scratch("places");
    let out = folder.join("out");
    let out_text = out.to_str().unwrap();
    let given = [
        "--group",
        "1",
        "--binding",
        "color=4",
        "--register",
        "depth=t7,space2",
        "--entry",
        "resolve",
        "--target",
        "wgsl,hlsl",
    ];
    finishes(&[&["emit", "sraa", "--out", out_text], &given[..]].concat());
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let (wgsl, hlsl) = (read("sraa.wgsl"), read("sraa.hlsl"));
    assert!(
        wgsl.contains("@group(1) @binding(4) var color") && wgsl.contains("fn resolve("),
        "{wgsl}"
    );
    assert!(
        hlsl.contains("depth : register(t7, space2)") && hlsl.contains("color : register(t4, space1)"),
        "{hlsl}"
    );
    let given = [
        "--form",
        "function",
        "--origin",
        "lower-left",
        "--target",
        "glsl330",
        "--name",
        "below",
    ];
    finishes(&[&["emit", "stalker", "--out", out_text], &given[..]].concat());
    assert!(
        read("below.330.glsl").contains("vec4 stalker(sampler2D "),
        "{}",
        read("below.330.glsl")
    );
    for (option, value, says) in [
        ("--binding", "depth", "NAME=NUMBER"),
        ("--binding", "depth=-1", "NAME=NUMBER"),
        ("--register", "depth=q1", "is no register"),
        ("--register", "depth", "NAME=REGISTER"),
        ("--form", "thing", "one of entry, function"),
        ("--origin", "left", "one of upper-left, lower-left"),
        ("--group", "one", "--group"),
    ] {
        fails(
            &["emit", "sraa", "--out", "nowhere", option, value],
            2,
            &[value.split('=').next_back().unwrap(), says],
        );
    }
    fails(
        &["emit", "sraa", "--out", "nowhere", "--binding", "deph=1"],
        1,
        &["`sraa`", "nothing called `deph`", "did you mean `depth`"],
    );
}

#[test]
fn engines_get_their_folder_or_the_reason() {
    let folder = scratch("engines");
    let out = folder.join("out");
    let out_text = out.to_str().unwrap();
    let kuwahara = example("kuwahara");
    let said = finishes(&[
        "emit", &kuwahara, "--engine", "mpv", "--name", "painted", "--out", out_text,
    ]);
    let names = ["README.md", "painted.glsl"];
    for name in names {
        assert!(said.contains(name) && out.join(name).is_file(), "{said}");
    }
    let none = folder.join("none");
    let none_text = none.to_str().unwrap();
    fails(
        &["emit", "sraa", "--engine", "mpv", "--out", none_text],
        1,
        &[
            "error[E0801]: `sraa` does not fit mpv: it binds 3 textures, and mpv gives one picture",
            "help: these engines take it: babylon, ",
        ],
    );
    fails(
        &["emit", "sraa", "--engine", "gdot", "--out", none_text],
        2,
        &["there is no engine `gdot`: one of babylon, bevy"],
    );
    fails(
        &[
            "emit", "sraa", "--engine", "three", "--target", "wgsl", "--out", none_text,
        ],
        2,
        &["--engine"],
    );
    assert!(is_empty(&none));
    let list = finishes(&["list", "godot"]);
    assert!(list.contains("godot: Godot: a .gdshader"), "{list}");
}

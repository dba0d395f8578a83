//! `explain --at`, `emit --debug` and `emit -g`.

use crate::common;

use common::{fails, finishes, here, scratch, write};

#[test]
fn the_document_quotes_what_is_printed() {
    let document = std::fs::read_to_string(here("docs/emitted-code.md")).expect("docs/emitted-code.md");
    let printed = finishes(&["explain", "sraa", "--at", "38"]);
    let quoted = format!("$ straightline explain sraa --at 38\n{printed}");
    assert!(
        document.contains(&quoted),
        "docs/emitted-code.md does not quote:\n{quoted}"
    );
}

#[test]
fn either_line_leads_to_the_other() {
    let folder = scratch("at");
    let blur = write(
        &folder,
        "blur.rs",
        "pub fn blur(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let here = image.load(pixel);\n    let beside = \
         image.load(pixel + ivec2(1, 0));\n    (here * beside).sqrt() + here - beside\n}\n",
    );
    let out = folder.join("shaders").display().to_string();
    for target in ["wgsl", "hlsl", "glsl450"] {
        let listed = finishes(&["emit", &blur, "-g", "--target", target, "--out", &out]);
        assert!(listed.contains("blur.map.json"), "{listed}");
        let map = format!("{out}/blur.map.json");
        let found = finishes(&["explain", &map, "--at", "blur.rs:3", "--json"]);
        let found: serde_json::Value = serde_json::from_str(&found).expect("JSON");
        let [statement] = found.as_array().expect("a list").as_slice() else {
            panic!("{target}: {found:#}");
        };
        assert_eq!(statement["name"], "beside");
        assert_eq!(statement["file"], "blur.rs");
        let line = format!("{target}:{}", statement["first"]);
        let said = finishes(&["explain", &map, "--at", &line]);
        let source = ", beside: blur.rs:3:18: image.load(pixel + ivec2(1, 0))\n";
        assert!(said.starts_with(&line) && said.ends_with(source), "{said}");
    }
    // Without `-g`, the shader is the one that `explain` describes by itself.
    finishes(&["emit", &blur, "--debug", "map", "--out", &out]);
    let map = format!("{out}/blur.map.json");
    let by_map = finishes(&["explain", &map, "--at", "blur.rs:2"]);
    assert_eq!(finishes(&["explain", &blur, "--at", "blur.rs:2"]), by_map);
}

#[test]
fn lines_without_a_counterpart_are_refused_by_name() {
    let folder = scratch("at-refused");
    let broken = write(&folder, "broken.map.json", "{ \"schema\": 7 }");
    let chain = here("examples/chains/bloom.rs");
    for (kernel, at, status, says) in [
        (
            "sraa",
            "1",
            1,
            "line 1 of `sraa` in wgsl comes from no expression of the source: its statements are in",
        ),
        (
            "sraa",
            "blur.rs:1",
            1,
            "`sraa` has no file blur.rs; it has kernels/src/sraa/mod.rs",
        ),
        ("sraa", "sraa/mod.rs:1", 1, "comes from kernels/src/sraa/mod.rs:1"),
        ("sraa", "spirv:3", 2, "the lines of spirv are those of its translator"),
        ("sraa", "perl:3", 2, "unknown language `perl`"),
        ("sraa", "0", 2, "write 42, hlsl:42 or FILE.rs:12"),
        ("absent.map.json", "3", 1, "absent.map.json"),
        (&broken, "3", 1, "source map schema 7"),
        (&chain, "3", 2, "a chain has a shader for each pass"),
    ] {
        fails(&["explain", kernel, "--at", at], status, &[says]);
    }
}

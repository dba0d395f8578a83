//! `explain --draw`: the drawings of the documents, and what cannot be drawn.
//!
//! After a change of the drawings: `STRAIGHTLINE_BLESS=1 cargo test --workspace --test cli draw::`.

use crate::common;

use common::{fails, finishes, here, scratch, write};

/// Drawings of the documents, with the arguments that make them.
const DRAWINGS: [(&str, &[&str]); 2] = [
    ("docs/taps-sraa.svg", &["explain", "sraa", "--set", "shading=sample0"]),
    ("docs/taps-quad-convolution.svg", &["explain", "quad_convolution"]),
];

#[test]
fn drawings_of_the_documents_are_up_to_date() {
    let folder = scratch("drawings");
    let document = std::fs::read_to_string(here("docs/figures.md")).expect("docs/figures.md");
    for (file, arguments) in DRAWINGS {
        let path = folder.join("drawn.svg").display().to_string();
        finishes(&[arguments, &["--draw", &path]].concat());
        let drawn = std::fs::read_to_string(&path).expect("a drawing");
        let kept = here(file);
        if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
            std::fs::write(&kept, &drawn).expect("a drawing is written");
        }
        let shown = std::fs::read_to_string(&kept).unwrap_or_default();
        let command = format!("straightline {} --draw {file}", arguments.join(" "));
        assert_eq!(drawn, shown, "{file} is stale: run `{command}`");
        assert!(document.contains(&command), "docs/figures.md does not name `{command}`");
    }
}

#[test]
fn json_has_the_facts_of_the_drawing() {
    let said: serde_json::Value =
        serde_json::from_str(&finishes(&["explain", "quad_convolution", "--json"])).expect("JSON");
    let footprint = &said["footprint"];
    assert_eq!(footprint["pixels"], serde_json::json!([2, 2]));
    let taps = footprint["textures"][0]["taps"].as_array().expect("taps");
    assert_eq!(taps.len(), 16);
    let first = taps.iter().filter_map(|tap| tap["weights"][0][0].as_f64());
    assert!((first.sum::<f64>() - 1.0).abs() < 1e-6);
    let messages = footprint["messages"].as_array().expect("messages").iter();
    let sum: u64 = messages.filter_map(|messages| messages["messages"].as_u64()).sum();
    assert_eq!(Some(sum), said["messages"].as_u64());
}

#[test]
fn drawings_fail_with_a_reason() {
    let folder = scratch("no-drawings");
    let within = folder.display().to_string();
    fails(&["explain", "sraa", "--draw", &within], 1, &["cannot write"]);
    let file = format!("{within}/out.svg");
    fails(
        &["explain", "E0301", "--draw", &file],
        2,
        &["--draw goes with a kernel"],
    );
    let kernels = scratch("kernels-without-pixels");
    let text = "pub fn count(bins: &AtomicBuffer<u32>, pixel: IVec2) { bins.add(pixel.x as usize, 1); }";
    let buffers = write(&kernels, "count.rs", text);
    fails(
        &["explain", &buffers, "--draw", &file],
        1,
        &["`count` has no pixel to draw", "reads no texture"],
    );
    assert!(common::is_empty(&folder));
}

/// Blocks, quads in blocks, and loops left in the shader are drawn too.
#[test]
fn other_forms_are_drawn() {
    let folder = scratch("forms");
    let convolution = here("kernels/filters/convolution.rs");
    let forms: [(&[&str], &str); 4] = [
        (&["sraa", "--block", "2x2"], "the 2×2 pixels of an invocation"),
        (
            &["quad_convolution", "--transport", "block"],
            "the 2×2 pixels of an invocation",
        ),
        (&[&convolution, "--unroll", "none"], "14 reads"),
        (&[&convolution, "--share", "workgroup"], "a workgroup of 16×16 pixels"),
    ];
    for (arguments, says) in forms {
        let path = folder.join("drawn.svg").display().to_string();
        finishes(&[&["explain"], arguments, &["--draw", &path]].concat());
        let drawn = std::fs::read_to_string(&path).expect("a drawing");
        assert!(drawn.contains(says), "{arguments:?} does not say `{says}`:\n{drawn}");
    }
}

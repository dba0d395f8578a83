//! Reads a pixel, beside the chapter's.

use super::*;
use straightline_kernels::find;

/// Reads of what is shared; the pixel's own depth, which tells its surface, is not counted by the chapter.
fn reads(name: &str, options: Options<'_>, of: &[&str]) -> u32 {
    let counts = compile(name, options, Unroll::Full, Some(Transport::Subgroup)).counts;
    of.iter()
        .map(|texture| counts.reads.get(*texture).copied().unwrap_or(0))
        .sum()
}

#[test]
fn reads_are_the_chapters() {
    let low = &["low", "low_surface"][..];
    let table: [(&str, Options<'_>, &[&str], u32); 12] = [
        ("quad_upsampling", &[("reads", "packed")], low, 1),
        ("quad_upsampling", &[("reads", "apart")], low, 2),
        ("quad_upsampling", &[("reads", "naive")], low, 8),
        (
            "quad_upsampling",
            &[("reads", "packed"), ("factor", "four-times")],
            low,
            1,
        ),
        ("quad_convolution", &[("radius", "1")], &["image"], 4),
        ("quad_convolution", &[("radius", "2")], &["image"], 9),
        ("pcf", &[("width", "four"), ("method", "naive")], &["shadow"], 16),
        ("pcf", &[("width", "four"), ("method", "bilinear")], &["shadow"], 4),
        ("pcf", &[("width", "four")], &["shadow"], 1),
        ("pcf", &[("width", "eight"), ("method", "naive")], &["shadow"], 64),
        ("pcf", &[("width", "eight")], &["shadow"], 4),
        (
            "pcf",
            &[("width", "eight"), ("weights", "cubic"), ("gradient", "prewitt")],
            &["shadow"],
            4,
        ),
    ];
    for (name, options, of, expected) in table {
        assert_eq!(reads(name, options, of), expected, "{name} {options:?}");
        let compiled = compile(name, options, Unroll::Full, None);
        let paper = (find(name).expect("built in").paper)(&compiled.options);
        assert_eq!(
            paper.expect("the chapter counts it").texture_reads,
            expected,
            "{name} {options:?}"
        );
    }
    // Of the whole quad, computed by one invocation: each texel once.
    for (radius, expected) in [("1", 16), ("2", 36)] {
        let compiled = compile(
            "quad_convolution",
            &[("radius", radius)],
            Unroll::Full,
            Some(Transport::Block),
        );
        assert_eq!(compiled.counts.texture_reads, expected);
    }
    // Rows of quads share across quads too (§2.8): 10×4 texels for 16 pixels.
    let settings = Settings::new().block(8, 2);
    let row = Kernel::builtin("quad_convolution").and_then(|kernel| kernel.compile(&settings));
    assert_eq!(row.expect("whole quads").counts.texture_reads, 40);
    // Named in the chapter, but not counted there.
    let shadow = &["shadow"][..];
    assert_eq!(reads("pcf", &[("width", "twelve")], shadow), 9);
    assert_eq!(reads("pcf", &[("width", "sixteen")], shadow), 16);
    assert_eq!(reads("pcf", &[("width", "sixteen"), ("method", "naive")], shadow), 256);
    assert_eq!(reads("quad_ssao", &[], &["depth"]), 1 + 4);
    assert_eq!(reads("quad_ssao", &[("sharing", "alone")], &["depth"]), 1 + 16);
    assert_eq!(reads("pcss", &[], &["shadow"]), 4 + 4);
    assert_eq!(reads("pcss", &[("sharing", "alone")], &["shadow"]), 16 + 16);
    assert_eq!(reads("quad_bilateral", &[("radius", "2")], &["image"]), 9);
}

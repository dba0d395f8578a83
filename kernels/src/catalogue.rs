//! The built-in kernels, as source text for the generator.

use crate::OptionValues;
use crate::half::{self, HalfPrecision};
use crate::presets::{NO_PRESETS, Preset, SRAA_PRESETS};

/// A built-in kernel.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Name on the command line and in `build.rs`, and of the kernel's function.
    pub name: &'static str,
    /// Description in one line, with the authors in brackets at the end.
    pub summary: &'static str,
    /// Source files of the kernel.
    pub sources: &'static [SourceFile],
    /// Counts in the kernel's publication, for these options.
    pub paper: fn(&OptionValues) -> Option<PaperCounts>,
    /// Effect of half precision, for these options.
    pub half: fn(&OptionValues) -> HalfPrecision,
    /// Named sets of its options.
    pub presets: &'static [Preset],
}

/// A Rust source file.
#[derive(Clone, Copy, Debug)]
pub struct SourceFile {
    /// Path from the root of the workspace, for display only.
    pub path: &'static str,
    /// Contents.
    pub text: &'static str,
}

/// Counts of a kernel's work per pixel, as stated in its publication.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PaperCounts {
    /// Evaluations of the bilateral weight.
    pub weight_evaluations: u32,
    /// Reads of the G-buffer.
    pub texture_reads: u32,
}

macro_rules! source {
    ($path:literal) => {
        SourceFile {
            path: concat!("kernels/src/", $path),
            text: include_str!($path),
        }
    };
}

/// Source files of the SRAA kernels.
const SRAA: &[SourceFile] = &[
    source!("sraa/mod.rs"),
    source!("sraa/options.rs"),
    source!("sraa/colors.rs"),
    source!("sraa/demodulate.rs"),
    source!("sraa/extra.rs"),
    source!("sraa/history.rs"),
    source!("sraa/lobes.rs"),
    source!("sraa/mask.rs"),
    source!("sraa/pattern.rs"),
    source!("sraa/fit.rs"),
    source!("sraa/gbuffer.rs"),
    source!("sraa/guide.rs"),
    source!("sraa/view.rs"),
    source!("sraa/metric.rs"),
    source!("sraa/placed.rs"),
    source!("sraa/search.rs"),
    source!("normals.rs"),
];

/// All built-in kernels.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "sraa",
        summary: "Antialiasing from 1x shading and subpixel geometry (SRAA, Chajdas et al. 2011)",
        sources: SRAA,
        paper: sraa_paper,
        half: half::sraa,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "sraa_place",
        summary: "Where sraa with shading=placed has each pixel shaded",
        sources: SRAA,
        paper: no_paper,
        half: half::unstudied,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "sraa_extra",
        summary: "Which pixels sraa with extra=true has shaded once more",
        sources: SRAA,
        paper: no_paper,
        half: half::unstudied,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "sraa_guide",
        summary: "Mean of the guide that sraa with guide=add adds to each pixel",
        sources: SRAA,
        paper: no_paper,
        half: half::unstudied,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "sraa_residual",
        summary: "Colours less the guide, as sraa with guide=add reads them",
        sources: SRAA,
        paper: no_paper,
        half: half::unstudied,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "sraa_fit_sums",
        summary: "Sums over tiles by which sraa_fit scales the guide",
        sources: SRAA,
        paper: no_paper,
        half: half::unstudied,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "sraa_fit_rows",
        summary: "Sums over rows of tiles, so that sraa_fit reads fewer",
        sources: SRAA,
        paper: no_paper,
        half: half::unstudied,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "sraa_fit",
        summary: "Scale at which the guide of sraa is nearest to the colours",
        sources: SRAA,
        paper: no_paper,
        half: half::unstudied,
        presets: SRAA_PRESETS,
    },
    Entry {
        name: "stalker",
        summary: "Blur where normals turn or depth bends (S.T.A.L.K.E.R., GPU Gems 2, chapter 9)",
        sources: &[
            source!("edge/mod.rs"),
            source!("edge/stalker.rs"),
            source!("normals.rs"),
        ],
        paper: no_paper,
        half: half::edge,
        presets: NO_PRESETS,
    },
    Entry {
        name: "tabula_rasa",
        summary: "Blur where normals or the gradient of depth change (Tabula Rasa, GPU Gems 3, chapter 19)",
        sources: &[
            source!("edge/mod.rs"),
            source!("edge/tabula_rasa.rs"),
            source!("normals.rs"),
        ],
        paper: no_paper,
        half: half::edge,
        presets: NO_PRESETS,
    },
    Entry {
        name: "quad_convolution",
        summary: "Convolution, (2k+1)² weights from (k+1)² reads by quads (Penner 2011)",
        sources: &[
            source!("quad/convolution.rs"),
            source!("quad/guards.rs"),
            source!("quad/surface.rs"),
        ],
        paper: convolution_paper,
        half: half::convolution,
        presets: NO_PRESETS,
    },
    Entry {
        name: "quad_upsampling",
        summary: "Cross-bilateral upsampling, 2x or 4x, shared over quads (Penner 2011)",
        sources: &[source!("quad/surface.rs"), source!("quad/upsampling.rs")],
        paper: upsampling_paper,
        half: half::upsampling,
        presets: NO_PRESETS,
    },
    Entry {
        name: "downsampling",
        summary: "The small image that quad_upsampling reads, half a pixel off",
        sources: &[source!("quad/surface.rs"), source!("quad/upsampling.rs")],
        paper: no_paper,
        half: half::unstudied,
        presets: NO_PRESETS,
    },
    Entry {
        name: "quad_bilateral",
        summary: "Bilateral blur, (2k+1)² pixels from (k+1)² reads by quads (Penner 2011)",
        sources: &[
            source!("quad/bilateral.rs"),
            source!("quad/guards.rs"),
            source!("quad/surface.rs"),
        ],
        paper: no_paper,
        half: half::bilateral,
        presets: NO_PRESETS,
    },
    Entry {
        name: "pcf",
        summary: "Filtered shadows of 4x4 or 8x8 texels, shared over quads (Penner 2011)",
        sources: &[
            source!("quad/pcf/mod.rs"),
            source!("quad/pcf/weights.rs"),
            source!("quad/coordinates.rs"),
            source!("quad/guards.rs"),
        ],
        paper: pcf_paper,
        half: half::shadow,
        presets: NO_PRESETS,
    },
    Entry {
        name: "pcss",
        summary: "Contact-hardening shadows, searches split over quads (after Penner 2011)",
        sources: &[
            source!("quad/pcss.rs"),
            source!("quad/coordinates.rs"),
            source!("quad/guards.rs"),
        ],
        paper: no_paper,
        half: half::shadow,
        presets: NO_PRESETS,
    },
    Entry {
        name: "quad_ssao",
        summary: "Ambient occlusion in screen space, taps split over quads (after Penner 2011)",
        sources: &[
            source!("quad/ssao.rs"),
            source!("quad/guards.rs"),
            source!("quad/surface.rs"),
        ],
        paper: no_paper,
        half: half::unstudied,
        presets: NO_PRESETS,
    },
];

/// Returns the built-in kernel called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}

/// Section 2.8: "a 3×3 blur with four samples, while Figure 2.4 illustrates this process for a 5×5 blur using nine".
fn convolution_paper(options: &OptionValues) -> Option<PaperCounts> {
    if options.choice("taps")? == "bilinear" {
        return None;
    }
    let texture_reads = match (options.choice("sharing")?, options.number("radius")? as u32) {
        ("quad", 1) => 4,
        ("quad", 2) => 9,
        ("alone", 1) => 9,
        ("alone", 2) => 25,
        _ => return None,
    };
    Some(PaperCounts {
        weight_evaluations: 0,
        texture_reads,
    })
}

/// Section 2.7: "a bilateral upsample with only one or two texture fetches ... instead of eight".
fn upsampling_paper(options: &OptionValues) -> Option<PaperCounts> {
    let texture_reads = match options.choice("reads")? {
        "packed" => 1,
        "apart" => 2,
        _ => 8,
    };
    Some(PaperCounts {
        weight_evaluations: 4,
        texture_reads,
    })
}

/// Section 2.9: N² comparisons without sharing; with sharing, one for 4×4 texels and four for 8×8.
fn pcf_paper(options: &OptionValues) -> Option<PaperCounts> {
    let on_axis = match options.choice("width")? {
        "four" => 1,
        "eight" => 2,
        _ => return None,
    };
    let texture_reads = match options.choice("method")? {
        "naive" => 16 * on_axis * on_axis,
        "bilinear" => 4 * on_axis * on_axis,
        "quad" => on_axis * on_axis,
        _ => return None,
    };
    Some(PaperCounts {
        weight_evaluations: 0,
        texture_reads,
    })
}

/// For kernels whose publications state no counts.
fn no_paper(_: &OptionValues) -> Option<PaperCounts> {
    None
}

/// Section 3.5: "we read the G-buffers 58x per pixel (194 for 16x). The filter is evaluated 25 (81) times."
fn sraa_paper(options: &OptionValues) -> Option<PaperCounts> {
    match options.choice("pattern")? {
        "ordered4" | "latin4" => Some(PaperCounts {
            weight_evaluations: 25,
            texture_reads: 58,
        }),
        "ordered16" | "latin16" | "standard16" => Some(PaperCounts {
            weight_evaluations: 81,
            texture_reads: 194,
        }),
        _ => None,
    }
}

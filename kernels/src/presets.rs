//! Presets: named sets of a built-in kernel's options.

/// A named set of options.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preset {
    /// Name, as in `--set preset=NAME`.
    pub name: &'static str,
    /// Description in one line: effect and requirements.
    pub summary: &'static str,
    /// Groups of options and their values, some of which presets share.
    groups: &'static [Options],
}

type Options = &'static [(&'static str, &'static str)];

impl Preset {
    /// Options and their values. All others have their defaults.
    pub fn options(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.groups.iter().copied().flatten().copied()
    }
}

/// Presets of a kernel without any.
pub(crate) const NO_PRESETS: &[Preset] = &[];

/// Comparison by planes, and a search for surfaces that no tap shows. A pixel of one surface and even shading takes little of its
/// neighbours.
const EDGES: Options = &[
    ("metric", "planes-normals"),
    ("difference", "relative"),
    ("depth-scale", "10"),
    ("search", "five"),
    ("search-threshold", "0.004"),
    ("mask", "branch"),
    ("variation", "within"),
    ("mask-step", "0.12"),
];

/// Shading where `sraa_place` says.
const PLACED: Options = &[("unseen", "0.003"), ("shading", "placed")];

/// Presets of the SRAA kernels.
pub(crate) const SRAA_PRESETS: &[Preset] = &[
    Preset {
        name: "paper",
        summary: "the paper's filter: all defaults",
        groups: &[],
    },
    Preset {
        name: "fast",
        summary: "depth alone, no normals; tests of colours and depths only where a pixel is not finite",
        groups: &[&[
            ("metric", "depth"),
            ("difference", "relative"),
            ("depth-scale", "3"),
            ("guards", "fallback"),
        ]],
    },
    Preset {
        name: "edges",
        summary: "planes, and a search for surfaces that no tap shows: depth and normals are all it needs",
        groups: &[
            EDGES,
            &[("mask-threshold", "0.001"), ("sharpness", "1.25"), ("tau", "400")],
        ],
    },
    Preset {
        name: "full",
        summary: "the same, shaded where `sraa_place` says: surfaces smaller than a pixel are shaded too",
        groups: &[EDGES, PLACED, &[("mask-threshold", "0.001"), ("sharpness", "1.1")]],
    },
    Preset {
        name: "guided",
        summary: "the same with a guide, an estimate of the colour at every geometry sample, scaled to fit the picture",
        groups: &[EDGES, PLACED, &[("guide", "add"), ("fitted", "true")]],
    },
];

//! Filters of the quad study.

/// A filter: its kernel, and the options of each variant; the first shares nothing.
pub struct Family {
    pub name: &'static str,
    pub kernel: &'static str,
    pub ways: &'static [(&'static str, &'static [(&'static str, &'static str)])],
    /// Inputs of the family.
    pub from: Source,
}

/// Inputs of a filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A full-screen frame.
    Frame,
    /// A frame, and an image at a quarter of its width and height.
    Quarter,
    /// Positions in a shadow map, interpolated over the scene's triangles.
    Triangles,
}

/// Every filter.
pub const FAMILIES: &[Family] = &[
    Family {
        name: "blur 3x3",
        kernel: "quad_convolution",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        from: Source::Frame,
    },
    Family {
        name: "blur 7x7",
        kernel: "quad_convolution",
        ways: &[
            (
                "naive",
                &[("radius", "3"), ("weights", "binomial"), ("sharing", "alone")],
            ),
            ("quad", &[("radius", "3"), ("weights", "binomial")]),
            (
                "quad, bilinear",
                &[("radius", "3"), ("weights", "binomial"), ("taps", "bilinear")],
            ),
        ],
        from: Source::Frame,
    },
    Family {
        name: "bilateral 5x5",
        kernel: "quad_bilateral",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        from: Source::Frame,
    },
    Family {
        name: "upsampling 2x",
        kernel: "quad_upsampling",
        ways: &[
            ("naive", &[("reads", "naive")]),
            ("quad, 2 reads", &[("reads", "apart")]),
            ("quad, 1 read", &[("reads", "packed")]),
        ],
        from: Source::Frame,
    },
    Family {
        name: "upsampling 4x",
        kernel: "quad_upsampling",
        ways: &[
            ("naive", &[("reads", "naive"), ("factor", "four-times")]),
            ("quad, 2 reads", &[("reads", "apart"), ("factor", "four-times")]),
            ("quad, 1 read", &[("reads", "packed"), ("factor", "four-times")]),
        ],
        from: Source::Quarter,
    },
    Family {
        name: "occlusion, 16 taps",
        kernel: "quad_ssao",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        from: Source::Frame,
    },
    Family {
        name: "PCF 4x4 box",
        kernel: "pcf",
        ways: &[
            ("naive", &[("method", "naive"), ("width", "four")]),
            ("bilinear", &[("method", "bilinear"), ("width", "four")]),
            ("quad", &[("width", "four")]),
            ("quad, gradient", &[("width", "four"), ("gradient", "prewitt")]),
        ],
        from: Source::Triangles,
    },
    Family {
        name: "PCF 8x8 quadratic",
        kernel: "pcf",
        ways: &[
            ("naive", &[("method", "naive"), ("weights", "quadratic")]),
            ("bilinear", &[("method", "bilinear"), ("weights", "quadratic")]),
            ("quad", &[("weights", "quadratic")]),
            ("quad, gradient", &[("weights", "quadratic"), ("gradient", "prewitt")]),
            (
                "quad, mirrored simply",
                &[("weights", "quadratic"), ("mirroring", "simple")],
            ),
            ("gather", &[("method", "gather"), ("weights", "quadratic")]),
        ],
        from: Source::Triangles,
    },
    Family {
        name: "PCF 16x16 quadratic",
        kernel: "pcf",
        ways: &[
            (
                "naive",
                &[("method", "naive"), ("weights", "quadratic"), ("width", "sixteen")],
            ),
            (
                "bilinear",
                &[("method", "bilinear"), ("weights", "quadratic"), ("width", "sixteen")],
            ),
            (
                "quad, gradient",
                &[("weights", "quadratic"), ("width", "sixteen"), ("gradient", "prewitt")],
            ),
        ],
        from: Source::Triangles,
    },
    Family {
        name: "PCSS",
        kernel: "pcss",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        from: Source::Triangles,
    },
];

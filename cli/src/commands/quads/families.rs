//! The filters that are measured.

/// A filter: its kernel, and the options of each way to compute it, the first of which shares nothing.
pub struct Family {
    pub name: &'static str,
    pub kernel: &'static str,
    pub ways: &'static [(&'static str, &'static [(&'static str, &'static str)])],
    /// Whether it is drawn with the scene's triangles.
    pub forward: bool,
}

/// Every filter.
pub const FAMILIES: &[Family] = &[
    Family {
        name: "blur 3x3",
        kernel: "quad_convolution",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        forward: false,
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
        ],
        forward: false,
    },
    Family {
        name: "bilateral 5x5",
        kernel: "quad_bilateral",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        forward: false,
    },
    Family {
        name: "upsampling 2x",
        kernel: "quad_upsampling",
        ways: &[
            ("naive", &[("reads", "naive")]),
            ("quad, 2 reads", &[("reads", "apart")]),
            ("quad, 1 read", &[("reads", "packed")]),
        ],
        forward: false,
    },
    Family {
        name: "occlusion, 16 taps",
        kernel: "quad_ssao",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        forward: false,
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
        forward: true,
    },
    Family {
        name: "PCF 8x8 quadratic",
        kernel: "pcf",
        ways: &[
            ("naive", &[("method", "naive"), ("weights", "quadratic")]),
            ("bilinear", &[("method", "bilinear"), ("weights", "quadratic")]),
            ("quad", &[("weights", "quadratic")]),
            ("quad, gradient", &[("weights", "quadratic"), ("gradient", "prewitt")]),
            ("gather", &[("method", "gather"), ("weights", "quadratic")]),
        ],
        forward: true,
    },
    Family {
        name: "PCSS",
        kernel: "pcss",
        ways: &[("naive", &[("sharing", "alone")]), ("quad", &[])],
        forward: true,
    },
];

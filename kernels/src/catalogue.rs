//! The built-in kernels, as source text for the generator.

/// One built-in kernel.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Name on the command line and in `build.rs`, and of the kernel's function.
    pub name: &'static str,
    /// One line on what it does.
    pub summary: &'static str,
    /// Every file that the kernel is made of.
    pub sources: &'static [SourceFile],
    /// What its publication counts, for the options that a function tells the values of.
    pub paper: fn(&OptionValue<'_>) -> Option<PaperCounts>,
}

/// Tells an option's value by its name.
pub type OptionValue<'a> = dyn Fn(&str) -> Option<String> + 'a;

/// A file of Rust text.
#[derive(Clone, Copy, Debug)]
pub struct SourceFile {
    /// Path from the root of the workspace; only ever shown.
    pub path: &'static str,
    /// Contents.
    pub text: &'static str,
}

/// A publication's own count of what its kernel does for each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PaperCounts {
    /// Times that the bilateral weight is computed.
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

/// Every built-in kernel.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "sraa",
        summary: "Subpixel Reconstruction Antialiasing: 1x shading, subpixel geometry (Chajdas et al. 2011)",
        sources: &[
            source!("sraa/mod.rs"),
            source!("sraa/options.rs"),
            source!("sraa/pattern.rs"),
            source!("sraa/gbuffer.rs"),
            source!("sraa/view.rs"),
            source!("sraa/metric.rs"),
        ],
        paper: sraa_paper,
    },
    Entry {
        name: "stalker",
        summary: "Blur where normals turn or depth bends, as S.T.A.L.K.E.R. did (GPU Gems 2, chapter 9)",
        sources: &[source!("edge/mod.rs"), source!("edge/stalker.rs")],
        paper: no_paper,
    },
    Entry {
        name: "tabula_rasa",
        summary: "Blur where the gradient of depth or the normals change, as Tabula Rasa did (GPU Gems 3, chapter 19)",
        sources: &[source!("edge/mod.rs"), source!("edge/tabula_rasa.rs")],
        paper: no_paper,
    },
];

/// The built-in kernel called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}

/// A publication that counts nothing.
fn no_paper(_: &OptionValue<'_>) -> Option<PaperCounts> {
    None
}

/// Section 3.5: "we read the G-buffers 58x per pixel (194 for 16x). The filter is evaluated 25 (81) times."
fn sraa_paper(option: &OptionValue<'_>) -> Option<PaperCounts> {
    match option("pattern")?.as_str() {
        "ordered4" | "latin4" => Some(PaperCounts {
            weight_evaluations: 25,
            texture_reads: 58,
        }),
        "ordered16" | "latin16" => Some(PaperCounts {
            weight_evaluations: 81,
            texture_reads: 194,
        }),
        _ => None,
    }
}

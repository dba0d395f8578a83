//! Kernels that are studied.

use straightline_codegen::Kernel;
use straightline_codegen::diagnostic::Errors;
use straightline_kernels::OptionText;
use straightline_kernels::filters::FILTERS;

/// Inputs that a kernel is run on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// The built-in scene `roof`, rendered with the geometry samples that the kernel's options name; judged by
    /// [`oracle`](straightline_oracle::oracle).
    Roof,
    /// [`test_inputs`](straightline_bench::execute::test_inputs); judged by the same graph in `f64`.
    TestCard,
}

/// A hand-optimised kernel, with its loops.
#[derive(Clone, Debug)]
pub struct ByHand {
    /// The kernel; it has the other kernel's inputs, under the same names.
    pub kernel: Kernel,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
}

/// A kernel to be studied.
#[derive(Clone, Debug)]
pub struct Subject {
    /// A name for people.
    pub name: String,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// The kernel.
    pub kernel: Kernel,
    /// The hand-optimised kernel, or the reason why there is none.
    pub by_hand: Result<ByHand, String>,
    /// Inputs of the runs.
    pub input: Input,
    /// Values of uniforms; other uniforms without a default are 1.
    pub uniforms: Vec<(String, Vec<f64>)>,
}

/// Reason why there is no hand-written version.
const NOTHING_TO_GAIN: &str = "it reads nothing twice and computes nothing anew in its loops";

/// Hand-optimised versions of some of the ten filters.
const BY_HAND: [(&str, &str); 6] = [
    ("gaussian", include_str!("../../kernels/gaussian.rs")),
    ("bilateral", include_str!("../../kernels/bilateral.rs")),
    ("sobel", include_str!("../../kernels/sobel.rs")),
    ("kuwahara", include_str!("../../kernels/kuwahara.rs")),
    ("fxaa", include_str!("../../kernels/fxaa.rs")),
    ("convolution", include_str!("../../kernels/convolution.rs")),
];

/// Kernels omitted from a quick study: they have no loops, or gain next to nothing.
const NOT_QUICK: [&str; 8] = [
    "stalker",
    "tabula rasa",
    "gaussian",
    "median",
    "catmull rom",
    "fxaa",
    "ssao",
    "joint bilateral upsampling",
];

/// Returns SRAA in three variants, the edge filters, and the ten of `kernels/filters`; for a quick study, half of them.
///
/// # Errors
///
/// If a built-in kernel is missing.
pub fn list_subjects(quick: bool) -> Result<Vec<Subject>, Errors> {
    let mut all = vec![
        sraa_subject("SRAA 4", &[])?,
        sraa_subject("SRAA 16", &[("pattern", "latin16")])?,
        sraa_subject("SRAA 4, depth", &[("metric", "depth")])?,
    ];
    for name in ["stalker", "tabula_rasa"] {
        all.push(Subject {
            name: name.replace('_', " "),
            options: Vec::new(),
            kernel: Kernel::builtin(name)?,
            by_hand: Err("its loops run over lists, and are written out in every form".to_owned()),
            input: Input::TestCard,
            uniforms: Vec::new(),
        });
    }
    for filter in FILTERS {
        let by_hand = BY_HAND.iter().find(|(name, _)| *name == filter.name);
        let by_hand = by_hand.map(|(name, text)| ByHand {
            kernel: Kernel::from_text(&format!("study/kernels/{name}.rs"), text, name),
            options: Vec::new(),
        });
        all.push(Subject {
            name: filter.name.replace('_', " "),
            options: Vec::new(),
            kernel: Kernel::from_text(filter.path, filter.text, filter.name),
            by_hand: by_hand.ok_or_else(|| NOTHING_TO_GAIN.to_owned()),
            input: Input::TestCard,
            uniforms: Vec::new(),
        });
    }
    if quick {
        all.retain(|subject| !NOT_QUICK.contains(&subject.name.as_str()));
    }
    Ok(all)
}

fn sraa_subject(name: &str, options: &[(&str, &str)]) -> Result<Subject, Errors> {
    let owned = |(k, v): &(&str, &str)| ((*k).to_owned(), (*v).to_owned());
    let options: Vec<OptionText> = options.iter().map(owned).collect();
    Ok(Subject {
        name: name.to_owned(),
        options: options.clone(),
        kernel: Kernel::builtin("sraa")?,
        by_hand: Ok(ByHand {
            kernel: Kernel::from_text("study/kernels/sraa.rs", include_str!("../../kernels/sraa.rs"), "sraa"),
            options,
        }),
        input: Input::Roof,
        uniforms: Vec::new(),
    })
}

impl Subject {
    /// Returns the subject for a user's kernel, with an optional hand-optimised version.
    pub fn from_kernel(kernel: Kernel, by_hand: Option<Kernel>) -> Subject {
        let by_hand = by_hand.map(|kernel| ByHand {
            kernel,
            options: Vec::new(),
        });
        Subject {
            name: kernel.name().to_owned(),
            options: Vec::new(),
            kernel,
            by_hand: by_hand.ok_or_else(|| "none was given with --by-hand".to_owned()),
            input: Input::TestCard,
            uniforms: Vec::new(),
        }
    }
}

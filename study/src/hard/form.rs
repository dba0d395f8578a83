//! Kernels for hard cases, and their options.

use super::HardError;
use super::case::Case;
use crate::builtin::load_builtin;
use straightline_codegen::Math;
use straightline_kernels::{HalfPrecision, OptionText, OptionValues};
use straightline_scene::render::PlacedBy;

/// Inputs of a kernel, and the definition that it is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// SRAA.
    Sraa,
    /// S.T.A.L.K.E.R.'s edge filter.
    Stalker,
    /// Tabula Rasa's edge filter.
    TabulaRasa,
    /// Cross-bilateral upsampling.
    Upsampling,
    /// The bilateral blur of quads.
    Bilateral,
    /// Convolution by quads.
    Convolution,
    /// Ambient occlusion by quads.
    Ssao,
    /// Filtered shadows.
    Pcf,
    /// Contact-hardening shadows.
    Pcss,
}

/// A kernel with options.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelForm {
    /// Name in records: `sraa`, `sraa paper`.
    pub name: String,
    /// The built-in kernel.
    pub kernel: String,
    /// Inputs and definition of the kernel.
    pub family: Family,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// Mathematics policy of the form.
    pub math: Math,
    /// `true` if the form promises a finite picture within bounds: all do except those that keep errors of the printed
    /// listing.
    pub promises: bool,
    /// `true` if the form runs cases that set options.
    pub takes_options: bool,
}

/// Options that reproduce the paper's listing, except for the order of its arguments: shading at the first of 2×2 samples,
/// no falloff, weights divided by their sum even if it is 0, colours used unchecked.
pub const PAPER: &[(&str, &str)] = &[
    ("pattern", "ordered4"),
    ("shading", "sample0"),
    ("falloff", "none"),
    ("normalisation", "paper"),
    ("non-finite", "spread"),
];

/// Shading alternately at samples and centres, and a search.
const PLACED: &[(&str, &str)] = &[
    ("shading", "placed"),
    ("difference", "relative"),
    ("depth-scale", "3"),
    ("search", "seven"),
];

/// Shading placed by planes with a smaller search; pixels whose samples show one plane keep their colour.
const KEPT_EVEN: &[(&str, &str)] = &[
    ("shading", "placed"),
    ("search", "five"),
    ("mask", "branch"),
    ("variation", "within"),
];

impl KernelForm {
    fn new(name: &str, family: Family, options: &[(&str, &str)]) -> KernelForm {
        KernelForm {
            name: name.to_owned(),
            kernel: family.kernel_name().to_owned(),
            family,
            options: to_option_texts(options),
            math: Math::Exact,
            promises: true,
            takes_options: false,
        }
    }

    fn without_promises(mut self) -> KernelForm {
        self.promises = false;
        self
    }

    fn with_fast_math(mut self) -> KernelForm {
        self.math = Math::Fast;
        self
    }

    fn taking_options(mut self) -> KernelForm {
        self.takes_options = true;
        self
    }

    /// Returns every studied form.
    pub fn all() -> Vec<KernelForm> {
        use Family::*;
        vec![
            KernelForm::new("sraa", Sraa, &[]).taking_options(),
            KernelForm::new("sraa fallback", Sraa, &[("guards", "fallback")]).taking_options(),
            KernelForm::new("sraa fast", Sraa, &[])
                .with_fast_math()
                .taking_options(),
            KernelForm::new("sraa 16", Sraa, &[("pattern", "latin16")]),
            KernelForm::new("sraa planes-normals", Sraa, &[("metric", "planes-normals")]).taking_options(),
            KernelForm::new("sraa normals", Sraa, &[("metric", "normals")]),
            KernelForm::new("sraa depth", Sraa, &[("metric", "depth")]),
            KernelForm::new(
                "sraa planes of taps",
                Sraa,
                &[("metric", "planes-normals"), ("plane", "tap")],
            ),
            KernelForm::new("sraa radius 2", Sraa, &[("radius", "2")]),
            KernelForm::new(
                "sraa gaussian",
                Sraa,
                &[("resolve", "gaussian"), ("resolve-radius", "1.25")],
            ),
            KernelForm::new(
                "sraa lanczos",
                Sraa,
                &[("resolve", "lanczos"), ("resolve-radius", "1.5")],
            ),
            KernelForm::new("sraa split", Sraa, &[("layout", "split")]),
            KernelForm::new("sraa relative", Sraa, &[("difference", "relative")]),
            KernelForm::new("sraa epsilon", Sraa, &[("normalisation", "epsilon")]).taking_options(),
            KernelForm::new("sraa searched", Sraa, &[("search", "five")]).taking_options(),
            KernelForm::new("sraa placed", Sraa, PLACED),
            KernelForm::new(
                "sraa kept even",
                Sraa,
                &[PlacedBy::Planes.options(), KEPT_EVEN].concat(),
            ),
            KernelForm::new("sraa mask", Sraa, &[("mask", "select")]),
            KernelForm::new("sraa unshifted", Sraa, &[("normalisation", "paper")]).without_promises(),
            KernelForm::new("sraa paper", Sraa, PAPER)
                .without_promises()
                .taking_options(),
            KernelForm::new("stalker", Stalker, &[]),
            KernelForm::new("stalker linear", Stalker, &[("depth", "linear")]),
            KernelForm::new("stalker paper", Stalker, &[("form", "paper"), ("non-finite", "spread")])
                .without_promises(),
            KernelForm::new("tabula-rasa", TabulaRasa, &[]),
            KernelForm::new(
                "tabula-rasa paper",
                TabulaRasa,
                &[("form", "paper"), ("non-finite", "spread")],
            )
            .without_promises(),
            KernelForm::new("upsampling", Upsampling, &[]),
            KernelForm::new(
                "upsampling normals",
                Upsampling,
                &[("reads", "apart"), ("normals", "true")],
            ),
            KernelForm::new("upsampling gaussian", Upsampling, &[("screen", "gaussian")]),
            KernelForm::new("bilateral", Bilateral, &[]),
            KernelForm::new("bilateral fast", Bilateral, &[]).with_fast_math(),
            KernelForm::new("convolution", Convolution, &[]),
            KernelForm::new(
                "convolution 7x7",
                Convolution,
                &[("radius", "3"), ("weights", "binomial")],
            ),
            KernelForm::new(
                "convolution bilinear",
                Convolution,
                &[("radius", "3"), ("taps", "bilinear")],
            ),
            KernelForm::new("ssao", Ssao, &[]),
            KernelForm::new("ssao alone", Ssao, &[("sharing", "alone")]),
            KernelForm::new("pcf", Pcf, &[]),
            KernelForm::new("pcf four", Pcf, &[("width", "four"), ("weights", "quadratic")]),
            KernelForm::new("pcf prewitt", Pcf, &[("gradient", "prewitt")]),
            KernelForm::new("pcf fitted", Pcf, &[("weights", "quadratic"), ("gradient", "fitted")]),
            KernelForm::new("pcf gather", Pcf, &[("method", "gather"), ("weights", "cubic")]),
            KernelForm::new("pcf bilinear", Pcf, &[("method", "bilinear"), ("weights", "gaussian")]),
            KernelForm::new(
                "pcf naive",
                Pcf,
                &[("method", "naive"), ("width", "four"), ("weights", "linear")],
            ),
            KernelForm::new("pcf lookup", Pcf, &[("weights", "lookup")]),
            KernelForm::new("pcss", Pcss, &[]),
            KernelForm::new("pcss alone", Pcss, &[("sharing", "alone")]),
        ]
    }

    /// Returns a built-in kernel with options, if its family is studied.
    pub fn from_kernel(kernel: &str, options: &[OptionText]) -> Option<KernelForm> {
        let family = Family::ALL.into_iter().find(|family| family.kernel_name() == kernel)?;
        let words: Vec<String> = options.iter().map(|(name, value)| format!("{name}={value}")).collect();
        Some(KernelForm {
            name: [&[kernel.to_owned()], &words[..]].concat().join(" "),
            options: options.to_vec(),
            takes_options: true,
            ..KernelForm::new(kernel, family, &[])
        })
    }

    /// Returns the form's options in a case; `None` if the case does not apply to it.
    pub fn in_case(&self, case: &Case) -> Option<Vec<OptionText>> {
        if case.coord.is_some() && !self.family.reads_shadows() {
            return None;
        }
        if case.options.is_empty() {
            return Some(self.options.clone());
        }
        let own = |name: &str| self.options.iter().any(|(known, _)| known == name);
        let fits = self.family == Family::Sraa && self.takes_options && !case.options.iter().any(|(name, _)| own(name));
        fits.then(|| [self.options.clone(), to_option_texts(case.options)].concat())
    }

    /// Returns the reason why 11 bits cannot hold the numbers of a kernel with `options`.
    pub fn loss_reason(&self, options: &OptionValues) -> &'static str {
        match straightline_kernels::find(&self.kernel).map(|entry| (entry.half)(options)) {
            Some(HalfPrecision::Lost(reason)) => reason,
            _ => "what it reads has 11 bits, and so has all that is computed of it",
        }
    }

    /// Returns the values of all of the kernel's options under `settings`.
    ///
    /// # Errors
    ///
    /// [`HardError::Kernel`] if the kernel does not accept them.
    pub fn option_values(&self, settings: &[OptionText]) -> Result<OptionValues, HardError> {
        let values = load_builtin(&self.kernel).and_then(|kernel| kernel.option_values(settings));
        values.map_err(|errors| HardError::Kernel {
            form: self.name.clone(),
            errors,
        })
    }
}

/// Returns the value of a choice, or `default` for a kernel without that option.
pub fn choice_or<'a>(options: &'a OptionValues, name: &str, default: &'a str) -> &'a str {
    options.choice(name).unwrap_or(default)
}

impl Family {
    const ALL: [Family; 9] = [
        Family::Sraa,
        Family::Stalker,
        Family::TabulaRasa,
        Family::Upsampling,
        Family::Bilateral,
        Family::Convolution,
        Family::Ssao,
        Family::Pcf,
        Family::Pcss,
    ];

    /// Returns whether the family filters a shadow map.
    pub fn reads_shadows(self) -> bool {
        matches!(self, Family::Pcf | Family::Pcss)
    }

    /// Returns whether the family outputs light from 0 to 1 instead of colours.
    pub fn gives_light(self) -> bool {
        self.reads_shadows() || self == Family::Ssao
    }

    /// Returns whether four pixels are computed together.
    pub fn is_of_quads(self) -> bool {
        !matches!(self, Family::Sraa | Family::Stalker | Family::TabulaRasa)
    }

    /// Returns the name of the built-in kernel.
    pub fn kernel_name(self) -> &'static str {
        match self {
            Family::Sraa => "sraa",
            Family::Stalker => "stalker",
            Family::TabulaRasa => "tabula_rasa",
            Family::Upsampling => "quad_upsampling",
            Family::Bilateral => "quad_bilateral",
            Family::Convolution => "quad_convolution",
            Family::Ssao => "quad_ssao",
            Family::Pcf => "pcf",
            Family::Pcss => "pcss",
        }
    }
}

/// Returns the width of a shadow filter, in texels.
pub fn shadow_filter_width(options: &OptionValues) -> i64 {
    match choice_or(options, "width", "eight") {
        "four" => 4,
        "eight" => 8,
        "twelve" => 12,
        _ => 16,
    }
}

fn to_option_texts(options: &[(&str, &str)]) -> Vec<OptionText> {
    options
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect()
}

//! Parameters of an SRAA filter, by the names that the kernel's options have.

use std::fmt::Display;
use straightline_kernels::{OptionValue, OptionValues};

/// An enumeration whose values have names.
macro_rules! choices {
    ($(#[$meta:meta])* $name:ident { $( $(#[$value_meta:meta])* $value:ident = $text:literal ),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $( $(#[$value_meta])* $value, )* }

        impl $name {
            /// Every value.
            pub const ALL: &'static [$name] = &[ $( $name::$value, )* ];

            /// The name on the command line and in manifests.
            pub fn name(self) -> &'static str {
                match self { $( $name::$value => $text, )* }
            }
        }
    };
}

choices! {
    /// Geometry samples of a pixel.
    Pattern {
        /// A regular 2×2 grid, row by row.
        Ordered4 = "ordered4",
        /// Direct3D's standard pattern of 4.
        Latin4 = "latin4",
        /// Direct3D's standard pattern of 8.
        Standard8 = "standard8",
        /// A regular 4×4 grid, row by row.
        Ordered16 = "ordered16",
        /// Direct3D's standard pattern of 16, its mean moved to the pixel's centre.
        Latin16 = "latin16",
        /// Direct3D's standard pattern of 16.
        Standard16 = "standard16",
        /// As listed.
        Listed = "listed",
    }
}

choices! {
    /// Shading samples of a pixel.
    Shading {
        /// At the first geometry sample.
        Sample0 = "sample0",
        /// At the pixel's centre, whose geometry is sampled too.
        Centre = "centre",
        /// At the geometry samples listed.
        Listed = "listed",
        /// At the geometry sample or the pixel's centre that an image names.
        Placed = "placed",
    }
}

choices! {
    /// Metric by which two surfaces differ.
    Metric {
        /// The larger of the distance from the sample's plane and the difference in normal.
        PlanesNormals = "planes-normals",
        /// The larger of the differences in depth and in normal.
        DepthNormals = "depth-normals",
        /// The difference in normal.
        Normals = "normals",
        /// The difference in depth.
        Depth = "depth",
    }
}

choices! {
    /// Measure of a difference in depth.
    Difference {
        /// Itself.
        Absolute = "absolute",
        /// Share of the sample's depth.
        Relative = "relative",
    }
}

choices! {
    /// From whose plane a distance is measured.
    Plane {
        /// That of the geometry sample.
        Sample = "sample",
        /// That of the tap.
        Tap = "tap",
    }
}

choices! {
    /// Projection of the camera.
    Projection {
        /// From an eye.
        Perspective = "perspective",
        /// Along one direction.
        Parallel = "parallel",
    }
}

choices! {
    /// Encoding of depth.
    Depth {
        /// Along the view direction, in scene units.
        Linear = "linear",
        /// 0 at the near plane, 1 at the far plane.
        Perspective = "perspective",
        /// 1 at the near plane, 0 at the far plane.
        Reversed = "reversed",
        /// 1 at the near plane, 0 infinitely far.
        ReversedInfinite = "reversed-infinite",
    }
}

choices! {
    /// Encoding of normals.
    Normals {
        /// Three numbers.
        Float = "float",
        /// Three numbers, as 0.5 + 0.5 n.
        Unorm = "unorm",
        /// Unfolded, as 0.5 + 0.5 n.
        Octahedral = "octahedral",
        /// Unfolded, with the depth in the third and fourth component.
        Packed = "packed",
    }
}

choices! {
    /// Layout of a pixel's samples.
    Layout {
        /// A layer each.
        Layers = "layers",
        /// Side by side.
        Superresolution = "superresolution",
        /// As samples of a texel.
        Multisampled = "multisampled",
        /// A layer each, depth in a buffer.
        Split = "split",
    }
}

choices! {
    /// Falloff of a tap's weight with its distance on the screen.
    Falloff {
        /// Not at all up to the radius on each axis.
        None = "none",
        /// Linearly to zero at the radius on each axis.
        Tent = "tent",
        /// As a Gaussian, up to the radius on each axis.
        Gaussian = "gaussian",
    }
}

choices! {
    /// Distance of two normals.
    Turn {
        /// a·a - a·b, of unit vectors 1 - a·b.
        Cosine = "cosine",
        /// ½|a - b|².
        Chord = "chord",
    }
}

choices! {
    /// Normalisation of a sample's weights to a sum of one. All give the same number in exact arithmetic where there is any
    /// weight.
    Normalisation {
        /// w / Σw: 0/0, and so NaN, where every weight is below the smallest number.
        Paper = "paper",
        /// w / max(Σw, 1e-30).
        Epsilon = "epsilon",
        /// w / Σw with the smallest difference subtracted first: Σw is never 0.
        Shifted = "shifted",
    }
}

choices! {
    /// Filter that makes the pixel of the reconstructed samples.
    Resolve {
        /// The mean of the pixel's own.
        Box = "box",
        /// A tent over those less than `resolve-radius` away on each axis.
        Tent = "tent",
        /// A Gaussian over the same, of half of that.
        Gaussian = "gaussian",
        /// Mitchell and Netravali's cubic over the same.
        Mitchell = "mitchell",
        /// A windowed sinc of two lobes over the same.
        Lanczos = "lanczos",
    }
}

choices! {
    /// Samples among which a mask looks for variation.
    Variation {
        /// Among a pixel's samples and all shading samples within their reach.
        Around = "around",
        /// Among a pixel's geometry samples and its own shading samples.
        Within = "within",
    }
}

choices! {
    /// Mask by which pixels without geometric variation keep their colour.
    Mask {
        /// No.
        None = "none",
        /// Yes.
        Select = "select",
        /// Yes.
        Branch = "branch",
    }
}

choices! {
    /// Area in which the surface of a sample is searched for if no tap shows it.
    Search {
        /// Not at all.
        None = "none",
        /// In 5×5 pixels.
        Five = "five",
        /// In 7×7 pixels.
        Seven = "seven",
    }
}

choices! {
    /// Quantities that are known at every geometry sample and not borrowed.
    Demodulate {
        /// Nothing.
        None = "none",
        /// Albedo.
        Albedo = "albedo",
        /// Albedo, and the shadow of the direct light.
        AlbedoShadow = "albedo-shadow",
    }
}

choices! {
    /// Source of the guide at a sample.
    Estimate {
        /// Images.
        Given = "given",
        /// Albedo times light.
        Diffuse = "diffuse",
        /// Albedo times light, plus emitted light.
        Emissive = "emissive",
    }
}

choices! {
    /// Treatment of a colour that is not finite.
    NonFinite {
        /// The colour counts.
        Spread = "spread",
        /// The colour is left out.
        Skip = "skip",
    }
}

/// Parameters of an SRAA filter. The default is the kernel's.
#[derive(Clone, Debug, PartialEq)]
pub struct SraaParams {
    /// Geometry samples of a pixel.
    pub pattern: Pattern,
    /// x and y of each sample of [`Pattern::Listed`].
    pub offsets: Vec<f64>,
    /// Shading samples of a pixel.
    pub shading: Shading,
    /// Samples that [`Shading::Listed`] names.
    pub shaded: Vec<f64>,
    /// Metric by which two surfaces differ.
    pub metric: Metric,
    /// Measure of a difference in depth.
    pub difference: Difference,
    /// Projection of the camera.
    pub projection: Projection,
    /// Encoding of depth.
    pub depth: Depth,
    /// Encoding of normals.
    pub normals: Normals,
    /// Layout of a pixel's samples.
    pub layout: Layout,
    /// Falloff of a tap's weight with its distance on the screen.
    pub falloff: Falloff,
    /// Standard deviation of [`Falloff::Gaussian`], in pixels.
    pub sigma: f64,
    /// The power of a tent.
    pub sharpness: f64,
    /// Greatest distance of a tap from its sample on each axis, in pixels, from 1 to 2.
    pub radius: f64,
    /// Of the planes: from whose a distance is measured.
    pub plane: Plane,
    /// Normalisation of a sample's weights to a sum of one.
    pub normalisation: Normalisation,
    /// Filter that makes the pixel of the reconstructed samples.
    pub resolve: Resolve,
    /// Radius of that filter on each axis, from the centre, in pixels, except for a box.
    pub resolve_radius: f64,
    /// True if some pixels have a further shading sample.
    pub extra: bool,
    /// Area in which the surface of a sample is searched for if no tap shows it.
    pub search: Search,
    /// The largest difference of what shows a sample's surface, for a search.
    pub search_threshold: f64,
    /// The largest difference of what shows a sample's surface, for placing the shading of a pixel.
    pub unseen: f64,
    /// Quantities that are known at every geometry sample and not borrowed.
    pub demodulate: Demodulate,
    /// The least albedo, a channel.
    pub albedo_floor: f64,
    /// The least albedo, a channel, of taps on other surfaces than the sample's own.
    pub unseen_floor: f64,
    /// True if the part of the colour that does not follow the albedo is known.
    pub rest: bool,
    /// True if colours are differences from a guide, whose mean is added afterwards.
    pub guide: bool,
    /// Source of the guide at a sample.
    pub estimate: Estimate,
    /// True if the guide is multiplied by a scale.
    pub fitted: bool,
    /// Number of earlier frames that give shading samples too.
    pub history: usize,
    /// Mask by which pixels without geometric variation keep their colour.
    pub mask: Mask,
    /// Samples among which there must be no variation.
    pub variation: Variation,
    /// The largest difference that is no variation.
    pub mask_threshold: f64,
    /// The largest step of a colour from a neighbour on the pixel's surface that is no variation, as a display shows it.
    pub mask_step: f64,
    /// Treatment of a colour that is not finite.
    pub non_finite: NonFinite,
    /// Distance of two normals.
    pub turn: Turn,
    /// True if normals of [`Normals::Unorm`] are made as long as 1.
    pub renormalise: bool,
    /// True if a depth or a normal that is not a number may go unnoticed, so that the other of the two decides, and a depth
    /// below -1e30 may stay what it is, which is else taken for the sky.
    pub escapes: bool,
    /// Steepness with which a weight falls as surfaces differ; 0 or more.
    pub tau: f64,
    /// Difference per unit of depth; 0 or more.
    pub depth_scale: f64,
}

impl Default for SraaParams {
    fn default() -> Self {
        SraaParams {
            pattern: Pattern::Latin4,
            offsets: Vec::new(),
            shading: Shading::Centre,
            shaded: Vec::new(),
            metric: Metric::DepthNormals,
            difference: Difference::Absolute,
            projection: Projection::Perspective,
            depth: Depth::Linear,
            normals: Normals::Float,
            layout: Layout::Layers,
            falloff: Falloff::Tent,
            sharpness: 1.0,
            sigma: 0.4,
            radius: 1.0,
            plane: Plane::Sample,
            normalisation: Normalisation::Shifted,
            resolve: Resolve::Box,
            resolve_radius: 1.0,
            extra: false,
            search: Search::None,
            search_threshold: 0.05,
            unseen: 0.01,
            demodulate: Demodulate::None,
            albedo_floor: 0.04,
            unseen_floor: 0.25,
            rest: false,
            guide: false,
            estimate: Estimate::Given,
            fitted: false,
            history: 0,
            mask: Mask::None,
            variation: Variation::Around,
            mask_threshold: 0.002,
            mask_step: 1.0,
            non_finite: NonFinite::Skip,
            turn: Turn::Cosine,
            renormalise: false,
            escapes: false,
            tau: 500.0,
            depth_scale: 1.0,
        }
    }
}

/// Why an option could not be set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OracleError {
    /// There is no such option.
    #[error("the oracle of SRAA knows no option `{option}`")]
    UnknownOption {
        /// The option asked for.
        option: String,
    },
    /// An image or a number is missing or does not fit.
    #[error("the oracle of SRAA needs `{name}`: {needed}")]
    Input {
        /// Name of the image or number.
        name: String,
        /// Description of the image or number needed.
        needed: String,
    },
    /// The option has no such value.
    #[error("{option}={value}: expected {expected}")]
    BadValue {
        /// The option.
        option: String,
        /// The value that it was set to.
        value: String,
        /// Description of its possible values.
        expected: String,
    },
}

impl SraaParams {
    /// The filter of a compiled kernel's options.
    ///
    /// # Errors
    ///
    /// [`OracleError`] for an option or a value that there is not.
    pub fn from_options(options: &OptionValues) -> Result<Self, OracleError> {
        let mut params = SraaParams::default();
        for (option, value) in options {
            params.set(option, value)?;
        }
        Ok(params)
    }

    /// Sets an option by name.
    ///
    /// # Errors
    ///
    /// [`OracleError`] for an option or a value that there is not.
    pub fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), OracleError> {
        match option {
            "pattern" => self.pattern = parse_choice(option, value, Pattern::ALL, Pattern::name)?,
            "offsets" => self.offsets = parse_numbers(option, value)?,
            // A pattern's being a Latin square does not change the result.
            "latin" => {}
            "shading" => self.shading = parse_choice(option, value, Shading::ALL, Shading::name)?,
            "shaded" => self.shaded = parse_numbers(option, value)?,
            "metric" => self.metric = parse_choice(option, value, Metric::ALL, Metric::name)?,
            "difference" => self.difference = parse_choice(option, value, Difference::ALL, Difference::name)?,
            "projection" => self.projection = parse_choice(option, value, Projection::ALL, Projection::name)?,
            "depth" => self.depth = parse_choice(option, value, Depth::ALL, Depth::name)?,
            "normals" => self.normals = parse_choice(option, value, Normals::ALL, Normals::name)?,
            "layout" => self.layout = parse_choice(option, value, Layout::ALL, Layout::name)?,
            "falloff" => self.falloff = parse_choice(option, value, Falloff::ALL, Falloff::name)?,
            "sharpness" => self.sharpness = parse_number(option, value)?,
            "sigma" => self.sigma = parse_number(option, value)?,
            "radius" => self.radius = parse_number(option, value)?,
            "resolve-radius" => self.resolve_radius = parse_number(option, value)?,
            "plane" => self.plane = parse_choice(option, value, Plane::ALL, Plane::name)?,
            "normalisation" => {
                self.normalisation = parse_choice(option, value, Normalisation::ALL, Normalisation::name)?
            }
            "resolve" => self.resolve = parse_choice(option, value, Resolve::ALL, Resolve::name)?,
            "extra" => self.extra = parse_flag(option, value)?,
            "search" => self.search = parse_choice(option, value, Search::ALL, Search::name)?,
            "search-threshold" => self.search_threshold = parse_number(option, value)?,
            "unseen" => self.unseen = parse_number(option, value)?,
            "demodulate" => self.demodulate = parse_choice(option, value, Demodulate::ALL, Demodulate::name)?,
            "albedo-floor" => self.albedo_floor = parse_number(option, value)?,
            "unseen-floor" => self.unseen_floor = parse_number(option, value)?,
            "rest" => self.rest = parse_flag(option, value)?,
            "guide" => self.guide = value.choice() == Some("add"),
            "estimate" => self.estimate = parse_choice(option, value, Estimate::ALL, Estimate::name)?,
            "fitted" => self.fitted = parse_flag(option, value)?,
            "history" => self.history = parse_number(option, value)? as usize,
            "mask" => self.mask = parse_choice(option, value, Mask::ALL, Mask::name)?,
            "variation" => self.variation = parse_choice(option, value, Variation::ALL, Variation::name)?,
            "mask-threshold" => self.mask_threshold = parse_number(option, value)?,
            "mask-step" => self.mask_step = parse_number(option, value)?,
            "non-finite" => self.non_finite = parse_choice(option, value, NonFinite::ALL, NonFinite::name)?,
            "turn" => self.turn = parse_choice(option, value, Turn::ALL, Turn::name)?,
            "renormalise" => self.renormalise = parse_flag(option, value)?,
            // The kind of guard does not change the result, except that some numbers that are not finite may escape.
            "guards" => self.escapes = value.choice() != Some("inline"),
            "tau" => self.tau = parse_number(option, value)?,
            "depth-scale" => self.depth_scale = parse_number(option, value)?,
            _ => {
                return Err(OracleError::UnknownOption {
                    option: option.to_owned(),
                });
            }
        }
        Ok(())
    }

    /// τ; from 10⁷ / log₂ e on the filter makes no difference, so that an infinite one is a number.
    pub fn steepness(&self) -> f64 {
        self.tau.min(1.0e7 / std::f64::consts::LOG2_E)
    }

    /// Reach of the searched square from its pixel on each side, in pixels.
    pub(super) fn search_radius(&self) -> i32 {
        match self.search {
            Search::None => 0,
            Search::Five => 2,
            Search::Seven => 3,
        }
    }

    /// Returns whether normals that are stored as 0.5 + 0.5 n are compared as they are.
    pub(super) fn as_stored(&self) -> bool {
        self.normals == Normals::Unorm && !self.renormalise
    }

    /// Returns whether normals are compared by a·a - a·b.
    pub(super) fn by_cosine(&self) -> bool {
        self.turn == Turn::Cosine && self.metric != Metric::Normals && !self.as_stored()
    }

    /// Returns whether samples may have negative weights.
    pub(super) fn has_lobes(&self) -> bool {
        matches!(self.resolve, Resolve::Mitchell | Resolve::Lanczos)
    }

    /// Offsets of the geometry samples from the pixel's centre, in pixels, y down.
    pub fn sample_offsets(&self) -> Vec<[f64; 2]> {
        super::pattern::pattern_offsets(self.pattern, &self.offsets)
    }

    /// The geometry sample of each shading sample; the one after the last is the pixel's centre. Of shading that is placed the
    /// centre, from which a tap's distance on the screen counts.
    pub fn shaded_samples(&self) -> Vec<usize> {
        match self.shading {
            Shading::Sample0 => vec![0],
            Shading::Centre | Shading::Placed => vec![self.sample_offsets().len()],
            Shading::Listed => self.shaded.iter().map(|k| *k as usize).collect(),
        }
    }
}

fn parse_choice<T: Copy>(
    option: &str,
    value: &OptionValue,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Result<T, OracleError> {
    all.iter()
        .copied()
        .find(|candidate| value.choice() == Some(name(*candidate)))
        .ok_or_else(|| {
            let names: Vec<_> = all.iter().map(|candidate| name(*candidate)).collect();
            bad_value(option, value, names.join(", "))
        })
}

fn parse_flag(option: &str, value: &OptionValue) -> Result<bool, OracleError> {
    value.flag().ok_or_else(|| bad_value(option, value, "true or false"))
}

fn parse_number(option: &str, value: &OptionValue) -> Result<f64, OracleError> {
    let number = value.number().filter(|number| number.is_finite() && *number >= 0.0);
    number.ok_or_else(|| bad_value(option, value, "a number of at least 0"))
}

fn parse_numbers(option: &str, value: &OptionValue) -> Result<Vec<f64>, OracleError> {
    let numbers = value.numbers().map(<[f64]>::to_vec);
    numbers.ok_or_else(|| bad_value(option, value, "numbers"))
}

fn bad_value(option: &str, value: &OptionValue, expected: impl Display) -> OracleError {
    OracleError::BadValue {
        option: option.to_owned(),
        value: value.to_string(),
        expected: expected.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice_value(choice: &str) -> OptionValue {
        OptionValue::Choice(choice.to_owned())
    }

    #[test]
    fn options_are_set_by_name() {
        let mut params = SraaParams::default();
        for (option, value) in [
            ("pattern", choice_value("listed")),
            ("offsets", OptionValue::Numbers(vec![0.25, -0.25])),
            ("shading", choice_value("sample0")),
            ("metric", choice_value("depth")),
            ("falloff", choice_value("none")),
            ("normalisation", choice_value("paper")),
            ("tau", OptionValue::Number(12.5)),
            ("depth-scale", OptionValue::Number(0.0)),
        ] {
            params.set(option, &value).unwrap();
        }
        let expected = SraaParams {
            pattern: Pattern::Listed,
            offsets: vec![0.25, -0.25],
            shading: Shading::Sample0,
            metric: Metric::Depth,
            falloff: Falloff::None,
            normalisation: Normalisation::Paper,
            tau: 12.5,
            depth_scale: 0.0,
            ..SraaParams::default()
        };
        assert_eq!(params, expected);
    }

    #[test]
    fn bad_options_are_refused_with_what_would_do() {
        let mut params = SraaParams::default();
        assert!(
            params
                .set("patern", &choice_value("latin4"))
                .unwrap_err()
                .to_string()
                .contains("patern")
        );
        let error = params.set("falloff", &choice_value("gauss")).unwrap_err();
        assert_eq!(error.to_string(), "falloff=gauss: expected none, tent, gaussian");
        let numbers = [-1.0, f64::NAN, f64::INFINITY].map(OptionValue::Number);
        for bad in numbers.into_iter().chain([choice_value("many"), OptionValue::Uniform]) {
            assert!(params.set("tau", &bad).is_err(), "{bad}");
        }
        assert!(params.set("extra", &choice_value("yes")).is_err());
        assert_eq!(params, SraaParams::default());
    }
}

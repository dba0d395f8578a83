//! Shaders that the build script generated, by what they are needed for.

use crate::{Error, Options, Preset, Projection, Samples};
use straightline_runtime::Shader;

// Documented in the generator, for readers of a renderer of their own.
#[allow(missing_docs)]
mod generated {
    straightline_runtime::include_shaders!();
}

pub(crate) use generated::{sraa_fit, sraa_fit_rows};

type Generated = &'static Shader<'static>;

/// Shaders of one number of samples, one kind of camera and one preset.
pub(crate) struct Shaders {
    pub filter: Generated,
    pub place: Option<Generated>,
    pub guide: Option<GuideShaders>,
}

/// Shaders for the guide that read the geometry.
pub(crate) struct GuideShaders {
    pub sums: Generated,
    pub mean: Generated,
    pub residual: Generated,
}

/// The filter for a preset and an encoding of depth, and the kernel that places the shading.
macro_rules! filters {
    ($sraa:ident, $place:ident, $preset:expr, $projection:expr) => {{
        use generated::$sraa::{Depth, Preset as Named, Variant};
        let preset = match $preset {
            Preset::Paper => Named::Paper,
            Preset::Fast => Named::Fast,
            Preset::Edges => Named::Edges,
            Preset::Full => Named::Full,
            Preset::Guided => Named::Guided,
        };
        let (depth, placed) = match $projection.is_reversed() {
            true => (Depth::Reversed, generated::$place::Depth::Reversed),
            false => (Depth::Perspective, generated::$place::Depth::Perspective),
        };
        let place = $preset
            .has_place()
            .then(|| generated::$place::Variant { depth: placed }.shader());
        (Variant { preset, depth }.shader(), place)
    }};
}

/// Shaders for the guide of a number of samples.
macro_rules! guides {
    ($sums:ident, $mean:ident, $residual:ident) => {
        GuideShaders {
            sums: &generated::$sums::SHADER,
            mean: &generated::$mean::SHADER,
            residual: &generated::$residual::SHADER,
        }
    };
}

impl Shaders {
    /// Finds the shaders.
    ///
    /// # Errors
    ///
    /// [`Error::Feature`] if they were not generated.
    pub fn find(options: Options, projection: &Projection) -> Result<Shaders, Error> {
        let preset = options.preset;
        let four = guides!(fit_sums_four, guide_four, residual_four);
        #[cfg(feature = "sixteen")]
        let sixteen = guides!(fit_sums_sixteen, guide_sixteen, residual_sixteen);
        let ((filter, place), guide) = match (options.samples, projection.is_parallel()) {
            (Samples::Four, false) => (filters!(sraa_four, place_four, preset, projection), four),
            #[cfg(feature = "parallel")]
            (Samples::Four, true) => (
                filters!(sraa_four_parallel, place_four_parallel, preset, projection),
                four,
            ),
            #[cfg(feature = "sixteen")]
            (Samples::Sixteen, false) => (filters!(sraa_sixteen, place_sixteen, preset, projection), sixteen),
            #[cfg(all(feature = "sixteen", feature = "parallel"))]
            (Samples::Sixteen, true) => (
                filters!(sraa_sixteen_parallel, place_sixteen_parallel, preset, projection),
                sixteen,
            ),
            #[cfg(not(feature = "sixteen"))]
            (Samples::Sixteen, _) => {
                return Err(Error::Feature {
                    what: "`Samples::Sixteen`",
                    feature: "sixteen",
                });
            }
            #[cfg(not(feature = "parallel"))]
            (_, true) => {
                return Err(Error::Feature {
                    what: "a camera without perspective",
                    feature: "parallel",
                });
            }
        };
        Ok(Shaders {
            filter,
            place,
            guide: preset.has_guide().then_some(guide),
        })
    }
}

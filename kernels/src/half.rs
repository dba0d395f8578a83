//! Effect of half precision on the picture of a built-in kernel, by its options: the results of hard cases (`straightline
//! study hard --precision f16`) as rules, which a test compares with the cases (`tests/tests/filters/hard.rs`).

use crate::OptionValues;

/// Effect of half precision on a kernel's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HalfPrecision {
    /// No visible change in any case that occurs in scenes.
    Kept,
    /// A visible change in some case, because 11 bits cannot hold this.
    Lost(&'static str),
    /// No case covers these options.
    Unstudied,
}

/// Verdict for kernels that no case covers.
pub(crate) fn unstudied(_: &OptionValues) -> HalfPrecision {
    HalfPrecision::Unstudied
}

pub(crate) fn sraa(options: &OptionValues) -> HalfPrecision {
    HalfPrecision::Lost(match options.choice("metric") {
        Some("normals") if options.choice("resolve") == Some("lanczos") => {
            "lobes below zero make small rounding errors of the samples' weights larger than can be seen"
        }
        Some("normals") if options.choice("normalisation").is_none_or(|how| how == "shifted") => {
            // The cases cover weights, but not light that is divided by an albedo,
            // nor earlier frames.
            let is_off = |option: &str| options.choice(option).is_none_or(|how| how == "none");
            let is_plain = is_off("demodulate") && is_off("guide");
            let is_alone = options.get("history").is_none_or(|frames| frames.number() == Some(0.0));
            return match is_plain && is_alone {
                true => HalfPrecision::Kept,
                false => HalfPrecision::Unstudied,
            };
        }
        Some("normals") => {
            "weights of less than 2^-24 are none: where all are so small, as on a thin wire, no colour is left"
        }
        Some("planes-normals") => {
            "depths are off by 2^-11 of themselves, and depth-scale times tau of that goes into an exponent: a slope of one \
             plane becomes steps between surfaces"
        }
        _ => {
            "depths are off by 2^-11 of themselves, and depth-scale times tau of that goes into an exponent: a slope becomes \
             steps between surfaces"
        }
    })
}

pub(crate) fn edge(_: &OptionValues) -> HalfPrecision {
    HalfPrecision::Lost(
        "places between texels are held in 11 bits, half a pixel off from the 1024th on, and what bends in depth is of the size \
         that 11 bits round away: flat surfaces become edges",
    )
}

pub(crate) fn upsampling(_: &OptionValues) -> HalfPrecision {
    HalfPrecision::Lost(
        "weights of less than 2^-24 are none, so that the nearest depth takes the place of a mean of far ones, and depths are \
         off by 2^-11 of themselves",
    )
}

pub(crate) fn bilateral(options: &OptionValues) -> HalfPrecision {
    match options.choice("guards") {
        Some("none") => HalfPrecision::Lost("without its tests an infinite depth less another is no number"),
        _ => HalfPrecision::Kept,
    }
}

pub(crate) fn convolution(options: &OptionValues) -> HalfPrecision {
    match options.choice("taps") {
        // Positions between texels have 11 bits. The cases' pictures are too small to show the error.
        Some("bilinear") => HalfPrecision::Unstudied,
        _ => HalfPrecision::Kept,
    }
}

pub(crate) fn shadow(_: &OptionValues) -> HalfPrecision {
    HalfPrecision::Lost(
        "places in the shadow map and depths to compare are held in 11 bits: other texels are compared, and with another result",
    )
}

//! What half precision does to the picture of a built-in kernel: what hard cases showed (`straightline study hard --precision
//! f16`), said of options by rules that a test compares with the cases (`tests/tests/filters/hard.rs`).

use crate::OptionValues;

/// What computing in half precision does to a kernel's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HalfPrecision {
    /// It changes no case that scenes have by more than can be seen.
    Kept,
    /// It changes a case visibly, as 11 bits cannot hold this.
    Lost(&'static str),
    /// No case tells.
    Unstudied,
}

/// No case tells.
pub(crate) fn unstudied(_: &OptionValues) -> HalfPrecision {
    HalfPrecision::Unstudied
}

pub(crate) fn sraa(options: &OptionValues) -> HalfPrecision {
    HalfPrecision::Lost(match options.choice("metric") {
        Some("normals") if options.choice("resolve") == Some("lanczos") => {
            "lobes below zero make small rounding errors of the samples' weights larger than can be seen"
        }
        Some("normals") if options.choice("normalisation").is_none_or(|how| how == "shifted") => {
            // What is kept of weights says nothing of light that is divided by an albedo.
            // Nor of a frame's place among others.
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
        // Places between texels have 11 bits, and the cases' pictures are too small to show it.
        Some("bilinear") => HalfPrecision::Unstudied,
        _ => HalfPrecision::Kept,
    }
}

pub(crate) fn shadow(_: &OptionValues) -> HalfPrecision {
    HalfPrecision::Lost(
        "places in the shadow map and depths to compare are held in 11 bits: other texels are compared, and with another result",
    )
}

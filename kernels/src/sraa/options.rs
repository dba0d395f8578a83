//! Options of an SRAA filter: choices that the paper names, and choices that it leaves open.

use crate::prelude::*;

use super::demodulate::Demodulate;
use super::gbuffer::{Depth, Layout, Normals};
use super::guide::{Estimate, Guide};
use super::metric::{Difference, Metric, Plane};
use super::pattern::{Pattern, Shading};
use super::view::Projection;

options! {
    /// Options of an SRAA filter.
    pub struct Sraa {
        /// Positions of the geometry samples in a pixel.
        pub pattern: Pattern = Pattern::Latin4,
        /// With pattern=listed: x and y of each geometry sample, in pixels from the pixel's centre, y down.
        pub offsets: &'static [f32] [-0.5..=0.5] = &[],
        /// With pattern=listed: requires a Latin square, with a row and a column for each sample.
        pub latin: bool = false,
        /// Positions of the shading samples in a pixel.
        pub shading: Shading = Shading::Centre,
        /// With shading=listed: indices of the geometry samples that are shaded, from 0: one, two or four.
        pub shaded: &'static [i32] [0..=63] = &[],
        /// Measure of the difference between two surfaces.
        pub metric: Metric = Metric::DepthNormals,
        /// Unit of differences in depth: scene units or shares of the depth.
        pub difference: Difference = Difference::Absolute,
        /// With metric=planes-normals: plane from which distances are measured.
        pub plane: Plane = Plane::Sample,
        /// Projection of the camera.
        pub projection: Projection = Projection::Perspective,
        /// Encoding of depth in the G-buffer.
        pub depth: Depth = Depth::Linear,
        /// Encoding of normals in the G-buffer.
        pub normals: Normals = Normals::Float,
        /// Storage of a pixel's samples in the G-buffer.
        pub layout: Layout = Layout::Layers,
        /// Decrease of a tap's weight with its distance on the screen.
        pub falloff: Falloff = Falloff::Tent,
        /// With falloff=tent: exponent of the tent. With 3 for 4 samples, and 4 for 16, the blur within a surface is that of
        /// the pixel's own area; smaller exponents blur more, and smooth sharp shading within a surface.
        pub sharpness: f32 [1.0..=4.0] = 1.0,
        /// With falloff=gaussian: standard deviation, in pixels. If smaller, the farthest taps' weights would underflow.
        pub sigma: f32 [0.125..=4.0] = 0.4,
        /// Largest distance of a tap from its sample on each axis, in pixels; the falloff ends there. With a larger radius,
        /// fewer samples have no tap on their surface, but more is read, and colours come from farther away.
        pub radius: f32 [1.0..=2.0] = 1.0,
        /// Normalisation of a sample's weights, so that they sum to one.
        pub normalisation: Normalisation = Normalisation::Shifted,
        /// Filter that combines the reconstructed samples into the pixel.
        pub resolve: Resolve = Resolve::Box,
        /// With all but resolve=box: radius of that filter from the pixel's centre on each axis, in pixels.
        pub resolve_radius: f32 [0.5..=1.5] = 1.0,
        /// Size of the search for surfaces that no tap shows.
        pub search: Search = Search::None,
        /// Adds a further shading sample to the pixels that the image `extra` selects; the kernel `sraa_extra` lists them.
        pub extra: bool = false,
        /// With search, extra and demodulate: largest difference at which a tap shows a sample's surface.
        pub search_threshold: f32 [0.0..=16.0] = 0.05,
        /// In the kernels `sraa_place` and `sraa_extra`: largest difference at which a tap shows a sample's surface.
        pub unseen: f32 [0.0..=16.0] = 0.01,
        /// Properties known at every geometry sample, and therefore not borrowed: smooths edges of albedo and of shadow too.
        pub demodulate: Demodulate = Demodulate::None,
        /// With demodulate: least albedo to divide colours by, per channel. Darker surfaces show mostly reflections, which
        /// do not follow the albedo.
        pub albedo_floor: f32 [0.001..=1.0] = 0.04,
        /// With demodulate: least albedo of taps for a sample whose surface no tap shows; with less, reflections of dark
        /// taps become far too bright. For resolve=box, normalisation=shifted, one shading sample a pixel and up to 32
        /// geometry samples. A value of at most albedo-floor removes the branch for such samples.
        pub unseen_floor: f32 [0.001..=1.0] = 0.25,
        /// With demodulate: reads the image `rest`, the part of each pixel's colour that does not follow the albedo:
        /// highlights, reflections, haze. Borrowed unchanged.
        pub rest: bool = false,
        /// Estimate of the colour at every geometry sample, from which the colours are differences: supersamples edges of
        /// albedo and of shadow as far as the estimate knows them.
        pub guide: Guide = Guide::None,
        /// In the kernels `sraa_guide` and `sraa_residual`: source of the guide.
        pub estimate: Estimate = Estimate::Given,
        /// In the same kernels: multiplies the guide by the image `guide_scale`, written by `sraa_fit_sums` and `sraa_fit`.
        pub fitted: bool = false,
        /// Number of earlier frames that provide shading samples too.
        pub history: i32 [0..=4] = 0,
        /// Keeps the own colour of pixels without geometric variation.
        pub mask: Mask = Mask::None,
        /// With mask: surfaces that are compared for variation.
        pub variation: Variation = Variation::Around,
        /// With mask: largest difference that does not count as variation.
        pub mask_threshold: f32 [0.0..=16.0] = 0.002,
        /// With mask: largest step between the pixel's colour and that of a neighbour on its surface that does not count as
        /// variation, in displayed brightness from 0 to 1. A kept pixel then takes a 24th of each of these neighbours: the blur
        /// of its own area. With 1, colours are not compared, and a kept pixel has its own.
        pub mask_step: f32 [0.0..=1.0] = 1.0,
        /// Effect of a colour that is infinite or NaN.
        pub non_finite: NonFinite = NonFinite::Skip,
        /// Measure of the difference between two normals.
        pub turn: Turn = Turn::Cosine,
        /// With normals=unorm: normalises each normal first. Otherwise they are compared as stored, by their chord.
        pub renormalise: bool = false,
        /// Tests that keep infinities and NaN out of the pixel.
        pub guards: Guards = Guards::Inline,
        /// Decrease of a weight with the difference of the surfaces: exp(-tau * difference).
        pub tau: f32 [0.0..=1.0e6] = 500.0,
        /// Difference per unit of depth, or per share of it: large enough for a step between two surfaces to count as 1 or
        /// more.
        pub depth_scale: f32 [0.0..=1.0e6] = 1.0,
    }
}

/// Decrease of a tap's weight with its distance on the screen (paper §3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Falloff {
    /// None within the radius on each axis, as in the listing.
    None,
    /// Linear, to zero at the radius on each axis: sharper, and with fewer taps.
    Tent,
    /// Gaussian, cut off beyond the radius on each axis.
    Gaussian,
}

/// Normalisation of a sample's weights, so that they sum to one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normalisation {
    /// w / Σw as in the listing: 0/0 where no tap lies on the sample's surface.
    Paper,
    /// w / max(Σw, 1e-30): black where no tap lies on the sample's surface.
    Epsilon,
    /// w / Σw with the smallest difference subtracted first, which cancels out: the nearest surface always has weight 1, so
    /// Σw is never 0.
    Shifted,
}

/// Filter that combines the reconstructed samples into the pixel (paper §3.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resolve {
    /// Mean of the pixel's own samples.
    Box,
    /// Tent over all samples less than `resolve_radius` from the pixel's centre on each axis, including those of neighbours.
    Tent,
    /// Gaussian over the same samples, with a standard deviation of half the radius.
    Gaussian,
    /// Mitchell and Netravali's cubic (1988) over the same samples, with negative lobes. Each component stays in the range
    /// of the colours that the samples are made of.
    Mitchell,
    /// Sinc windowed by another, with two lobes on each side, over the same samples; kept within the same range.
    Lanczos,
}

/// Size of the search for surfaces that no tap shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// No search: the sample takes its colour from the most similar surfaces around it.
    None,
    /// The 5×5 pixels around the sample's own.
    Five,
    /// The 7×7 pixels around the sample's own.
    Seven,
}

/// Mask of pixels without geometric variation, which keep their own colour, noisy but sharp (paper §3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mask {
    /// No mask: all pixels are filtered, which blurs even regions a little.
    None,
    /// The pixel keeps its colour, but the filter is computed everywhere, in one basic block.
    Select,
    /// The pixel keeps its colour, and the filter is computed only where it is needed.
    Branch,
}

/// Surfaces that the mask compares for variation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variation {
    /// All surfaces that the filter compares.
    Around,
    /// The pixel's own geometry samples and its shading samples: where they show one surface, no neighbour's colour is needed,
    /// and little is read.
    Within,
}

/// Effect of a colour that is infinite or NaN.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NonFinite {
    /// Spoils every pixel in which it has weight.
    Spread,
    /// None: its weight goes to the other colours.
    Skip,
}

/// Measure of the difference between two normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// a·a - a·b: three operations; for unit normals the same as 1 - a·b up to rounding. A sample with a cleared normal, of
    /// length 0, ignores normals; a tap with one differs by 1.
    Cosine,
    /// ½|a - b|²: exactly 0 for equal normals of any length. For half precision, and for normals that are not of
    /// length 1.
    Chord,
}

/// Tests that keep infinities and NaN out of the pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guards {
    /// Tests on every value that is read, in one basic block.
    Inline,
    /// Test on the pixel only: if it is not finite, it is filtered again with all tests, in loops. A NaN in a depth or
    /// normal may go unnoticed, as `max` may drop it; then the other of depth and normal decides. A depth below -1e30 is
    /// unchanged, while `inline` treats it as the sky.
    Fallback,
    /// No tests: the caller guarantees finite colours and normals, and depths that are not NaN.
    None,
}

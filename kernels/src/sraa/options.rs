//! What an SRAA filter is made of: choices that the paper names, and those that it leaves open.

use crate::prelude::*;

use super::demodulate::Demodulate;
use super::gbuffer::{Depth, Layout, Normals};
use super::guide::{Estimate, Guide};
use super::metric::{Difference, Metric, Plane};
use super::pattern::{Pattern, Shading};
use super::view::Projection;

options! {
    /// What an SRAA filter is made of.
    pub struct Sraa {
        /// Where in a pixel geometry is sampled.
        pub pattern: Pattern = Pattern::Latin4,
        /// Of pattern=listed: x and y of each geometry sample, in pixels from the pixel's centre, y down.
        pub offsets: &'static [f32] [-0.5..=0.5] = &[],
        /// Of pattern=listed: whether it is to be a Latin square, with a row and a column for each sample.
        pub latin: bool = false,
        /// Where in a pixel shading is sampled.
        pub shading: Shading = Shading::Centre,
        /// Of shading=listed: the geometry samples that are shaded, counted from 0: one, two or four.
        pub shaded: &'static [i32] [0..=63] = &[],
        /// What tells two surfaces apart.
        pub metric: Metric = Metric::DepthNormals,
        /// Whether differences in depth count as they are, or as shares of the depth.
        pub difference: Difference = Difference::Absolute,
        /// Of metric=planes-normals: from whose plane a distance is measured.
        pub plane: Plane = Plane::Sample,
        /// How the camera projects.
        pub projection: Projection = Projection::Perspective,
        /// How the G-buffer holds depth.
        pub depth: Depth = Depth::Linear,
        /// How the G-buffer holds normals.
        pub normals: Normals = Normals::Float,
        /// How the G-buffer holds the samples of a pixel.
        pub layout: Layout = Layout::Layers,
        /// How a tap's weight falls with its distance on the screen.
        pub falloff: Falloff = Falloff::Tent,
        /// Of falloff=tent: the power that it is raised to. With 3 of 4 samples, and with 4 of 16, what varies smoothly within a surface is
        /// blurred as by the pixel's own area; with less, more, and what is shaded sharply within a surface is smoothed.
        pub sharpness: f32 [1.0..=4.0] = 1.0,
        /// Of falloff=gaussian: the standard deviation, in pixels. With less, the farthest taps would weigh too little for a float.
        pub sigma: f32 [0.125..=4.0] = 0.4,
        /// How far a tap may lie from its sample on each axis, in pixels: there the falloff ends. Farther, fewer samples are without
        /// a tap on their surface; more is read, and what is borrowed comes from farther away.
        pub radius: f32 [1.0..=2.0] = 1.0,
        /// How the weights of a sample are made to sum to one.
        pub normalisation: Normalisation = Normalisation::Shifted,
        /// How the reconstructed samples make up the pixel.
        pub resolve: Resolve = Resolve::Box,
        /// How far from the pixel's centre on each axis a filter of its samples ends, in pixels; not of resolve=box.
        pub resolve_radius: f32 [0.5..=1.5] = 1.0,
        /// How far the surface of a sample that no tap shows is searched for.
        pub search: Search = Search::None,
        /// Whether some pixels have a further shading sample, where the image `extra` says: the kernel `sraa_extra` lists them.
        pub extra: bool = false,
        /// Of search, extra and demodulate: the largest difference of what shows a sample's surface.
        pub search_threshold: f32 [0.0..=16.0] = 0.05,
        /// Of the kernels `sraa_place` and `sraa_extra`: the largest difference of what shows a sample's surface.
        pub unseen: f32 [0.0..=16.0] = 0.01,
        /// What is known at every geometry sample and so not borrowed: edges of paint and of shadow are then mended too.
        pub demodulate: Demodulate = Demodulate::None,
        /// Of demodulate: the least albedo that colours are divided by, a channel. What is darker shows mostly what it mirrors, of
        /// which the albedo says nothing.
        pub albedo_floor: f32 [0.001..=1.0] = 0.04,
        /// Of demodulate: the same of taps for a sample whose surface none of them shows, where what a dark one mirrors would shine many
        /// times as bright. With resolve=box, normalisation=shifted, one shading sample a pixel and up to 32 geometry samples. No more
        /// than albedo-floor, it leaves out the branch that such samples take.
        pub unseen_floor: f32 [0.001..=1.0] = 0.25,
        /// Of demodulate: whether the image `rest` holds what of each pixel's colour does not follow the albedo: highlights, mirror
        /// images, haze. That is borrowed as it is.
        pub rest: bool = false,
        /// Whether colours are differences from a guide, an estimate of the colour that is known at every geometry sample: edges of paint and
        /// of shadow are then supersampled as far as it knows them.
        pub guide: Guide = Guide::None,
        /// Of the kernels `sraa_guide` and `sraa_residual`: what the guide is made of.
        pub estimate: Estimate = Estimate::Given,
        /// Of the same: whether the guide is multiplied by the image `guide_scale`, which the kernels `sraa_fit_sums` and `sraa_fit` make.
        pub fitted: bool = false,
        /// How many earlier frames give shading samples too.
        pub history: i32 [0..=4] = 0,
        /// Whether pixels without geometric variation keep their own colour.
        pub mask: Mask = Mask::None,
        /// Of mask: where there must be no variation.
        pub variation: Variation = Variation::Around,
        /// Of mask: the largest difference that is no variation.
        pub mask_threshold: f32 [0.0..=16.0] = 0.002,
        /// Of mask: the largest step of a colour from one of the four neighbours on the pixel's plane that is no variation either, as a display
        /// shows it, in shares of white. With 1 colours are not looked at.
        pub mask_step: f32 [0.0..=1.0] = 1.0,
        /// What a colour that is infinite or not a number does.
        pub non_finite: NonFinite = NonFinite::Skip,
        /// How far apart two normals are.
        pub turn: Turn = Turn::Cosine,
        /// Of normals=unorm: whether each is made as long as 1 first. If not, they are compared as they are stored, by their chord.
        pub renormalise: bool = false,
        /// What keeps values that are infinite or not a number from the pixel.
        pub guards: Guards = Guards::Inline,
        /// How sharply a weight falls as surfaces differ: exp(-tau * difference).
        pub tau: f32 [0.0..=1.0e6] = 500.0,
        /// Difference per unit of depth, or per share of it: large enough that a step between two surfaces counts as 1 or
        /// more.
        pub depth_scale: f32 [0.0..=1.0e6] = 1.0,
    }
}

/// How a tap's weight falls with its distance on the screen (paper §3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all within the radius on each axis, as the listing has it.
    None,
    /// Linearly to zero at the radius on each axis: sharper, and with fewer taps.
    Tent,
    /// As a Gaussian, cut off beyond the radius on each axis.
    Gaussian,
}

/// How the weights of a sample are made to sum to one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normalisation {
    /// w / Σw as the listing has it: 0/0 where no tap lies on the sample's surface.
    Paper,
    /// w / max(Σw, 1e-30): black where no tap lies on the sample's surface.
    Epsilon,
    /// w / Σw with the smallest difference subtracted first, which cancels: the nearest surface always has weight 1, so
    /// Σw is never 0.
    Shifted,
}

/// How the reconstructed samples make up the pixel (paper §3.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resolve {
    /// The mean of the pixel's own.
    Box,
    /// A tent over those less than `resolve_radius` from its centre on each axis, its neighbours' among them.
    Tent,
    /// A Gaussian over the same, its standard deviation half of that.
    Gaussian,
    /// Mitchell and Netravali's cubic (1988), which goes below zero, over the same. No component leaves the range of the colours that the
    /// samples are made of.
    Mitchell,
    /// A sinc windowed by another, two lobes each way, over the same; kept within the same range.
    Lanczos,
}

/// How far the surface of a sample that no tap shows is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// Not at all: the sample takes its colour from the most similar surfaces around it.
    None,
    /// In the 5×5 pixels around its own.
    Five,
    /// In the 7×7 pixels around its own.
    Seven,
}

/// Whether pixels without geometric variation keep their own colour, noisy but sharp (paper §3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mask {
    /// All are filtered, and an even region is blurred a little.
    None,
    /// They do; the filter is computed everywhere, in one basic block.
    Select,
    /// They do, and the filter is computed only where it counts.
    Branch,
}

/// Where a mask looks for geometric variation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variation {
    /// Among all surfaces that the filter looks at.
    Around,
    /// Between the pixel's own geometry samples and its shading samples: where they show one surface, no neighbour's colour is
    /// needed, and little is read.
    Within,
}

/// What a colour that is infinite or not a number does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NonFinite {
    /// It spoils every pixel that it has weight in.
    Spread,
    /// Nothing: its weight goes to the others.
    Skip,
}

/// How far apart two normals are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// a·a - a·b: three operations, and of normals of length 1 the same as 1 - a·b to a rounding. A cleared normal at the sample, of
    /// length 0, does not count, and at a tap differs by 1.
    Cosine,
    /// ½|a - b|²: exactly 0 for the same normal, whatever its length. For half precision, and for normals that are not of
    /// length 1.
    Chord,
}

/// What keeps values that are infinite or not a number from the pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guards {
    /// Each that is read is tested, in one basic block.
    Inline,
    /// Only the pixel is: where it is not finite, it is filtered again, with all tests, in loops. A depth or a normal that is not
    /// a number may escape, as `max` may drop it: then the other of the two decides. A depth below -1e30 stays what it is, where
    /// `inline` takes it for the sky.
    Fallback,
    /// Nothing is: who calls promises finite colours and normals, and depths that are numbers.
    None,
}

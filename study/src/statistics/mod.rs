//! Statistics of rounds: medians with intervals, and the noise that shaders equal to each other show.

mod bootstrap;
mod noise;

pub use bootstrap::{CONFIDENCE, Interval, ratios_by_round};
pub use noise::{MARK, Noise, describe_noise, mark_ratio};

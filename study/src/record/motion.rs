//! Methods in frames that follow on each other.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;

/// Part of the scene that moves from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Motion {
    /// Nothing.
    Still,
    /// The camera, by 0.7 pixels sideways and 0.2 upwards at its target.
    Pan,
    /// The camera, about itself: by 0.45 pixels sideways and 0.3 upwards.
    Turn,
    /// A board before all else, by 3.3 pixels.
    Board,
}

impl Motion {
    /// All of them.
    pub const ALL: [Motion; 4] = [Motion::Still, Motion::Pan, Motion::Turn, Motion::Board];

    /// For people.
    pub fn display_name(self) -> &'static str {
        match self {
            Motion::Still => "still",
            Motion::Pan => "pan",
            Motion::Turn => "turn",
            Motion::Board => "board",
        }
    }
}

/// Errors of methods in motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionRecord {
    /// When, where and how it was made; nothing is timed.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Number of frames that are judged, each against 64 samples a pixel.
    pub frames: u32,
    /// Each scene in each motion.
    pub scenes: Vec<MovedScene>,
}

/// A scene in a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MovedScene {
    /// The scene.
    pub scene: String,
    /// Motion of the scene.
    pub motion: Motion,
    /// The methods.
    pub methods: Vec<MovedMethod>,
}

/// A method in a motion: means over the frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MovedMethod {
    /// A name for people.
    pub method: String,
    /// Options of its kernel that are not the default.
    pub options: Vec<OptionText>,
    /// PSNR in dB.
    pub psnr: f64,
    /// Mean FLIP.
    pub flip: f64,
    /// The root of the mean squared error of what changes from a frame to the next, in colours of 0..=1.
    pub flicker: f64,
}

impl Record for MotionRecord {
    const STEM: &'static str = "motion";

    fn to_table(&self) -> (Vec<&str>, Vec<Vec<String>>) {
        let rows = self.scenes.iter().flat_map(|scene| {
            scene.methods.iter().map(|found| {
                let mut row = vec![
                    scene.scene.clone(),
                    scene.motion.display_name().to_owned(),
                    found.method.clone(),
                ];
                row.extend([found.psnr, found.flip, found.flicker].map(|figure| figure.to_string()));
                row
            })
        });
        (
            vec!["scene", "motion", "method", "psnr", "flip", "flicker"],
            rows.collect(),
        )
    }
}

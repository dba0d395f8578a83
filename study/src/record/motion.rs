//! Record of methods over consecutive frames.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;
use straightline_table::{Column, Table};

/// Part of the scene that moves from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Motion {
    /// Nothing moves.
    Still,
    /// The camera moves, by 0.7 pixels sideways and 0.2 upwards at its target.
    Pan,
    /// The camera rotates in place: by 0.45 pixels sideways and 0.3 upwards.
    Turn,
    /// A board in front of everything moves, by 3.3 pixels.
    Board,
}

impl Motion {
    /// All motions.
    pub const ALL: [Motion; 4] = [Motion::Still, Motion::Pan, Motion::Turn, Motion::Board];

    /// Returns the display name.
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
    /// Time, place and method of the run; nothing is timed.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Number of scored frames, each against 64 samples a pixel.
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
    /// Display name.
    pub method: String,
    /// Options of its kernel that differ from their defaults.
    pub options: Vec<OptionText>,
    /// PSNR in dB.
    pub psnr: f64,
    /// Mean FLIP.
    pub flip: f64,
    /// Root mean squared error of the change between frames, in colours of 0..=1.
    pub flicker: f64,
}

impl Record for MotionRecord {
    const STEM: &'static str = "motion";

    fn to_table(&self) -> Table {
        let rows = self.scenes.iter();
        Table::of(rows.flat_map(|scene| scene.methods.iter().map(move |method| (scene, method))))
            .column("scene", |(scene, _)| &scene.scene)
            .column(Column::from("motion").left(), |(scene, _)| scene.motion.display_name())
            .column(Column::from("method").left(), |(_, method)| &method.method)
            .fixed(("psnr", "PSNR"), 2, |(_, method)| method.psnr)
            .fixed(("flip", "FLIP"), 4, |(_, method)| method.flip)
            .fixed("flicker", 4, |(_, method)| method.flicker)
            .finish()
    }
}

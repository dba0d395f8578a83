//! Presets and numbers of samples.

use std::fmt;
use std::str::FromStr;

/// Preset of the filter. `docs/sraa.md` has errors, times and memory of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Preset {
    /// The filter of the paper (Chajdas, McGuire and Luebke 2011). Depths are compared in scene units: a step of one unit is an
    /// edge.
    Paper,
    /// Depth alone: no normals are drawn.
    Fast,
    /// Planes in place of depths, and a search for surfaces that no neighbour shows.
    Edges,
    /// `Edges`, with surfaces smaller than a pixel shaded too: shading follows [`Sraa::place`](crate::Sraa::place).
    Full,
    /// `Full` with a guide: an estimate of the colour at every sample, which is drawn with the geometry.
    Guided,
}

impl Preset {
    /// All presets, the cheapest first.
    pub const ALL: [Preset; 5] = [Preset::Paper, Preset::Fast, Preset::Edges, Preset::Full, Preset::Guided];

    /// Name, as `--set preset=` has it.
    pub fn name(self) -> &'static str {
        match self {
            Preset::Paper => "paper",
            Preset::Fast => "fast",
            Preset::Edges => "edges",
            Preset::Full => "full",
            Preset::Guided => "guided",
        }
    }

    /// Returns whether normals are compared.
    pub fn has_normals(self) -> bool {
        self != Preset::Fast
    }

    /// Returns whether each pixel is shaded where [`Sraa::place`](crate::Sraa::place) says.
    pub fn has_place(self) -> bool {
        matches!(self, Preset::Full | Preset::Guided)
    }

    /// Returns whether a guide is drawn.
    pub fn has_guide(self) -> bool {
        self == Preset::Guided
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Preset {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Preset::ALL.into_iter().find(|preset| preset.name() == text);
        found.ok_or_else(|| {
            format!(
                "no preset {text}: use one of {}",
                Preset::ALL.map(Preset::name).join(", ")
            )
        })
    }
}

/// Number of geometry samples of a pixel, and how they are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Samples {
    /// Four: one pass into multisampled targets.
    #[default]
    Four,
    /// Sixteen: a pass for each sample. For the feature `sixteen`.
    Sixteen,
}

impl Samples {
    /// Positions from the pixel's centre, in pixels, y down: the patterns `latin4` and `latin16`.
    pub fn offsets(self) -> &'static [[f32; 2]] {
        match self {
            Samples::Four => &LATIN4,
            Samples::Sixteen => &LATIN16,
        }
    }
}

const LATIN4: [[f32; 2]; 4] = [[-0.125, -0.375], [0.375, -0.125], [-0.375, 0.125], [0.125, 0.375]];

const LATIN16: [[f32; 2]; 16] = pixels([
    [3, 3],
    [5, 11],
    [11, 7],
    [13, 15],
    [-5, 5],
    [-3, 13],
    [-11, 9],
    [-15, 1],
    [-1, -5],
    [-9, -3],
    [-7, -11],
    [-13, -15],
    [9, -1],
    [7, -9],
    [1, -13],
    [15, -7],
]);

/// Offsets in pixels, from thirty-seconds of a pixel.
const fn pixels(parts: [[i8; 2]; 16]) -> [[f32; 2]; 16] {
    let mut all = [[0.0; 2]; 16];
    let mut k = 0;
    while k < 16 {
        all[k] = [parts[k][0] as f32 / 32.0, parts[k][1] as f32 / 32.0];
        k += 1;
    }
    all
}

/// Settings of [`Sraa`](crate::Sraa). A [`Preset`] alone is enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Options {
    /// Preset of the filter.
    pub preset: Preset,
    /// Geometry samples of a pixel.
    pub samples: Samples,
    /// Draws normals even if the preset does not compare them.
    pub draw_normals: bool,
}

impl Options {
    /// A preset with four samples.
    pub fn new(preset: Preset) -> Self {
        Options {
            preset,
            samples: Samples::Four,
            draw_normals: false,
        }
    }

    /// Sets the number of geometry samples.
    ///
    /// ```
    /// use straightline_sraa::{Options, Preset, Samples};
    ///
    /// let options = Options::new(Preset::Guided).samples(Samples::Sixteen);
    /// ```
    #[must_use]
    pub fn samples(mut self, samples: Samples) -> Self {
        self.samples = samples;
        self
    }
}

impl Options {
    /// Sets whether normals are drawn even if the preset does not compare them: for deferred shading, which reads them.
    #[must_use]
    pub fn draw_normals(mut self, drawn: bool) -> Self {
        self.draw_normals = drawn;
        self
    }

    pub(crate) fn has_normals(self) -> bool {
        self.draw_normals || self.preset.has_normals()
    }
}

impl From<Preset> for Options {
    fn from(preset: Preset) -> Self {
        Options::new(preset)
    }
}

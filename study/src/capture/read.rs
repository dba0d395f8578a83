//! Reading a capture from its folder.

use super::description::{Description, STATED_BY};
use super::{COLOR, Capture, CaptureError, DEPTH, DESCRIPTION, NORMAL, REFERENCE, layer_count, layer_name};
use crate::picture::PictureError;
use crate::picture::exr::{Source, read_color};
use glam::{UVec2, Vec3};
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use straightline_codegen::{files, shorten};
use straightline_kernels::prelude::{Frame, FrameLayers};

/// Longest `capture.json` that is read, in bytes.
const MAX_DESCRIPTION: u64 = 1 << 20;

impl Capture {
    /// Reads the capture in folder `dir`. Every size and count is checked against `capture.json` before memory is
    /// set aside for it. Colours and depths may be infinite or NaN: filters say what they make of those. Normals and the
    /// reference may not: what is measured against a NaN says nothing.
    pub fn read(dir: &Path) -> Result<Capture, CaptureError> {
        let description = read_description(dir)?;
        let layout = Layout {
            dir,
            description: &description,
        };
        let color = layout.color(COLOR, "the shading, one sample a pixel, in channels R, G and B")?;
        let depth = layout.layers(DEPTH, ["Z"], "channel Z", |[z]| z)?;
        let normal = match layout.optional(NORMAL) {
            Some(path) => {
                let normal = layout.layers(NORMAL, ["X", "Y", "Z"], "channels X, Y and Z", Vec3::from)?;
                for (layer, frame) in normal.layers().iter().enumerate() {
                    let name = format!("layer `{}`", layer_name(layer, description.samples().len()));
                    finite(&path, &name, frame, |normal| normal.is_finite())?;
                }
                Some(normal)
            }
            None => None,
        };
        let reference = match layout.optional(REFERENCE) {
            Some(path) => {
                let reference = layout.color(REFERENCE, "the reference")?;
                finite(&path, "its colour", &reference, |colour| colour.is_finite())?;
                Some(reference)
            }
            None => None,
        };
        Ok(Capture {
            size: description.size(),
            samples: description.samples(),
            shading: description.shading(),
            color,
            depth,
            normal,
            reference,
            camera: description.camera,
        })
    }
}

/// Refuses an image with a texel that is infinite or not a number, with its place.
fn finite<T: Copy + std::fmt::Debug>(
    path: &Path,
    layer: &str,
    frame: &Frame<T>,
    is_finite: impl Fn(&T) -> bool,
) -> Result<(), CaptureError> {
    let Some(at) = frame.texels().iter().position(|texel| !is_finite(texel)) else {
        return Ok(());
    };
    let width = frame.size().x as usize;
    let bad = frame.texels().iter().filter(|texel| !is_finite(texel)).count();
    let problem = format!(
        "{layer} is {:?} at ({}, {}), which is not finite ({bad} of {} pixels are not)",
        frame.texels()[at],
        at % width,
        at / width,
        frame.texels().len()
    );
    Err(PictureError::Unusable {
        path: path.to_owned(),
        problem,
    }
    .into())
}

fn read_description(dir: &Path) -> Result<Description, CaptureError> {
    let path = dir.join(DESCRIPTION);
    let refused = |source| PictureError::Io {
        action: "read",
        path: path.clone(),
        source,
    };
    let text = files::read_text(&path, MAX_DESCRIPTION).map_err(|error| match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => CaptureError::NotACapture { dir: dir.to_owned() },
        _ => CaptureError::from(refused(error)),
    })?;
    Description::parse(&path, &text)
}

/// A capture's folder and what it should hold.
struct Layout<'a> {
    dir: &'a Path,
    description: &'a Description,
}

impl Layout<'_> {
    fn size(&self) -> UVec2 {
        self.description.size()
    }

    fn optional(&self, file: &str) -> Option<PathBuf> {
        Some(self.dir.join(file)).filter(|path| path.exists())
    }

    fn required(&self, file: &str, contents: &str) -> Result<PathBuf, CaptureError> {
        self.optional(file).ok_or_else(|| CaptureError::MissingFile {
            path: self.dir.join(file),
            contents: contents.to_owned(),
        })
    }

    fn color(&self, file: &str, contents: &str) -> Result<Frame<glam::Vec4>, CaptureError> {
        let path = self.required(file, contents)?;
        Ok(read_color(&path, Some((self.size(), STATED_BY)))?)
    }

    /// Reads `channels` of every layer of `file`, and makes a texel of each set of values.
    fn layers<const N: usize, T: Copy>(
        &self,
        file: &str,
        channels: [&str; N],
        wanted: &str,
        texel: impl Fn([f32; N]) -> T,
    ) -> Result<FrameLayers<T>, CaptureError> {
        let samples = self.description.samples().len();
        let count = layer_count(samples, self.description.shading());
        let path = self.required(file, &format!("a layer a sample with {wanted}"))?;
        let source = Source::open(&path)?;
        self.refuse_surplus(&path, &source, samples)?;
        let mut planes = Vec::with_capacity(count * N);
        for layer in 0..count {
            let name = layer_name(layer, samples);
            for channel in channels {
                let plane = source.find(&name, channel, wanted)?;
                source.check(plane, &format!("layer `{name}`"), self.size(), STATED_BY)?;
                planes.push(plane);
            }
        }
        let values = source.read(&planes)?;
        let frames = values.chunks_exact(N).map(|planes| {
            let texels = (0..planes[0].len()).map(|i| texel(std::array::from_fn(|channel| planes[channel][i])));
            Frame::new(self.size(), texels.collect())
        });
        Ok(FrameLayers::new(frames.collect()))
    }

    /// A layer that `capture.json` does not ask for is a sign that the two do not belong together, and of two layers of one
    /// name nobody can tell which is meant.
    fn refuse_surplus(&self, path: &Path, source: &Source, samples: usize) -> Result<(), CaptureError> {
        let count = layer_count(samples, self.description.shading());
        let expected: Vec<String> = (0..count).map(|layer| layer_name(layer, samples)).collect();
        let found = source.layer_channels();
        let mut seen = BTreeSet::new();
        let surplus = found.iter().find_map(|(layer, channel)| {
            if !expected.contains(layer) {
                return Some(format!("there is a layer `{}`", shorten(layer)));
            }
            let again = !seen.insert((layer, channel));
            again.then(|| format!("there are two layers `{layer}` with a channel `{}`", shorten(channel)))
        });
        match surplus {
            Some(problem) => Err(CaptureError::Layers {
                path: path.to_owned(),
                problem,
                samples,
                expected: expected_layers(samples, count),
            }),
            None => Ok(()),
        }
    }
}

/// The names of all layers, in words.
pub(super) fn expected_layers(samples: usize, count: usize) -> String {
    let names = match samples {
        1 => "layer `sample0`".to_owned(),
        _ => format!("layers `sample0` to `sample{}`", samples.saturating_sub(1)),
    };
    if count > samples {
        names + " and `centre`"
    } else {
        names
    }
}

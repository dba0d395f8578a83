//! Reading a capture from its folder.

use super::description::{Description, STATED_BY};
use super::{COLOR, Capture, CaptureError, DEPTH, DESCRIPTION, NORMAL, REFERENCE, layer_count, layer_name};
use crate::picture::PictureError;
use crate::picture::exr::{Source, read_color};
use glam::{UVec2, Vec3};
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use straightline_kernels::prelude::{Frame, FrameLayers};

/// Longest `capture.json` that is read, in bytes.
const MAX_DESCRIPTION: u64 = 1 << 20;

impl Capture {
    /// Reads the capture in folder `dir`. Every size and count is checked against `capture.json` before memory is
    /// set aside for it. Values are taken as they are: colours, depths and normals may be infinite or NaN.
    pub fn read(dir: &Path) -> Result<Capture, CaptureError> {
        let description = read_description(dir)?;
        let layout = Layout {
            dir,
            description: &description,
        };
        let color = layout.color(COLOR, "the shading, one sample a pixel, in channels R, G and B")?;
        let depth = layout.layers(DEPTH, ["Z"], "channel Z", |[z]| z)?;
        let normal = match layout.optional(NORMAL) {
            Some(_) => Some(layout.layers(NORMAL, ["X", "Y", "Z"], "channels X, Y and Z", Vec3::from)?),
            None => None,
        };
        let reference = match layout.optional(REFERENCE) {
            Some(_) => Some(layout.color(REFERENCE, "the reference")?),
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

fn read_description(dir: &Path) -> Result<Description, CaptureError> {
    let path = dir.join(DESCRIPTION);
    let refused = |source| PictureError::Io {
        action: "read",
        path: path.clone(),
        source,
    };
    let file = File::open(&path).map_err(|error| match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => CaptureError::NotACapture { dir: dir.to_owned() },
        _ => refused(error).into(),
    })?;
    let mut text = String::new();
    file.take(MAX_DESCRIPTION).read_to_string(&mut text).map_err(refused)?;
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

    /// A layer of a sample that `capture.json` does not list is a sign that the two do not belong together.
    fn refuse_surplus(&self, path: &Path, source: &Source, samples: usize) -> Result<(), CaptureError> {
        let index = |name: &str| {
            name.strip_prefix("sample")
                .and_then(|digits| digits.parse::<usize>().ok())
        };
        match source
            .layer_names()
            .iter()
            .find(|name| index(name).is_some_and(|index| index >= samples))
        {
            Some(name) => Err(CaptureError::Layers {
                path: path.to_owned(),
                problem: format!("there is a layer `{name}`"),
                samples,
                expected: expected_layers(samples, layer_count(samples, self.description.shading())),
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

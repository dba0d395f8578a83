//! Reading a capture from its folder.

use super::description::{Description, STATED_BY};
use super::{
    ALBEDO, COLOR, Capture, CaptureError, DEPTH, DESCRIPTION, DIRECT, GUIDE, NORMAL, PLACE, PLACE_CHANNEL, PLACE_LAYER,
    REFERENCE, REST, ShadingSample, layer_count, layer_name, mean_frame,
};
use crate::picture::PictureError;
use crate::picture::exr::{Source, read_color};
use glam::{UVec2, Vec3, Vec4};
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use straightline_files::{self as files, shorten};
use straightline_kernels::prelude::{Frame, FrameLayers};

/// Channels of a layer of colours.
const RGB: &str = "channels R, G and B";

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
        let (color, colors) = layout.read_shading()?;
        let place = layout.read_places()?;
        let depth = layout.read_layers(DEPTH, ["Z"], "channel Z", |[z]| z)?;
        let normal = match layout.optional_path(NORMAL) {
            Some(path) => {
                let normal = layout.read_layers(NORMAL, ["X", "Y", "Z"], "channels X, Y and Z", Vec3::from)?;
                for (layer, frame) in normal.layers().iter().enumerate() {
                    let name = format!("layer `{}`", layer_name(layer, description.sample_offsets().len()));
                    check_finite(&path, &name, frame, |normal| normal.is_finite())?;
                }
                Some(normal)
            }
            None => None,
        };
        let in_layers = |file: &str| {
            layout
                .optional_path(file)
                .map(|_| layout.colors_of_layers(file))
                .transpose()
        };
        let (albedo, guide) = (in_layers(ALBEDO)?, in_layers(GUIDE)?);
        let once = |file: &str, what: &str| {
            layout
                .optional_path(file)
                .map(|path| layout.read_color_part(&path, file, what))
                .transpose()
        };
        let direct = once(DIRECT, "direct light")?;
        let rest = once(REST, "what does not follow the albedo")?;
        let reference = match layout.optional_path(REFERENCE) {
            Some(path) => {
                let reference = layout.read_color_file(REFERENCE, "the reference")?;
                check_finite(&path, "its colour", &reference, |colour| colour.is_finite())?;
                Some(reference)
            }
            None => None,
        };
        Ok(Capture {
            size: description.size(),
            samples: description.sample_offsets(),
            shading: description.shading(),
            normal_space: description.normals,
            color,
            colors,
            place,
            depth,
            normal,
            albedo,
            direct,
            rest,
            guide,
            reference,
            camera: description.camera,
        })
    }
}

/// Refuses an image with a texel that is infinite or not a number, with its place.
fn check_finite<T: Copy + std::fmt::Debug>(
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

/// Refuses a number that no layer of `samples` and the centre has.
pub(super) fn check_place(path: &Path, samples: usize, place: &Frame<u32>) -> Result<(), CaptureError> {
    let Some(at) = place.texels().iter().position(|layer| *layer as usize > samples) else {
        return Ok(());
    };
    let width = place.size().x as usize;
    let problem = format!(
        "the pixel at ({}, {}) has no layer's number: 0 to {} are samples, {samples} is the centre",
        at % width,
        at / width,
        samples - 1
    );
    Err(PictureError::Unusable {
        path: path.to_owned(),
        problem,
    }
    .into())
}

/// Refuses `what` of several shading samples a pixel.
pub(super) fn check_once(path: &Path, what: &str, shading: &ShadingSample) -> Result<(), CaptureError> {
    let ShadingSample::Samples(_) = shading else {
        return Ok(());
    };
    let problem = format!(
        "the capture is shaded several times a pixel, and {what} is kept apart of one shading sample alone: leave the file out"
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

    fn optional_path(&self, file: &str) -> Option<PathBuf> {
        Some(self.dir.join(file)).filter(|path| path.exists())
    }

    fn required_path(&self, file: &str, contents: &str) -> Result<PathBuf, CaptureError> {
        self.optional_path(file).ok_or_else(|| CaptureError::MissingFile {
            path: self.dir.join(file),
            contents: contents.to_owned(),
        })
    }

    fn read_color_file(&self, file: &str, contents: &str) -> Result<Frame<Vec4>, CaptureError> {
        let path = self.required_path(file, contents)?;
        Ok(read_color(&path, Some((self.size(), STATED_BY)))?)
    }

    /// The colour of each pixel, and of several shading samples a pixel each by itself.
    fn read_shading(&self) -> Result<(Frame<Vec4>, Vec<Frame<Vec4>>), CaptureError> {
        let ShadingSample::Samples(shaded) = self.description.shading() else {
            let one = "the shading, one sample a pixel, in channels R, G and B";
            return Ok((self.read_color_file(COLOR, one)?, Vec::new()));
        };
        let samples = self.description.sample_offsets().len();
        let names: Vec<String> = shaded.iter().map(|sample| layer_name(*sample, samples)).collect();
        let contents = format!("the shading of {} with {RGB} each", in_words(&names));
        let colors = self.color_layers(COLOR, &names, &contents)?;
        let color = mean_frame(&colors).ok_or_else(|| CaptureError::MissingFile {
            path: self.dir.join(COLOR),
            contents: "the shading".to_owned(),
        })?;
        Ok((color, colors))
    }

    /// A colour of every layer of the geometry.
    fn colors_of_layers(&self, file: &str) -> Result<FrameLayers<Vec4>, CaptureError> {
        let samples = self.description.sample_offsets().len();
        let count = layer_count(samples, &self.description.shading());
        let names: Vec<String> = (0..count).map(|layer| layer_name(layer, samples)).collect();
        let layers = self.color_layers(file, &names, &format!("a layer a sample with {RGB}"))?;
        Ok(FrameLayers::new(layers))
    }

    /// A part of the colour of each pixel's only shading sample.
    fn read_color_part(&self, path: &Path, file: &str, what: &str) -> Result<Frame<Vec4>, CaptureError> {
        check_once(path, what, &self.description.shading())?;
        self.read_color_file(file, what)
    }

    /// The layers of a file by their names, each a colour; alpha is 1 where there is none.
    fn color_layers(&self, file: &str, names: &[String], contents: &str) -> Result<Vec<Frame<Vec4>>, CaptureError> {
        let path = self.required_path(file, contents)?;
        let source = Source::open(&path)?;
        self.refuse_surplus(&path, &source, names)?;
        let found = source.layer_channels();
        let (mut planes, mut alphas) = (Vec::new(), Vec::new());
        for name in names {
            let alpha = found.iter().any(|(layer, channel)| layer == name && channel == "A");
            alphas.push(alpha);
            for channel in ["R", "G", "B"].into_iter().chain(alpha.then_some("A")) {
                let plane = source.find_plane(name, channel, RGB)?;
                source.check_plane(plane, &format!("layer `{name}`"), self.size(), STATED_BY)?;
                planes.push(plane);
            }
        }
        let mut values = source.read_planes(&planes)?.into_iter();
        let mut colors = Vec::new();
        for alpha in alphas {
            let own: Vec<Vec<f32>> = values.by_ref().take(3 + usize::from(alpha)).collect();
            let texel = |i: usize| Vec4::new(own[0][i], own[1][i], own[2][i], own.get(3).map_or(1.0, |a| a[i]));
            colors.push(Frame::new(self.size(), (0..own[0].len()).map(texel).collect()));
        }
        Ok(colors)
    }

    /// The layer in whose place each pixel is shaded, if `capture.json` says that there are such places.
    fn read_places(&self) -> Result<Option<Frame<u32>>, CaptureError> {
        if self.description.shading() != ShadingSample::Placed {
            return Ok(None);
        }
        let wanted = "channel Y";
        let contents = "the number of the layer in whose place each pixel is shaded, in channel Y of layer `place`";
        let path = self.required_path(PLACE, contents)?;
        let source = Source::open(&path)?;
        self.refuse_surplus(&path, &source, &[PLACE_LAYER.to_owned()])?;
        let plane = source.find_plane(PLACE_LAYER, PLACE_CHANNEL, wanted)?;
        source.check_plane(plane, "layer `place`", self.size(), STATED_BY)?;
        let values = source.read_planes(&[plane])?.pop().unwrap_or_default();
        // A value that is not such a number becomes a number that does not occur.
        let number = |value: f32| {
            if value.fract() == 0.0 && value >= 0.0 {
                value as u32
            } else {
                u32::MAX
            }
        };
        let place = Frame::new(self.size(), values.into_iter().map(number).collect());
        check_place(&path, self.description.sample_offsets().len(), &place)?;
        Ok(Some(place))
    }

    /// Reads `channels` of every layer of `file`, and makes a texel of each set of values.
    fn read_layers<const N: usize, T: Copy>(
        &self,
        file: &str,
        channels: [&str; N],
        wanted: &str,
        texel: impl Fn([f32; N]) -> T,
    ) -> Result<FrameLayers<T>, CaptureError> {
        let samples = self.description.sample_offsets().len();
        let count = layer_count(samples, &self.description.shading());
        let path = self.required_path(file, &format!("a layer a sample with {wanted}"))?;
        let source = Source::open(&path)?;
        let names: Vec<String> = (0..count).map(|layer| layer_name(layer, samples)).collect();
        self.refuse_surplus(&path, &source, &names)?;
        let mut planes = Vec::with_capacity(count * N);
        for name in &names {
            for channel in channels {
                let plane = source.find_plane(name, channel, wanted)?;
                source.check_plane(plane, &format!("layer `{name}`"), self.size(), STATED_BY)?;
                planes.push(plane);
            }
        }
        let values = source.read_planes(&planes)?;
        let frames = values.chunks_exact(N).map(|planes| {
            let texels = (0..planes[0].len()).map(|i| texel(std::array::from_fn(|channel| planes[channel][i])));
            Frame::new(self.size(), texels.collect())
        });
        Ok(FrameLayers::new(frames.collect()))
    }

    /// Refuses surplus layers: a layer that `capture.json` does not ask for is a sign that the two do not belong together, and
    /// two layers of one name are ambiguous.
    fn refuse_surplus(&self, path: &Path, source: &Source, expected: &[String]) -> Result<(), CaptureError> {
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
                samples: self.description.sample_offsets().len(),
                expected: in_words(expected),
            }),
            None => Ok(()),
        }
    }
}

/// The names of all layers of a capture's geometry, in words.
pub(super) fn expected_layers(samples: usize, count: usize) -> String {
    let names: Vec<String> = (0..count).map(|layer| layer_name(layer, samples)).collect();
    in_words(&names)
}

/// Names of layers: of more than three in a row the first and the last.
fn in_words(names: &[String]) -> String {
    let samples = names.iter().filter(|name| *name != "centre").count();
    let in_a_row = (0..samples).all(|k| names[k] == layer_name(k, samples));
    let quoted = |name: &String| format!("`{name}`");
    match names {
        [only] => format!("layer {}", quoted(only)),
        [first, ..] if in_a_row && samples > 1 => {
            let rest = if names.len() > samples { " and `centre`" } else { "" };
            format!("layers {} to {}{rest}", quoted(first), quoted(&names[samples - 1]))
        }
        _ => format!("layers {}", names.iter().map(quoted).collect::<Vec<_>>().join(" and ")),
    }
}

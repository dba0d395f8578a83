//! Writing a capture, whole or not at all.

use super::description::{Description, STATED_BY};
use super::read::expected_layers;
use super::{
    ALBEDO, COLOR, Capture, CaptureError, DEPTH, DESCRIPTION, DIRECT, FILES, GUIDE, NORMAL, PLACE, PLACE_CHANNEL,
    PLACE_LAYER, REFERENCE, REST, ShadingSample, layer_name,
};
use crate::picture::exr::{self, Layer};
use crate::picture::{self, PictureError};
use glam::UVec2;
use std::fs;
use std::io;
use std::path::Path;
use straightline_files::{Folders, Scrap};
use straightline_kernels::prelude::{Frame, FrameLayers};

impl Capture {
    /// Writes the capture as folder `dir`, making the folders above it.
    ///
    /// The folder appears when it is complete; after an error it is as it was. A capture that is there already is
    /// replaced; a folder with anything else in it is refused.
    pub fn write(&self, dir: &Path) -> Result<(), CaptureError> {
        let description = Description::from_capture(self);
        self.check(&description, dir)?;
        // A link to a folder stays a link: what it points at is replaced.
        let dir = &fs::canonicalize(dir).unwrap_or_else(|_| dir.to_owned());
        refuse_occupied(dir)?;
        let refused = |source| PictureError::Io {
            action: "write",
            path: dir.to_owned(),
            source,
        };
        let above = Folders::make(dir.parent().unwrap_or(Path::new(""))).map_err(refused)?;
        let scrap = Scrap::beside(dir, "partial").map_err(refused)?;
        fs::create_dir(scrap.path()).map_err(refused)?;
        self.write_files(&description, scrap.path())?;
        replace_dir(scrap.path(), dir).map_err(refused)?;
        above.keep();
        Ok(())
    }

    /// Refuses what [`Capture::read`] would refuse.
    fn check(&self, description: &Description, dir: &Path) -> Result<(), CaptureError> {
        description.check(&dir.join(DESCRIPTION))?;
        self.check_size(dir, COLOR, "its colour", self.color.size())?;
        let several = match &self.shading {
            ShadingSample::Samples(shaded) => shaded.len(),
            ShadingSample::Sample(_) | ShadingSample::Centre | ShadingSample::Placed => 0,
        };
        if self.colors.len() != several {
            return Err(CaptureError::Value {
                path: dir.join(DESCRIPTION),
                field: "shading",
                problem: format!(
                    "it lists {several} samples, and there are colours of {}",
                    self.colors.len()
                ),
            });
        }
        for color in &self.colors {
            self.check_size(dir, COLOR, "each layer", color.size())?;
        }
        if self.place.is_some() != (self.shading == ShadingSample::Placed) {
            return Err(CaptureError::Value {
                path: dir.join(DESCRIPTION),
                field: "shading",
                problem: "pixels are given places if shading is \"placed\", and only then".to_owned(),
            });
        }
        if let Some(place) = &self.place {
            self.check_size(dir, PLACE, "its layer", place.size())?;
            super::read::check_place(&dir.join(PLACE), self.samples.len(), place)?;
        }
        self.check_layers(dir, DEPTH, &self.depth)?;
        if let Some(normal) = &self.normal {
            self.check_layers(dir, NORMAL, normal)?;
        }
        if let Some(albedo) = &self.albedo {
            self.check_layers(dir, ALBEDO, albedo)?;
        }
        if let Some(guide) = &self.guide {
            self.check_layers(dir, GUIDE, guide)?;
        }
        if let Some(direct) = &self.direct {
            self.check_size(dir, DIRECT, "its colour", direct.size())?;
            super::read::check_once(&dir.join(DIRECT), "direct light", &self.shading)?;
        }
        if let Some(rest) = &self.rest {
            self.check_size(dir, REST, "its colour", rest.size())?;
            super::read::check_once(&dir.join(REST), "what does not follow the albedo", &self.shading)?;
        }
        if let Some(reference) = &self.reference {
            self.check_size(dir, REFERENCE, "its colour", reference.size())?;
        }
        Ok(())
    }

    fn check_layers<T: Copy>(&self, dir: &Path, file: &str, stack: &FrameLayers<T>) -> Result<(), CaptureError> {
        let (samples, count) = (self.samples.len(), self.layer_count());
        if stack.layers().len() != count {
            return Err(CaptureError::Layers {
                path: dir.join(file),
                problem: format!("there are {} layers", stack.layers().len()),
                samples,
                expected: expected_layers(samples, count),
            });
        }
        self.check_size(dir, file, "each layer", stack.layers()[0].size())
    }

    fn check_size(&self, dir: &Path, file: &str, layer: &str, found: UVec2) -> Result<(), CaptureError> {
        if found == self.size {
            return Ok(());
        }
        Err(PictureError::Size {
            path: dir.join(file),
            layer: layer.to_owned(),
            found,
            expected: self.size,
            expected_by: STATED_BY.to_owned(),
        }
        .into())
    }

    /// Writes every file into `dir`.
    fn write_files(&self, description: &Description, dir: &Path) -> Result<(), CaptureError> {
        let path = dir.join(DESCRIPTION);
        let json = description.to_json().map_err(|source| CaptureError::Json {
            path: path.clone(),
            source,
        })?;
        fs::write(&path, json).map_err(|source| PictureError::Io {
            action: "write",
            path,
            source,
        })?;
        match &self.shading {
            ShadingSample::Samples(shaded) => {
                let name = |sample: &usize| layer_name(*sample, self.samples.len());
                let layers = shaded.iter().zip(&self.colors);
                let layers = layers.map(|(sample, frame)| Layer::new(name(sample), picture::color_channels(frame)));
                exr::write_layers(&dir.join(COLOR), self.size, layers.collect())?;
            }
            ShadingSample::Sample(_) | ShadingSample::Centre | ShadingSample::Placed => {
                picture::write_exr(&dir.join(COLOR), &self.color)?;
            }
        }
        if let Some(place) = &self.place {
            let layer = Layer::new(
                PLACE_LAYER,
                vec![(PLACE_CHANNEL, component_plane(place, |layer| layer as f32))],
            );
            exr::write_layers(&dir.join(PLACE), self.size, vec![layer])?;
        }
        self.write_layers(&dir.join(DEPTH), &self.depth, |depth| {
            vec![("Z", component_plane(depth, |z| z))]
        })?;
        if let Some(normal) = &self.normal {
            self.write_layers(&dir.join(NORMAL), normal, |normal| {
                vec![
                    ("X", component_plane(normal, |n| n.x)),
                    ("Y", component_plane(normal, |n| n.y)),
                    ("Z", component_plane(normal, |n| n.z)),
                ]
            })?;
        }
        if let Some(albedo) = &self.albedo {
            self.write_layers(&dir.join(ALBEDO), albedo, picture::color_channels)?;
        }
        if let Some(direct) = &self.direct {
            picture::write_exr(&dir.join(DIRECT), direct)?;
        }
        if let Some(rest) = &self.rest {
            picture::write_exr(&dir.join(REST), rest)?;
        }
        if let Some(guide) = &self.guide {
            self.write_layers(&dir.join(GUIDE), guide, picture::color_channels)?;
        }
        if let Some(reference) = &self.reference {
            picture::write_exr(&dir.join(REFERENCE), reference)?;
        }
        Ok(())
    }

    fn write_layers<T: Copy>(
        &self,
        path: &Path,
        stack: &FrameLayers<T>,
        channels: impl Fn(&Frame<T>) -> Vec<(&'static str, Vec<f32>)>,
    ) -> Result<(), PictureError> {
        let name = |index| layer_name(index, self.samples.len());
        let layers = stack
            .layers()
            .iter()
            .enumerate()
            .map(|(index, frame)| Layer::new(name(index), channels(frame)));
        exr::write_layers(path, self.size, layers.collect())
    }
}

fn component_plane<T: Copy>(frame: &Frame<T>, component: impl Fn(T) -> f32) -> Vec<f32> {
    frame.texels().iter().map(|texel| component(*texel)).collect()
}

/// Refuses a folder with anything but a capture in it, and anything that is no folder.
fn refuse_occupied(dir: &Path) -> Result<(), CaptureError> {
    let refused = |source| PictureError::Io {
        action: "write",
        path: dir.to_owned(),
        source,
    };
    let entries = match fs::read_dir(dir) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(refused(error).into()),
    };
    let mut names = Vec::new();
    for entry in entries {
        names.push(entry.map_err(refused)?.file_name().to_string_lossy().into_owned());
    }
    let is_capture = names.iter().any(|name| name == DESCRIPTION);
    match names
        .into_iter()
        .find(|name| !is_capture || !FILES.contains(&name.as_str()))
    {
        Some(entry) => Err(CaptureError::Occupied {
            dir: dir.to_owned(),
            entry,
        }),
        None => Ok(()),
    }
}

/// Puts the folder `new` in the place of `dir`. If that fails, `dir` is what it was.
fn replace_dir(new: &Path, dir: &Path) -> io::Result<()> {
    if !dir.exists() {
        return fs::rename(new, dir);
    }
    // Not a scrap before the new one is in its place: an interruption would remove the only one that there is.
    let old = dir.with_file_name(format!(
        ".{}.replaced-{}",
        dir.file_name().unwrap_or_default().to_string_lossy(),
        std::process::id()
    ));
    fs::rename(dir, &old)?;
    match fs::rename(new, dir) {
        Ok(()) => fs::remove_dir_all(&old),
        Err(error) => fs::rename(&old, dir).and(Err(error)),
    }
}

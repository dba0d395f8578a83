//! Replacement for EXR files in a build without them: every attempt is an error that names the feature.

use super::PictureError;
use glam::{UVec2, Vec4};
use std::path::Path;
use straightline_kernels::prelude::Frame;

fn not_built<T>(path: &Path) -> Result<T, PictureError> {
    Err(PictureError::NotBuilt {
        path: path.to_owned(),
        format: "EXR",
        feature: "exr",
    })
}

/// A layer that would be written.
pub(crate) struct Layer;

impl Layer {
    pub(crate) fn new(_name: impl Into<String>, _channels: Vec<(&'static str, Vec<f32>)>) -> Self {
        Layer
    }
}

pub(crate) fn write_layers(path: &Path, _size: UVec2, _layers: Vec<Layer>) -> Result<(), PictureError> {
    not_built(path)
}

pub(crate) fn read_color(path: &Path, _expected: Option<(UVec2, &str)>) -> Result<Frame<Vec4>, PictureError> {
    not_built(path)
}

pub(crate) fn layer_names(path: &Path) -> Result<Vec<String>, PictureError> {
    not_built(path)
}

pub(crate) fn read_layer(path: &Path, _layer: &str) -> Result<Frame<Vec4>, PictureError> {
    not_built(path)
}

/// A channel of a file: there is none.
#[derive(Clone, Copy)]
pub(crate) enum Plane {}

/// An open file: there is none.
pub(crate) enum Source {}

impl Source {
    pub(crate) fn open(path: &Path) -> Result<Self, PictureError> {
        not_built(path)
    }

    pub(crate) fn find_plane(&self, _layer: &str, _channel: &str, _wanted: &str) -> Result<Plane, PictureError> {
        match *self {}
    }

    pub(crate) fn layer_channels(&self) -> Vec<(String, String)> {
        match *self {}
    }

    pub(crate) fn check_plane(&self, _plane: Plane, _layer: &str, _size: UVec2, _by: &str) -> Result<(), PictureError> {
        match *self {}
    }

    pub(crate) fn read_planes(self, _planes: &[Plane]) -> Result<Vec<Vec<f32>>, PictureError> {
        match self {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_names_the_feature() {
        let path = Path::new("far.exr");
        let errors = [
            write(path, UVec2::ONE, Vec::new()).err(),
            read_color(path, None).err(),
            layers(path).err(),
            Source::open(path).err(),
        ];
        for error in errors {
            let text = error.map(|error| error.to_string()).unwrap_or_default();
            assert!(text.contains("far.exr") && text.contains("--features exr"), "{text}");
        }
    }
}

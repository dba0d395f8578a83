//! Base colour textures of files.

use super::assemble::Paint;
use crate::scene::{Image, Textures};
use glam::{Vec2, uvec2};
use std::collections::HashMap;
use std::hash::Hash;

/// Alpha from which on there is a surface, where a file does not say it.
pub(super) const HALF: f32 = 0.5;

/// Textures of a file, each read once, by what the file calls them.
pub(super) struct Library<K> {
    textures: Textures,
    read: HashMap<K, Image>,
}

impl<K: Hash + Eq> Library<K> {
    pub fn new() -> Self {
        Library {
            textures: Textures::default(),
            read: HashMap::new(),
        }
    }

    /// An image that has been read.
    pub fn get(&self, key: &K) -> Option<Image> {
        self.read.get(key).copied()
    }

    /// Adds a picture, of surfaces that are there from an alpha of `cutoff` on.
    pub fn add(&mut self, key: K, picture: &image::RgbaImage, cutoff: f32) -> Result<Image, String> {
        let (texels, _) = picture.as_raw().as_chunks::<4>();
        let (first, levels) = self.textures.add(uvec2(picture.width(), picture.height()), texels)?;
        let image = Image {
            first,
            size: [picture.width(), picture.height()],
            levels,
            cutoff,
        };
        self.read.insert(key, image);
        Ok(image)
    }

    /// An image on a part.
    pub fn add_paint(&mut self, image: Image, uvs: Vec<Vec2>) -> Paint {
        let images = &mut self.textures.images;
        let number = images.iter().position(|known| *known == image).unwrap_or_else(|| {
            images.push(image);
            images.len() - 1
        });
        Paint {
            uvs,
            image: number as u32,
            size: uvec2(image.size[0], image.size[1]),
        }
    }

    pub fn finish(self) -> Textures {
        self.textures
    }
}

/// Decodes a PNG or JPEG file.
pub(super) fn decode_image(bytes: &[u8]) -> Result<image::RgbaImage, String> {
    let image = image::load_from_memory(bytes).map_err(|error| error.to_string())?;
    Ok(image.to_rgba8())
}

/// From which alpha on a picture's surface is there, where the file does not say it: 0 of one without holes.
pub(super) fn alpha_cutoff(image: &image::RgbaImage) -> f32 {
    let has_holes = image.pixels().any(|pixel| pixel.0[3] < 128);
    if has_holes { HALF } else { 0.0 }
}

//! Base colour textures, read at vertices only.

use crate::picture::srgb;
use glam::{Vec2, Vec3, vec3};

/// An image of sRGB colours that repeats in both directions.
pub(super) struct Texture(image::RgbImage);

impl Texture {
    /// Decodes a PNG or JPEG file.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        let image = image::load_from_memory(bytes).map_err(|error| error.to_string())?;
        // A file may declare an empty image.
        match image.to_rgb8() {
            image if image.width() > 0 && image.height() > 0 => Ok(Texture(image)),
            _ => Err("it has no pixels".to_owned()),
        }
    }

    /// Linear colour of the texel at `uv`: (0, 0) is the upper left corner, (1, 1) the lower right one.
    pub fn at(&self, uv: Vec2) -> Vec3 {
        let texel = |axis: f32, side: u32| ((axis.rem_euclid(1.0) * side as f32) as u32).min(side - 1);
        let [r, g, b] = self
            .0
            .get_pixel(texel(uv.x, self.0.width()), texel(uv.y, self.0.height()))
            .0
            .map(|byte| srgb::decode(f32::from(byte) / 255.0));
        vec3(r, g, b)
    }
}

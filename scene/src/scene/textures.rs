//! Textures of surfaces, as plain data that every renderer reads alike.

use crate::picture::srgb;
use bytemuck::{Pod, Zeroable};
use glam::{UVec2, Vec3, Vec4, uvec2};

/// Images that repeat over surfaces, each with all its smaller levels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Textures {
    /// Location of each image, and the alpha from which on its surface is there.
    pub images: Vec<Image>,
    /// sRGB and alpha of 8 bits each, red in the lowest: row by row, level by level, image by image.
    pub texels: Vec<u32>,
}

/// An image's place among the texels. Laid out as `Image` in `paint.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Image {
    /// Index of the first texel.
    pub first: u32,
    /// Texels across and down, of the largest level.
    pub size: [u32; 2],
    /// Each is half as wide and as high as the one before, rounded down, and at least 1.
    pub levels: u32,
    /// Alpha below which there is no surface; 0 of an image without holes.
    pub cutoff: f32,
}

/// Most texels of a scene: a quarter of a gigabyte.
const MOST: usize = 1 << 26;

impl Textures {
    /// Adds an image of `size` texels of sRGB and alpha, row by row, with its smaller levels. The number of its first texel
    /// and of its levels.
    ///
    /// # Errors
    ///
    /// It is empty, too much for a scene, or there are fewer or more texels.
    pub fn add(&mut self, size: UVec2, image: &[[u8; 4]]) -> Result<(u32, u32), String> {
        let mut size = size;
        if size.min_element() == 0 {
            return Err("it has no pixels".to_owned());
        }
        let texels = u64::from(size.x) * u64::from(size.y);
        if self.texels.len() as u64 + 2 * texels > MOST as u64 {
            return Err(format!(
                "textures of more than {} million texels are not read",
                MOST >> 20
            ));
        }
        if image.len() as u64 != texels {
            return Err(format!("it has {} texels, not {texels}", image.len()));
        }
        let first = self.texels.len();
        self.texels.extend(image.iter().copied().map(u32::from_le_bytes));
        let (mut finer, mut levels) = (first, 1);
        while size.max_element() > 1 {
            let next = self.texels.len();
            self.add_half_level(finer, size);
            size = (size / 2).max(UVec2::ONE);
            (finer, levels) = (next, levels + 1);
        }
        Ok((first as u32, levels))
    }

    /// Adds the next smaller level of one that begins at `first`: means of 2×2 texels, of those that are there.
    fn add_half_level(&mut self, first: usize, size: UVec2) {
        let half = (size / 2).max(UVec2::ONE);
        for y in 0..half.y {
            for x in 0..half.x {
                let texel = |k: u32| {
                    let at = (2 * uvec2(x, y) + uvec2(k % 2, k / 2)).min(size - 1);
                    decode_texel(self.texels[first + (at.y * size.x + at.x) as usize])
                };
                let four = [0, 1, 2, 3].map(texel);
                let alpha = four.iter().map(|t| t.w).sum::<f32>() * 0.25;
                // Absent texels have no colour; where all four are absent, any colour will do.
                let weights = four.map(|t| t.w.max(1.0e-3));
                let weighed = four.iter().zip(weights).map(|(t, w)| t.truncate() * w);
                let color = weighed.sum::<Vec3>() / weights.iter().sum::<f32>();
                self.texels.push(encode_texel(color.extend(alpha)));
            }
        }
    }
}

/// Linear colour and alpha of a texel.
pub(crate) fn decode_texel(texel: u32) -> Vec4 {
    let [r, g, b, a] = texel.to_le_bytes().map(|byte| f32::from(byte) / 255.0);
    Vec4::new(srgb::to_linear(r), srgb::to_linear(g), srgb::to_linear(b), a)
}

fn encode_texel(color: Vec4) -> u32 {
    let byte = |value: f32| (value * 255.0).round() as u8;
    let [r, g, b] = color.truncate().to_array().map(|light| byte(srgb::from_linear(light)));
    u32::from_le_bytes([r, g, b, byte(color.w)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_means_of_light_where_there_is_a_surface() {
        let mut textures = Textures::default();
        // White beside black, and below them green where there is a surface, and red where there is none.
        let bytes = [[255, 255, 255, 255], [0, 0, 0, 255], [0, 255, 0, 255], [255, 0, 0, 0]];
        assert_eq!(textures.add(uvec2(2, 2), &bytes), Ok((0, 2)));
        assert_eq!(textures.texels.len(), 5);
        let mean = decode_texel(textures.texels[4]);
        let expected = Vec4::new(1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0, 0.75);
        assert!((mean - expected).abs().max_element() < 0.01, "{mean}");
        assert_eq!(textures.add(uvec2(5, 1), &[[0; 4]; 5]), Ok((5, 3)));
        assert_eq!(textures.texels.len(), 5 + 5 + 2 + 1);
        assert!(textures.add(uvec2(0, 1), &[]).is_err());
        assert!(textures.add(uvec2(2, 1), &[[0; 4]]).is_err());
    }
}

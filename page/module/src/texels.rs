//! Pictures as a kernel reads them: linear light, rounded to what a 16-bit float holds, so that every executor reads the same.

use half::f16;

/// A picture in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// Rows from the top.
    pub texels: Vec<[f32; 4]>,
}

impl Picture {
    /// From 8-bit sRGB and alpha.
    pub fn from_srgb(size: [u32; 2], bytes: &[u8]) -> Picture {
        let table: [f32; 256] = std::array::from_fn(|k| round_to_half(srgb_to_linear(k as f32 / 255.0)));
        let texel = |p: &[u8]| {
            let colour = [p[0], p[1], p[2]].map(|byte| table[usize::from(byte)]);
            [colour[0], colour[1], colour[2], round_to_half(f32::from(p[3]) / 255.0)]
        };
        Picture {
            size,
            texels: bytes.chunks_exact(4).map(texel).collect(),
        }
    }

    /// The texel at a place; beyond the border, that of the border.
    pub fn texel_at(&self, x: i64, y: i64) -> [f32; 4] {
        let [width, height] = self.size.map(i64::from);
        let (x, y) = (x.clamp(0, width - 1), y.clamp(0, height - 1));
        self.texels[(y * width + x) as usize]
    }
}

/// Linear light of an sRGB value.
fn srgb_to_linear(value: f32) -> f32 {
    match value <= 0.04045 {
        true => value / 12.92,
        false => ((value + 0.055) / 1.055).powf(2.4),
    }
}

/// The nearest number that a 16-bit float holds.
pub fn round_to_half(value: f32) -> f32 {
    f16::from_f32(value).to_f32()
}

/// Memory layout of texels; the names are WebGPU's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelFormat {
    /// A single 32-bit float: `r32float`.
    R32,
    /// A single 16-bit float: `r16float`.
    R16,
    /// Two 16-bit floats: `rg16float`.
    Rg16,
    /// Four 16-bit floats: `rgba16float`.
    Rgba16,
    /// Four 32-bit floats: `rgba32float`.
    Rgba32,
}

impl TexelFormat {
    /// WebGPU's name.
    pub fn name(self) -> &'static str {
        match self {
            TexelFormat::R32 => "r32float",
            TexelFormat::R16 => "r16float",
            TexelFormat::Rg16 => "rg16float",
            TexelFormat::Rgba16 => "rgba16float",
            TexelFormat::Rgba32 => "rgba32float",
        }
    }

    fn components(self) -> usize {
        match self {
            TexelFormat::R32 | TexelFormat::R16 => 1,
            TexelFormat::Rg16 => 2,
            TexelFormat::Rgba16 | TexelFormat::Rgba32 => 4,
        }
    }

    /// Bytes of a texel.
    pub fn texel_bytes(self) -> usize {
        self.components() * if self.is_half() { 2 } else { 4 }
    }

    fn is_half(self) -> bool {
        !matches!(self, TexelFormat::R32 | TexelFormat::Rgba32)
    }

    /// A texel as this format holds it; components that it lacks are 0.
    pub fn round_texel(self, texel: [f32; 4]) -> [f32; 4] {
        std::array::from_fn(|k| match (k < self.components(), self.is_half()) {
            (false, _) => 0.0,
            (true, true) => round_to_half(texel[k]),
            (true, false) => texel[k],
        })
    }

    /// Adds a texel's bytes.
    pub fn write_texel(self, texel: [f32; 4], bytes: &mut Vec<u8>) {
        for value in &texel[..self.components()] {
            match self.is_half() {
                true => bytes.extend(f16::from_f32(*value).to_le_bytes()),
                false => bytes.extend(value.to_le_bytes()),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_becomes_linear_light() {
        let picture = Picture::from_srgb([2, 1], &[0, 255, 188, 255, 10, 10, 10, 0]);
        let [first, second] = picture.texels[..] else {
            panic!("two texels")
        };
        assert_eq!((first[0], first[1], first[3]), (0.0, 1.0, 1.0));
        assert!((first[2] - 0.5029).abs() < 1.0e-3, "{first:?}");
        assert!((second[0] - 10.0 / 255.0 / 12.92).abs() < 1.0e-5 && second[3] == 0.0);
    }

    #[test]
    fn formats_hold_what_they_write() {
        let mut bytes = Vec::new();
        TexelFormat::Rg16.write_texel([1.0, 0.1, 7.0, 7.0], &mut bytes);
        assert_eq!(bytes.len(), 4);
        let second = f16::from_le_bytes([bytes[2], bytes[3]]).to_f32();
        assert_eq!(
            TexelFormat::Rg16.round_texel([1.0, 0.1, 7.0, 7.0]),
            [1.0, second, 0.0, 0.0]
        );
    }
}

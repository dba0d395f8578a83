//! The colours that filters of pictures take.
//!
//! FXAA and SMAA were made for the picture that a display is sent: clamped, after tone mapping. They look for edges in its
//! luma, and what they blend depends on whether the numbers are sRGB values or light. FXAA is documented for sRGB values.
//! SMAA asks for sRGB values where it looks for edges and for light where it blends; the crate has one texture for both.
//! So each is measured with both.

use glam::{Vec3, Vec4};
use straightline_kernels::prelude::Frame;
use straightline_scene::picture::srgb;

/// Transfer function of a filter's input picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// sRGB values, perceptually even.
    Srgb,
    /// Linear light.
    Linear,
}

impl Transfer {
    /// Encodes a linear picture for the filter, each number in 0..=1. NaN becomes 0.
    pub fn encode_picture(self, linear: &Frame<Vec4>) -> Frame<Vec4> {
        map_colors(linear, |color| {
            let shown = color.map(|v| if v.is_nan() { 0.0 } else { v.clamp(0.0, 1.0) });
            match self {
                Transfer::Srgb => shown.map(srgb::from_linear),
                Transfer::Linear => shown,
            }
        })
    }

    /// Decodes a filter's result to linear light.
    pub fn decode_picture(self, filtered: &Frame<Vec4>) -> Frame<Vec4> {
        match self {
            Transfer::Srgb => map_colors(filtered, |color| color.map(|v| srgb::to_linear(v.clamp(0.0, 1.0)))),
            Transfer::Linear => filtered.clone(),
        }
    }
}

fn map_colors(frame: &Frame<Vec4>, change: impl Fn(Vec3) -> Vec3) -> Frame<Vec4> {
    let texels = frame.texels().iter().map(|t| change(t.truncate()).extend(t.w));
    Frame::new(frame.size(), texels.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{uvec2, vec4};

    #[test]
    fn there_and_back_gives_what_a_display_shows() {
        let picture = Frame::new(
            uvec2(2, 1),
            vec![vec4(0.2, 7.0, f32::NAN, 1.0), vec4(0.5, -1.0, 1.0, 0.5)],
        );
        for transfer in [Transfer::Srgb, Transfer::Linear] {
            let back = transfer.decode_picture(&transfer.encode_picture(&picture));
            let expected = [vec4(0.2, 1.0, 0.0, 1.0), vec4(0.5, 0.0, 1.0, 0.5)];
            for (found, expected) in back.texels().iter().zip(expected) {
                assert!((*found - expected).abs().max_element() < 1e-6, "{found} {expected}");
            }
        }
        assert!((Transfer::Srgb.encode_picture(&picture).texels()[0].x - 0.484_529).abs() < 1e-5);
    }
}

//! Two pictures as a display shows them.

use glam::{Vec3, Vec4};
use straightline_kernels::prelude::Frame;
use straightline_scene::picture::srgb;

/// Two pictures in sRGB, each red, green and blue in 0..=1.
pub(super) struct Shown {
    pub test: Vec<Vec3>,
    pub reference: Vec<Vec3>,
    /// Pixels that are not finite in one of the pictures. There the two are as far apart as can be.
    pub bad: Vec<usize>,
}

/// Clamps and encodes both pictures.
pub(super) fn encode_for_display(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> Shown {
    assert_eq!(test.size(), reference.size(), "pictures of one size");
    let mut shown = Shown {
        test: Vec::with_capacity(test.texels().len()),
        reference: Vec::with_capacity(test.texels().len()),
        bad: Vec::new(),
    };
    for (index, (test, reference)) in test.texels().iter().zip(reference.texels()).enumerate() {
        let (test, reference) = (test.truncate(), reference.truncate());
        let encoded = |color: Vec3| color.clamp(Vec3::ZERO, Vec3::ONE).map(srgb::from_linear);
        let right = if reference.is_finite() {
            encoded(reference)
        } else {
            Vec3::ZERO
        };
        shown.reference.push(right);
        if test.is_finite() && reference.is_finite() {
            shown.test.push(encoded(test));
        } else {
            // The colour that differs most from the reference's, so that the errors of neighbouring pixels see the bad one too.
            shown.test.push(right.map(|value| if value > 0.5 { 0.0 } else { 1.0 }));
            shown.bad.push(index);
        }
    }
    shown
}

//! Results of kernels as colours. The generator reads this text too: it is of the kernel language.

use glam::{Vec2, Vec3, Vec4};

/// Values that a picture shows: a grey, red and green, a colour, or a colour with alpha.
pub trait Color {
    /// The colour of linear RGB, and alpha.
    fn into_color(self) -> Vec4;
}

impl Color for f32 {
    fn into_color(self) -> Vec4 {
        Vec4::new(self, self, self, 1.0)
    }
}

impl Color for Vec2 {
    fn into_color(self) -> Vec4 {
        Vec4::new(self.x, self.y, 0.0, 1.0)
    }
}

impl Color for Vec3 {
    fn into_color(self) -> Vec4 {
        self.extend(1.0)
    }
}

impl Color for Vec4 {
    fn into_color(self) -> Vec4 {
        self
    }
}

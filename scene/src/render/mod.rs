//! The deferred testbed: a scene's geometry and colour at any place of a pixel, on a GPU or on the CPU.
//!
//! Both renderers rasterise depth, normal, colour and material to a G-buffer (paper §3.4: the projection is shifted
//! by the sample's offset), then shade from that alone. What they draw agrees but for pixels whose sample lies
//! within a rounding of a triangle's edge.

mod aggregate;
mod captured;
mod cpu;
mod demodulated;
mod error;
mod extra;
mod frame;
mod gpu;
mod guide;
mod lamps;
mod paint;
mod patterns;
mod placed;
mod reference;
mod shade;
mod shifted;
#[cfg(test)]
mod tests;

use crate::scene::{Camera, SKY_DEPTH};
use glam::{UVec2, Vec2, Vec3, Vec4};
use straightline_kernels::prelude::Frame;

pub use aggregate::{Aggregate, Aggregated, render_aggregated};
pub use captured::{capture_placed, capture_scene};
pub use cpu::CpuRenderer;
pub use demodulated::add_albedo;
pub use error::RenderError;
pub use extra::{Extra, listing_options, shade_extra};
pub use gpu::guard::with_error_scope;
pub use gpu::{FramePass, FramePasses, GpuRenderer, Listed, MultisampledGeometry, Samples, Timestamps};
pub use guide::add_guide;
pub(crate) use placed::{OFFSETS, gather_placed, shade_placed_aside};
pub use placed::{Placed, PlacedBy, shade_placed};
pub use reference::{grid_offsets, render_reference};
pub use shade::{GuideLight, Surface};
pub use shifted::Shifted;

/// Draws one scene at one size, sampled anywhere in a pixel.
///
/// An `offset` is in pixels from each pixel's centre, x to the right, y down. Usually each axis is in -0.5..=0.5; any
/// finite offset works, and a whole number shifts the picture.
pub trait Renderer: Sync {
    /// Width and height of what is drawn, in pixels.
    fn size(&self) -> UVec2;

    /// Returns the camera that sees the scene.
    fn camera(&self) -> Camera;

    /// Geometry seen `offset` from each pixel's centre: linear depth along the view direction in scene units, and
    /// the unit normal in view space, on the side that is seen. The sky is at [`SKY_DEPTH`]
    /// and has the normal (0, 0, 1).
    ///
    /// # Errors
    ///
    /// [`RenderError::Offset`] if `offset` is not finite; [`RenderError::Device`].
    fn draw_geometry(&self, offset: Vec2) -> Result<(Frame<f32>, Frame<Vec3>), RenderError>;

    /// Linear colour of each pixel shaded `offset` from its centre. RGB is in 0..=1 but on what is polished or shines by
    /// itself ([`Material::Glossy`](crate::scene::Material::Glossy), [`Material::Emissive`](crate::scene::Material::Emissive)):
    /// there, and on everything in a scene with lamps, it goes up to 65504, the largest half. Alpha is 1.
    ///
    /// # Errors
    ///
    /// As [`draw_geometry`](Self::draw_geometry).
    fn draw_shaded(&self, offset: Vec2) -> Result<Frame<Vec4>, RenderError>;

    /// All that a G-buffer holds of what is seen `offset` from each pixel's centre, row by row from the top.
    ///
    /// # Errors
    ///
    /// As [`draw_geometry`](Self::draw_geometry).
    fn draw_surfaces(&self, offset: Vec2) -> Result<Vec<Surface>, RenderError>;

    /// Linear colour of a surface that is seen `place` pixels from the picture's upper left corner, as [`draw_shaded`](Self::draw_shaded) has
    /// it.
    fn shade_surface(&self, surface: &Surface, place: Vec2) -> Vec3;

    /// Returns the albedo, and the share of the sun's light in alpha, of a surface that is seen `place` pixels from the
    /// picture's upper left corner: see [`draw_albedo`](Self::draw_albedo). Filters that take light apart from paint and shadow read
    /// these.
    fn surface_paint(&self, surface: &Surface, place: Vec2) -> Vec4;

    /// Linear RGB that the sun adds to [`shade_surface`](Self::shade_surface) of a surface where no shadow falls.
    fn direct_light(&self, surface: &Surface, place: Vec2) -> Vec3;

    /// Returns a cheap estimate of [`shade_surface`](Self::shade_surface), as `guide=add` needs it: the albedo times the sun's light
    /// where no shadow falls and one constant of ambient light, the sun's highlight, the light that the surface emits, and haze. In
    /// the sky it is the sky's colour.
    fn guide(&self, surface: &Surface, place: Vec2) -> Vec3 {
        self.guide_by(GuideLight::default(), surface, place)
    }

    /// [`guide`](Self::guide) that knows less or more of the light.
    fn guide_by(&self, known: GuideLight, surface: &Surface, place: Vec2) -> Vec3;

    /// Albedo of what is seen `offset` from each pixel's centre, linear RGB, and in alpha the share of the sun's light that no
    /// shadow keeps away. Of what shines by itself the albedo is what it shines with; of the sky 1.
    ///
    /// # Errors
    ///
    /// As [`draw_geometry`](Self::draw_geometry).
    fn draw_albedo(&self, offset: Vec2) -> Result<Frame<Vec4>, RenderError> {
        demodulated::map_surfaces(self, offset, |surface, place| self.surface_paint(surface, place))
    }

    /// Draws the light that the sun adds to [`draw_shaded`](Self::draw_shaded) at `offset` where no shadow falls: linear RGB, alpha 0.
    ///
    /// # Errors
    ///
    /// As [`draw_geometry`](Self::draw_geometry).
    fn draw_sunlight(&self, offset: Vec2) -> Result<Frame<Vec4>, RenderError> {
        demodulated::map_surfaces(self, offset, |surface, place| {
            self.direct_light(surface, place).extend(0.0)
        })
    }

    /// Linear RGB of [`shade_surface`](Self::shade_surface) that does not follow the albedo: highlights and haze. Of the sky 0, whose albedo is 1.
    fn unpainted_light(&self, surface: &Surface, place: Vec2) -> Vec3 {
        match surface.depth >= SKY_DEPTH {
            true => Vec3::ZERO,
            // Black paint has nothing else.
            false => self.shade_surface(
                &Surface {
                    color: Vec3::ZERO,
                    ..*surface
                },
                place,
            ),
        }
    }

    /// Draws the part of [`draw_shaded`](Self::draw_shaded) at `offset` that does not follow the albedo: linear RGB, alpha 0.
    ///
    /// # Errors
    ///
    /// As [`draw_geometry`](Self::draw_geometry).
    fn draw_unpainted(&self, offset: Vec2) -> Result<Frame<Vec4>, RenderError> {
        demodulated::map_surfaces(self, offset, |surface, place| {
            self.unpainted_light(surface, place).extend(0.0)
        })
    }

    /// Mean of the pictures shaded at each of `offsets`.
    ///
    /// # Errors
    ///
    /// As [`draw_geometry`](Self::draw_geometry), and [`RenderError::NoOffsets`] if there are none.
    fn draw_mean(&self, offsets: &[Vec2]) -> Result<Frame<Vec4>, RenderError> {
        check_offsets(offsets)?;
        reference::mean_of(self, offsets)
    }
}

/// Refuses no offsets at all, and those that are not numbers.
fn check_offsets(offsets: &[Vec2]) -> Result<(), RenderError> {
    if offsets.is_empty() {
        return Err(RenderError::NoOffsets);
    }
    match offsets.iter().find(|offset| !offset.is_finite()) {
        Some(offset) => Err(RenderError::Offset { offset: *offset }),
        None => Ok(()),
    }
}

//! A picture that is moved by some pixels.

use super::{GuideLight, RenderError, Renderer, Surface};
use crate::scene::Camera;
use glam::{UVec2, Vec2, Vec3, Vec4};
use straightline_kernels::prelude::Frame;

/// Draws with the camera turned by some pixels.
pub struct Shifted<'a> {
    /// Renderer that draws.
    pub renderer: &'a dyn Renderer,
    /// Offset in pixels, y down.
    pub by: Vec2,
}

impl Renderer for Shifted<'_> {
    fn size(&self) -> UVec2 {
        self.renderer.size()
    }

    fn camera(&self) -> Camera {
        self.renderer.camera()
    }

    fn draw_geometry(&self, offset: Vec2) -> Result<(Frame<f32>, Frame<Vec3>), RenderError> {
        self.renderer.draw_geometry(offset + self.by)
    }

    fn draw_shaded(&self, offset: Vec2) -> Result<Frame<Vec4>, RenderError> {
        self.renderer.draw_shaded(offset + self.by)
    }

    fn draw_surfaces(&self, offset: Vec2) -> Result<Vec<Surface>, RenderError> {
        self.renderer.draw_surfaces(offset + self.by)
    }

    fn shade_surface(&self, surface: &Surface, place: Vec2) -> Vec3 {
        self.renderer.shade_surface(surface, place + self.by)
    }

    fn surface_paint(&self, surface: &Surface, place: Vec2) -> Vec4 {
        self.renderer.surface_paint(surface, place + self.by)
    }

    fn direct_light(&self, surface: &Surface, place: Vec2) -> Vec3 {
        self.renderer.direct_light(surface, place + self.by)
    }

    fn guide_by(&self, known: GuideLight, surface: &Surface, place: Vec2) -> Vec3 {
        self.renderer.guide_by(known, surface, place + self.by)
    }
}

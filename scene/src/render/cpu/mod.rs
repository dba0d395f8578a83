//! A software rasteriser, for machines without an adapter.

mod clip;
mod raster;

use super::frame::{Lighting, Pass};
use super::paint::sample_texture;
use super::shade::{GuideLight, Surface, direct_light, guide, shade_surface, surface_paint};
use super::{RenderError, Renderer, patterns};
use crate::scene::{Camera, Image, Material, Scene, Vertex};
use clip::ScreenTriangle;
use glam::{Mat3, UVec2, Vec2, Vec3, Vec4, uvec2, vec2};
use raster::Visible;
use rayon::prelude::*;
use straightline_kernels::prelude::Frame;

/// Widest and tallest picture, in pixels: beyond it, screen coordinates leave their 32 bits.
const MAX_SIDE: u32 = 16_384;

/// Rows that one task draws.
const BAND: u32 = 16;

/// Draws on the processor, on all threads of rayon's pool. Needs no device.
#[derive(Clone, Debug)]
pub struct CpuRenderer {
    scene: Scene,
    size: UVec2,
    lighting: Lighting,
}

impl CpuRenderer {
    /// A renderer of `scene` in pictures of `size` pixels.
    ///
    /// # Errors
    ///
    /// [`RenderError::Scene`] if [`Scene::check`] refuses it, [`RenderError::Size`] unless each side is 1 to 16384.
    pub fn new(scene: &Scene, size: UVec2) -> Result<Self, RenderError> {
        scene.check()?;
        if size.min_element() == 0 || size.max_element() > MAX_SIDE {
            return Err(RenderError::Size { size, most: MAX_SIDE });
        }
        Ok(CpuRenderer {
            scene: scene.clone(),
            size,
            lighting: Lighting::new(scene, size),
        })
    }

    /// Draws what is seen at `offset` from each pixel's centre, and makes of each pixel what `finish` says.
    fn draw_pixels<T: Copy + Default + Send>(
        &self,
        offset: Vec2,
        finish: impl Fn(&Pass, UVec2, &Surface) -> T + Sync,
    ) -> Vec<T> {
        let pass = Pass::new(&self.scene.camera, self.size, offset);
        let triangles = self.project(&pass);
        let bands = raster::bin_triangles(&triangles, self.size.y.div_ceil(BAND), BAND);
        let width = self.size.x as usize;
        let mut pixels = vec![T::default(); width * self.size.y as usize];
        let rows = pixels.par_chunks_mut(width * BAND as usize).zip(bands).enumerate();
        rows.for_each(|(band, (pixels, inside))| {
            let top = band as u32 * BAND;
            let band = uvec2(self.size.x, (pixels.len() / width) as u32);
            let holes = |triangle| self.coverage_test(&pass, triangle);
            let visible = Visible::draw(&triangles, &inside, top, band, self.size, holes);
            for (at, pixel) in pixels.iter_mut().enumerate() {
                let place = uvec2((at % width) as u32, top + (at / width) as u32);
                let surface = match visible.triangle_at(at) {
                    Some(triangle) => self.surface(&pass, &triangles[triangle], place),
                    None => Surface::SKY,
                };
                *pixel = finish(&pass, place, &surface);
            }
        });
        pixels
    }

    /// Of an alpha-tested triangle, where it is there; `None` for all others.
    fn coverage_test<'a>(
        &'a self,
        pass: &'a Pass,
        triangle: &'a ScreenTriangle,
    ) -> Option<impl Fn(UVec2) -> bool + 'a> {
        let corners = self.corners(triangle);
        let cutoff = self.image(corners).map_or(0.0, |image| image.cutoff);
        let is_fence = corners[0].material == Material::ChainLink as u32;
        let there = move |pixel| {
            let shares = triangle.corner_shares(pixel, self.size).as_vec3();
            if is_fence {
                let [a, b, c] = corners.map(|corner| Vec3::from(corner.position));
                if !patterns::is_wire(a * shares.x + b * shares.y + c * shares.z) {
                    return false;
                }
            }
            self.texture_color(pass, triangle, pixel, self.normal(pass, corners, shares))
                .w
                >= cutoff
        };
        (is_fence || cutoff > 0.0).then_some(there)
    }

    fn corners(&self, triangle: &ScreenTriangle) -> [&Vertex; 3] {
        self.scene.triangles[triangle.source as usize].map(|i| &self.scene.vertices[i as usize])
    }

    fn image(&self, corners: [&Vertex; 3]) -> Option<&Image> {
        let number = corners[0].texture.checked_sub(1)?;
        self.scene.textures.images.get(number as usize)
    }

    /// Of the side that normals point to, in view space.
    fn normal(&self, pass: &Pass, corners: [&Vertex; 3], shares: Vec3) -> Vec3 {
        let normal = Mat3::from_mat4(pass.to_view) * mix(corners.map(|vertex| vertex.normal), shares);
        normal.normalize_or(Vec3::Z)
    }

    /// Colour and alpha of a triangle's texture at `pixel`: white without one.
    fn texture_color(&self, pass: &Pass, triangle: &ScreenTriangle, pixel: UVec2, normal: Vec3) -> Vec4 {
        let corners = self.corners(triangle);
        let Some(number) = corners[0].texture.checked_sub(1) else {
            return Vec4::ONE;
        };
        let shares = triangle.corner_shares(pixel, self.size).as_vec3();
        let [u, v, density] = mix(corners.map(|c| [c.uv[0], c.uv[1], c.density]), shares).to_array();
        let footprint = self.footprint(pass, pixel, shares.dot(triangle.depths), normal);
        sample_texture(&self.scene.textures, number, vec2(u, v), footprint * density)
    }

    /// Returns the units of a surface to a pixel.
    fn footprint(&self, pass: &Pass, pixel: UVec2, depth: f32, normal: Vec3) -> f32 {
        let along = pass.ray(&self.lighting, pixel).along.normalize();
        self.lighting.pixel_size(depth) / normal.dot(along).abs().max(0.05)
    }

    /// Every triangle that may be seen, in order.
    fn project(&self, pass: &Pass) -> Vec<ScreenTriangle> {
        let corner = |vertex: &Vertex| {
            let place = Vec3::from(vertex.position).extend(1.0);
            (pass.to_clip * place, -(pass.to_view * place).z)
        };
        let corners: Vec<(Vec4, f32)> = self.scene.vertices.par_iter().map(corner).collect();
        let triangles = self.scene.triangles.par_iter().enumerate();
        triangles
            .flat_map_iter(|(source, triangle)| {
                let corners = triangle.map(|index| corners[index as usize]);
                let depths = corners.map(|(_, depth)| depth).into();
                clip::project_triangle(source as u32, corners.map(|(clip, _)| clip), depths, self.size)
            })
            .collect()
    }

    /// Returns the surface of `triangle` at `pixel`.
    fn surface(&self, pass: &Pass, triangle: &ScreenTriangle, pixel: UVec2) -> Surface {
        let shares = triangle.corner_shares(pixel, self.size).as_vec3();
        let corners = self.corners(triangle);
        let mut normal = self.normal(pass, corners, shares);
        let paint = self.texture_color(pass, triangle, pixel, normal).truncate();
        let (depth, material) = (shares.dot(triangle.depths), corners[0].material);
        if material == Material::Studded as u32 {
            let place = mix(corners.map(|corner| corner.position), shares);
            let slope = patterns::studs(place, self.footprint(pass, pixel, depth, normal));
            normal = patterns::tilted(normal, pass.to_view.transform_vector3(slope));
        }
        Surface {
            normal: if triangle.front { normal } else { -normal },
            depth,
            color: mix(corners.map(|vertex| vertex.color), shares) * paint,
            material: material as f32,
        }
    }
}

/// Interpolates attributes of corners by their shares.
fn mix([a, b, c]: [[f32; 3]; 3], shares: Vec3) -> Vec3 {
    Vec3::from(a) * shares.x + Vec3::from(b) * shares.y + Vec3::from(c) * shares.z
}

impl Renderer for CpuRenderer {
    fn size(&self) -> UVec2 {
        self.size
    }

    fn camera(&self) -> Camera {
        self.scene.camera
    }

    fn draw_geometry(&self, offset: Vec2) -> Result<(Frame<f32>, Frame<Vec3>), RenderError> {
        super::check_offsets(&[offset])?;
        let pixels = self.draw_pixels(offset, |_, _, surface| (surface.depth, surface.normal));
        let (depth, normal) = pixels.into_iter().unzip();
        Ok((Frame::new(self.size, depth), Frame::new(self.size, normal)))
    }

    fn draw_shaded(&self, offset: Vec2) -> Result<Frame<Vec4>, RenderError> {
        super::check_offsets(&[offset])?;
        let pixels = self.draw_pixels(offset, |pass, pixel, surface| {
            shade_surface(&self.lighting, surface, pass.ray(&self.lighting, pixel)).extend(1.0)
        });
        Ok(Frame::new(self.size, pixels))
    }

    fn draw_surfaces(&self, offset: Vec2) -> Result<Vec<Surface>, RenderError> {
        super::check_offsets(&[offset])?;
        let seen = self.draw_pixels(offset, |_, _, surface| Some(*surface));
        Ok(seen
            .into_iter()
            .map(|surface| surface.unwrap_or(Surface::SKY))
            .collect())
    }

    fn shade_surface(&self, surface: &Surface, place: Vec2) -> Vec3 {
        shade_surface(&self.lighting, surface, self.lighting.ray(place, self.size))
    }

    fn surface_paint(&self, surface: &Surface, place: Vec2) -> Vec4 {
        surface_paint(&self.lighting, surface, self.lighting.ray(place, self.size))
    }

    fn direct_light(&self, surface: &Surface, place: Vec2) -> Vec3 {
        direct_light(&self.lighting, surface, self.lighting.ray(place, self.size))
    }

    fn guide_by(&self, known: GuideLight, surface: &Surface, place: Vec2) -> Vec3 {
        guide(&self.lighting, surface, self.lighting.ray(place, self.size), known)
    }
}

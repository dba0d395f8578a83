//! Pictures in time: what a filter reads of the frames before, with where all that is seen has moved since.
//!
//! A [`Moment`] is one frame, shaded once a pixel at a place of its own. Of two moments whose scenes differ in where their vertices
//! and their cameras are, [`motion`] says where each pixel's surface was.

use crate::capture::{Capture, ShadingSample};
use crate::execute::Inputs;
use crate::render::{self, CpuRenderer, RenderError, Renderer};
use crate::scene::{SKY_DEPTH, Scene};
use glam::{Mat3, UVec2, Vec2, Vec3, Vec4, uvec2, vec2, vec3};
use rayon::prelude::*;
use straightline_kernels::prelude::{Frame, FrameLayers};

/// Where frames are shaded, one after the other and then again from the first, in pixels from the centre: four places that share no
/// row and no column of four.
pub const PLACES: [Vec2; 4] = [
    vec2(-0.125, -0.375),
    vec2(0.125, 0.375),
    vec2(-0.375, 0.125),
    vec2(0.375, -0.125),
];

/// One frame.
pub struct Moment {
    renderer: CpuRenderer,
    scene: Scene,
    jitter: Vec2,
    color: Frame<Vec4>,
    depth: Frame<f32>,
    normal: Frame<Vec3>,
}

impl Moment {
    /// A scene shaded `jitter` from the centre of each pixel.
    ///
    /// # Errors
    ///
    /// What the renderer refuses.
    pub fn draw(scene: Scene, size: UVec2, jitter: Vec2) -> Result<Moment, RenderError> {
        let renderer = CpuRenderer::new(&scene, size)?;
        let color = renderer.shaded(jitter)?;
        let (depth, normal) = renderer.geometry(jitter)?;
        Ok(Moment {
            renderer,
            scene,
            jitter,
            color,
            depth,
            normal,
        })
    }

    /// Who draws it.
    pub fn renderer(&self) -> &CpuRenderer {
        &self.renderer
    }

    /// What a filter reads of this frame alone: geometry at `samples`, and as that of the centre the geometry where it is shaded.
    ///
    /// # Errors
    ///
    /// What the renderer refuses.
    pub fn capture(&self, samples: &[Vec2]) -> Result<Capture, RenderError> {
        let mut capture = render::capture(&self.renderer, samples, ShadingSample::Centre)?;
        let (mut depth, mut normal) = (capture.depth.layers().to_vec(), Vec::new());
        depth[samples.len()] = self.depth.clone();
        for layer in capture.normal.iter().flat_map(|normal| normal.layers()) {
            normal.push(layer.clone());
        }
        normal[samples.len()] = self.normal.clone();
        capture.depth = FrameLayers::new(depth);
        capture.normal = Some(FrameLayers::new(normal));
        capture.color = self.color.clone();
        Ok(capture)
    }

    /// `inputs` of this frame with all that `history` reads of `earlier` ones.
    ///
    /// # Errors
    ///
    /// What the renderer refuses.
    pub fn with_history(&self, inputs: Inputs, earlier: &[&Moment]) -> Result<Inputs, RenderError> {
        let (mut surfaces, mut motions) = (Vec::new(), Vec::new());
        for then in earlier {
            surfaces.push(then.surfaces_seen_by(self));
            motions.push(motion(self, then)?);
        }
        let colors = earlier.iter().map(|then| then.color.clone()).collect();
        let inputs = inputs
            .layers("history_color", colors)
            .layers("history_surface", surfaces)
            .layers("history_motion", motions);
        Ok(inputs.uniform("jitter", &self.jitter.to_array().map(f64::from)))
    }

    /// Normals, in view space of `now`, and depths of this frame.
    fn surfaces_seen_by(&self, now: &Moment) -> Frame<Vec4> {
        let turned = Mat3::from_mat4(now.scene.camera.view()) * Mat3::from_mat4(self.scene.camera.view()).transpose();
        let pairs = self.normal.texels().iter().zip(self.depth.texels());
        let texel = |(normal, depth): (&Vec3, &f32)| match *depth < SKY_DEPTH {
            // Sky has the same normal whatever way one looks.
            true => (turned * *normal).extend(*depth),
            false => normal.extend(*depth),
        };
        Frame::new(self.color.size(), pairs.map(texel).collect())
    }
}

/// Where the surface at each pixel's shading sample was: x and y in pixels of the raster of `then`, less where it is now in the
/// raster without jitter; in z the linear depth of then less that of now, and in w 0. Not a number of what then lay behind the camera.
///
/// Both moments have the same vertices, in the same order, at other places.
///
/// # Errors
///
/// What the renderer refuses.
pub fn motion(now: &Moment, then: &Moment) -> Result<Frame<Vec4>, RenderError> {
    // Colours of vertices are carried across a triangle as their places are: here the way back to where they were.
    let mut carried = now.scene.clone();
    for (vertex, then) in carried.vertices.iter_mut().zip(&then.scene.vertices) {
        vertex.color = (Vec3::from(then.position) - Vec3::from(vertex.position)).into();
        vertex.texture = 0;
    }
    let size = now.renderer.size();
    let surfaces = CpuRenderer::new(&carried, size)?.surfaces(now.jitter)?;
    let to_world = Mat3::from_mat4(now.scene.camera.view()).transpose();
    let to_view = Mat3::from_mat4(then.scene.camera.view());
    let back = Vec3::from(now.scene.camera.position) - Vec3::from(then.scene.camera.position);
    let projection = then.scene.camera.projection(size, then.jitter);
    let half = now.scene.camera.half_extent(size);
    let texels = surfaces.par_iter().enumerate().map(|(k, surface)| {
        let pixel = uvec2(k as u32 % size.x, k as u32 / size.x).as_vec2() + 0.5;
        let is_sky = surface.depth >= SKY_DEPTH;
        let at = (pixel + now.jitter) / size.as_vec2() * 2.0 - 1.0;
        let towards = to_world * vec3(at.x * half.x, -at.y * half.y, -1.0);
        let from_camera = match is_sky {
            // Infinitely far away: only where the camera looks counts.
            true => towards,
            false => towards * surface.depth + surface.color + back,
        };
        let clip = projection * (to_view * from_camera).extend(1.0);
        if clip.w <= 0.0 {
            return Vec4::splat(f32::NAN);
        }
        let raster = (vec2(clip.x, -clip.y) / clip.w * 0.5 + 0.5) * size.as_vec2();
        let deeper = if is_sky { 0.0 } else { clip.w - surface.depth };
        (raster - pixel - now.jitter).extend(deeper).extend(0.0)
    });
    Ok(Frame::new(size, texels.collect()))
}

#[cfg(test)]
mod tests;

//! Pictures in time: what a filter reads of the frames before, with where all that is seen has moved since.
//!
//! A [`Moment`] is one frame, shaded once a pixel at a place of its own. Of two moments whose scenes differ in where their
//! vertices and their cameras are, [`motion_vectors`] says where each pixel's surface was.

use crate::capture::{Capture, ShadingSample};
use crate::gbuffer::{self, GBufferError};
use crate::inputs::Inputs;
use crate::render::{self, CpuRenderer, GuideLight, PlacedBy, RenderError, Renderer, Shifted, gather_placed};
use crate::scene::{SKY_DEPTH, Scene};
use glam::{Mat3, UVec2, Vec2, Vec3, Vec4, uvec2, vec2, vec3};
use rayon::prelude::*;
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::Frame;

/// Shading places of frames, one after the other and then again from the first, in pixels from the centre: four places that
/// share no row and no column of four.
pub const PLACES: [Vec2; 4] = [
    vec2(-0.125, -0.375),
    vec2(0.125, 0.375),
    vec2(-0.375, 0.125),
    vec2(0.375, -0.125),
];

/// The least albedo that light is what colours are divided by: the kernel's default of `albedo-floor`.
const ALBEDO_FLOOR: f32 = 0.04;

/// A frame of the sequence.
pub struct Moment {
    renderer: CpuRenderer,
    scene: Scene,
    jitter: Vec2,
    capture: Capture,
    /// Differences from the guide, if a filter has one.
    differences: Option<Frame<Vec4>>,
}

impl Moment {
    /// A scene shaded once a pixel, `jitter` from its centre or, if `placed`, at one of `samples` where geometry asks for it.
    /// The geometry that its capture has of the centre is that at `jitter`.
    ///
    /// # Errors
    ///
    /// What the renderer refuses.
    pub fn draw(
        scene: Scene,
        size: UVec2,
        jitter: Vec2,
        samples: &[Vec2],
        placed: Option<PlacedBy>,
    ) -> Result<Moment, RenderError> {
        let renderer = CpuRenderer::new(&scene, size)?;
        let moved = Shifted {
            renderer: &renderer,
            by: jitter,
        };
        let from_there: Vec<Vec2> = samples.iter().map(|at| *at - jitter).collect();
        let mut capture = render::capture_scene(&moved, &from_there, ShadingSample::Centre)?;
        capture.samples = samples.to_vec();
        if let Some(by) = placed {
            let samples = samples.len();
            let placed = render::shade_placed_aside(&capture, &moved, by, jitter)?;
            let placed = placed.ok_or(RenderError::Unnamed { samples })?;
            capture.shading = ShadingSample::Placed;
            capture.color = placed.color;
            capture.place = Some(placed.place);
        }
        Ok(Moment {
            renderer,
            scene,
            jitter,
            capture,
            differences: None,
        })
    }

    /// Adds albedo, and the part of the colour that does not follow it: a filter is given light of earlier frames that have
    /// them.
    ///
    /// # Errors
    ///
    /// What the renderer refuses.
    pub fn with_albedo(self) -> Result<Moment, RenderError> {
        self.with_more(render::add_albedo)
    }

    /// Adds the guide, and for later frames the differences from it that a filter with these options reads.
    ///
    /// # Errors
    ///
    /// The renderer's refusals; [`GBufferError`] if the options do not suit the capture.
    pub fn with_guide<E>(self, options: &OptionValues) -> Result<Moment, E>
    where
        E: From<RenderError> + From<GBufferError>,
    {
        let mut guided =
            self.with_more(|capture, renderer| render::add_guide(capture, renderer, GuideLight::default()))?;
        guided.differences = Some(gbuffer::guide_differences(&guided.capture, options)?);
        Ok(guided)
    }

    /// Adds something at every geometry sample, whose places `add` reads in the moved picture.
    fn with_more(
        mut self,
        add: fn(&mut Capture, &dyn Renderer) -> Result<(), RenderError>,
    ) -> Result<Moment, RenderError> {
        let moved = Shifted {
            renderer: &self.renderer,
            by: self.jitter,
        };
        let samples = self.capture.samples.clone();
        self.capture.samples = samples.iter().map(|at| *at - self.jitter).collect();
        add(&mut self.capture, &moved)?;
        self.capture.samples = samples;
        Ok(self)
    }

    /// Returns the renderer of the frame.
    pub fn renderer(&self) -> &CpuRenderer {
        &self.renderer
    }

    /// Returns the inputs of a filter from this frame alone.
    pub fn capture(&self) -> &Capture {
        &self.capture
    }

    /// `inputs` of this frame with all that `history` reads of `earlier` ones.
    ///
    /// # Errors
    ///
    /// What the renderer refuses.
    pub fn with_history(&self, inputs: Inputs, earlier: &[&Moment]) -> Result<Inputs, RenderError> {
        let motions: Result<Vec<_>, _> = earlier.iter().map(|then| motion_vectors(self, then)).collect();
        let surfaces = earlier.iter().map(|then| then.surfaces_seen_by(self)).collect();
        let rests: Option<Vec<_>> = earlier.iter().map(|then| then.capture.rest.clone()).collect();
        let inputs = inputs
            .with_layers("history_color", earlier.iter().map(|then| then.kept_light()).collect())
            .with_layers("history_surface", surfaces)
            .with_layers("history_motion", motions?)
            .with_layers(
                "history_place",
                earlier.iter().map(|then| then.moved_places()).collect(),
            )
            .with_uniform("jitter", &self.jitter.to_array().map(f64::from));
        Ok(match rests {
            Some(rests) => inputs.with_layers("history_rest", rests),
            None => inputs,
        })
    }

    /// The layer of the capture in whose place pixel `k` is shaded.
    fn shaded_layer(&self, k: usize) -> usize {
        let centre = self.capture.samples.len();
        let chosen = self.capture.place.as_ref();
        chosen.map_or(centre, |chosen| chosen.texels()[k] as usize)
    }

    /// Offset of each pixel's shading sample from `jitter`, in x and y.
    fn moved_places(&self) -> Frame<Vec4> {
        let texel = |k| match self.capture.samples.get(self.shaded_layer(k)) {
            Some(sample) => (*sample - self.jitter).extend(0.0).extend(0.0),
            None => Vec4::ZERO,
        };
        let pixels = self.capture.color.texels().len();
        Frame::new(self.capture.size, (0..pixels).map(texel).collect())
    }

    /// Colours of the frame; light if its albedo is known, and differences if its guide is.
    fn kept_light(&self) -> Frame<Vec4> {
        if let Some(differences) = &self.differences {
            return differences.clone();
        }
        let Capture {
            albedo, rest, color, ..
        } = &self.capture;
        let (Some(albedo), Some(rest)) = (albedo, rest) else {
            return color.clone();
        };
        let light = |(k, color): (usize, &Vec4)| {
            let albedo = albedo.layers()[self.shaded_layer(k)].texels()[k].truncate();
            let painted = color.truncate() - rest.texels()[k].truncate();
            (painted / albedo.max(Vec3::splat(ALBEDO_FLOOR))).extend(color.w)
        };
        Frame::new(color.size(), color.texels().iter().enumerate().map(light).collect())
    }

    /// Normals, in view space of `now`, and depths of what this frame shows where it is shaded.
    fn surfaces_seen_by(&self, now: &Moment) -> Frame<Vec4> {
        let turned = Mat3::from_mat4(now.scene.camera.view()) * Mat3::from_mat4(self.scene.camera.view()).transpose();
        let texel = |k: usize| {
            let depth = self.capture.depth.layers()[self.shaded_layer(k)].texels()[k];
            let normals = self
                .capture
                .normal
                .as_ref()
                .map(|normals| normals.layers()[self.shaded_layer(k)].texels()[k]);
            let normal = normals.unwrap_or(Vec3::Z);
            match depth < SKY_DEPTH {
                // Sky has the same normal whatever way one looks.
                true => (turned * normal).extend(depth),
                false => normal.extend(depth),
            }
        };
        let texels = (0..self.capture.color.texels().len()).map(texel);
        Frame::new(self.capture.size, texels.collect())
    }
}

/// Returns the motion of the surface at each pixel's shading sample: in x and y its place in pixels of the raster of `then`,
/// less its place now in the raster without jitter; in z the linear depth of then less that of now, and in w 0. Not a number of
/// a surface that then lay behind the camera.
///
/// Both moments have the same vertices, in the same order, at other places.
///
/// # Errors
///
/// What the renderer refuses.
pub fn motion_vectors(now: &Moment, then: &Moment) -> Result<Frame<Vec4>, RenderError> {
    // Colours of vertices are carried across a triangle as their places are: here the way back to where they were.
    let mut carried = now.scene.clone();
    for (vertex, then) in carried.vertices.iter_mut().zip(&then.scene.vertices) {
        vertex.color = (Vec3::from(then.position) - Vec3::from(vertex.position)).into();
        vertex.texture = 0;
    }
    let carried = CpuRenderer::new(&carried, now.renderer.size())?;
    let at = |place: Vec2| motion_at(&carried, now, then, place);
    let centred = at(now.jitter)?;
    match &now.capture.place {
        None => Ok(centred),
        Some(chosen) => {
            let places = [now.capture.samples.as_slice(), &[now.jitter]].concat();
            gather_placed(&places, chosen, centred, at)
        }
    }
}

/// Returns the motion of the surfaces seen `place` from each pixel's centre. The colours of `carried` are the way back.
fn motion_at(carried: &CpuRenderer, now: &Moment, then: &Moment, place: Vec2) -> Result<Frame<Vec4>, RenderError> {
    let size = carried.size();
    let surfaces = carried.draw_surfaces(place)?;
    let to_world = Mat3::from_mat4(now.scene.camera.view()).transpose();
    let to_view = Mat3::from_mat4(then.scene.camera.view());
    let back = Vec3::from(now.scene.camera.position) - Vec3::from(then.scene.camera.position);
    let projection = then.scene.camera.projection(size, then.jitter);
    let half = now.scene.camera.half_extent(size);
    let texels = surfaces.par_iter().enumerate().map(|(k, surface)| {
        let from = uvec2(k as u32 % size.x, k as u32 / size.x).as_vec2() + 0.5 + place;
        let is_sky = surface.depth >= SKY_DEPTH;
        let at = from / size.as_vec2() * 2.0 - 1.0;
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
        (raster - from).extend(deeper).extend(0.0)
    });
    Ok(Frame::new(size, texels.collect()))
}

#[cfg(test)]
mod tests;

//! Further shading samples where no shading sample around shows a surface.

use super::placed::{PlacedBy, Surfaces, gather_placed};
use super::{RenderError, Renderer};
use crate::capture::{Capture, ShadingSample};
use crate::gbuffer::{self, GBufferError};
use crate::inputs::Inputs;
use glam::{UVec2, Vec2, Vec4, ivec2};
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::{AtomicBuffer, Frame, StorageBuffer};
use straightline_kernels::sraa::{Shading, Sraa, sraa_extra};

/// Pixels that are shaded once more, at one of their geometry samples.
#[derive(Clone, Debug)]
pub struct Extra {
    /// For each pixel the number of the sample, or the number of samples where it is not shaded once more.
    pub sample: Frame<u32>,
    /// Linear colour of those that are; 0 of all others.
    pub color: Frame<Vec4>,
    /// Number of pixels that are shaded once more.
    pub listed: usize,
    /// Number of pixels that would be if the budget were large enough.
    pub wanted: usize,
    /// Number of pixels that could be.
    pub budget: usize,
}

impl Extra {
    /// Share of the pixels that are shaded once more.
    pub fn share(&self) -> f64 {
        self.listed as f64 / self.sample.texels().len() as f64
    }

    /// Everything that `sraa` with these options, `extra=true` among them, may read of a capture, and `sraa_extra` too, its list as long as
    /// this one.
    ///
    /// # Errors
    ///
    /// As [`gbuffer::sraa_inputs`].
    pub fn sraa_inputs(&self, capture: &Capture, options: &OptionValues) -> Result<Inputs, GBufferError> {
        let mut alone = options.clone();
        alone.remove("extra");
        let inputs = gbuffer::sraa_inputs(capture, &alone)?;
        // With a guide all colours are differences from it.
        let scale = inputs.images.iter().find(|(name, _)| name == "guide_scale");
        let color = match (&capture.guide, scale) {
            (Some(guide), Some((_, scale))) => {
                let scale = scale[0].texels()[0].truncate();
                gbuffer::difference_at(&self.color, guide, &self.sample, scale)
            }
            _ => self.color.clone(),
        };
        let counts = COUNTS.map(|count| [f64::from(count), 0.0, 0.0, 1.0]);
        Ok(inputs
            .with_integers("extra", vec![gbuffer::encode_places(&self.sample)])
            .with_image("extra_color", color)
            .with_buffer("extra_counts", counts.to_vec())
            .with_buffer("extra_list", vec![[0.0; 4]; self.budget]))
    }
}

/// Initial contents of `extra_counts`: no workgroups in x, one in y and z, and no pixels.
const COUNTS: [u32; 4] = [0, 1, 1, 0];

/// Options of `sraa_extra` for a filter with `options`: those of [`PlacedBy::Planes`], but with the default `search-threshold`. What differs
/// less is worth a search, and not another sample: a third fewer pixels are listed, for the same picture.
pub fn listing_options(options: &[(String, String)]) -> Vec<(String, String)> {
    let mut options = PlacedBy::Planes.instead_of(options);
    options.retain(|(name, _)| name != "search-threshold");
    options
}

/// Shades at most `budget` pixels, at least one, of `capture`, which `renderer` draws, once more, where the kernel `sraa_extra` says with
/// [`listing_options`]. Pixels are taken row by row.
///
/// # Errors
///
/// [`RenderError::Extra`] if the capture is not shaded at its first sample, at the pixels' centres or where they are placed, has no normals or
/// no camera, or is not sampled at a pattern that has a name; what the renderer refuses.
pub fn shade_extra(renderer: &dyn Renderer, capture: &Capture, budget: usize) -> Result<Extra, RenderError> {
    let samples = capture.samples.len();
    let shading = match &capture.shading {
        ShadingSample::Centre => Shading::Centre,
        ShadingSample::Placed => Shading::Placed,
        ShadingSample::Sample(0) => Shading::Sample0,
        _ => return Err(RenderError::Extra),
    };
    let Some(Surfaces { cfg, gbuffer, view }) = Surfaces::new(capture, PlacedBy::Planes) else {
        return Err(RenderError::Extra);
    };
    let cfg = Sraa {
        shading,
        search_threshold: Sraa::default().search_threshold,
        ..cfg
    };
    let unread = Frame::new(UVec2::ONE, vec![0]);
    let place = capture.place.as_ref().unwrap_or(&unread);
    let budget = budget.max(1);
    let counts = AtomicBuffer::new(COUNTS.to_vec());
    let list = StorageBuffer::new(vec![UVec2::ZERO; budget]);
    let (width, height) = (capture.size.x as i32, capture.size.y as i32);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| ivec2(x, y)));
    let texels = pixels.map(|pixel| sraa_extra(&cfg, &gbuffer, &view, place, &counts, &list, pixel));
    let sample = Frame::new(capture.size, texels.collect());
    let listed = sample.texels().iter().filter(|k| (**k as usize) < samples).count();
    let mut places = capture.samples.clone();
    places.push(Vec2::ZERO);
    let nothing = Frame::new(capture.size, vec![Vec4::ZERO; sample.texels().len()]);
    Ok(Extra {
        color: gather_placed(&places, &sample, nothing, |place| renderer.draw_shaded(place))?,
        listed,
        wanted: counts.load(3) as usize,
        sample,
        budget,
    })
}

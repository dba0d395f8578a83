//! SRAA: the kernels of each preset, and how a frame binds them.

use super::targets::{Targets, all_layers};
use super::view::View;
use crate::antialiasing::Preset;
use crate::scene::{GROUND_LIGHT, SKY_LIGHT, SUN_LIGHT};
use crate::shaders::{sraa_edges, sraa_fast, sraa_fit, sraa_fit_sums, sraa_full, sraa_guide, sraa_guided};
use crate::shaders::{sraa_paper, sraa_place, sraa_residual};
use straightline_runtime::{Bound, Error, Region, wgpu};

/// Compiled kernels.
pub struct Kernels {
    paper: sraa_paper::Pass,
    fast: sraa_fast::Pass,
    edges: sraa_edges::Pass,
    full: sraa_full::Pass,
    guided: sraa_guided::Pass,
    place: sraa_place::Pass,
    fit_sums: sraa_fit_sums::Pass,
    fit: sraa_fit::Pass,
    guide: sraa_guide::Pass,
    residual: sraa_residual::Pass,
}

impl Kernels {
    pub fn new(device: &wgpu::Device) -> Result<Self, Error> {
        Ok(Kernels {
            paper: sraa_paper::Pass::new(device)?,
            fast: sraa_fast::Pass::new(device)?,
            edges: sraa_edges::Pass::new(device)?,
            full: sraa_full::Pass::new(device)?,
            guided: sraa_guided::Pass::new(device)?,
            place: sraa_place::Pass::new(device)?,
            fit_sums: sraa_fit_sums::Pass::new(device)?,
            fit: sraa_fit::Pass::new(device)?,
            guide: sraa_guide::Pass::new(device)?,
            residual: sraa_residual::Pass::new(device)?,
        })
    }
}

/// Kernels of one preset, bound to the textures of one size.
pub struct Filter {
    /// Decides where pixels are shaded, before they are.
    place: Option<sraa_place::Bound>,
    /// Replaces colours by their differences from the guide.
    guide: Option<Guide>,
    sraa: Sraa,
}

/// An estimate of the colour at every geometry sample: the albedo in the light of the sun and of an even sky.
struct Guide {
    /// The scale that fits the guide to the picture.
    sums: sraa_fit_sums::Bound,
    scale: sraa_fit::Bound,
    /// Mean over the geometry samples of each pixel.
    mean: sraa_guide::Bound,
    /// Colours less the guide.
    residual: sraa_residual::Bound,
}

enum Sraa {
    Paper(sraa_paper::Bound),
    Fast(sraa_fast::Bound),
    Edges(sraa_edges::Bound),
    Full(sraa_full::Bound),
    Guided(sraa_guided::Bound),
}

impl Filter {
    /// Binds the kernels of a preset to the frame's textures. Sizes and formats are checked here, not in each frame.
    pub fn new(kernels: &Kernels, preset: Preset, targets: &Targets) -> Result<Self, Error> {
        let [depth, normal, albedo] = &targets.geometry.each_ref().map(all_layers);
        let Targets { place, shaded: color, resolved, .. } = targets;
        let [corner, right, down] = View::new(targets.size, 0.0).rays().map(|ray| ray.to_array());
        let origin = [0, 0];
        let places = || {
            let parameters = sraa_place::Parameters::new(corner, right, down, origin);
            kernels.place.bind(&sraa_place::Inputs { depth, normal }, &parameters, place)
        };
        let (mut guide, mut placing) = (None, None);
        let sraa = match preset {
            Preset::Paper => Sraa::Paper(kernels.paper.bind(&sraa_paper::Inputs { depth, normal, color }, resolved)?),
            Preset::Fast => Sraa::Fast(kernels.fast.bind(&sraa_fast::Inputs { depth, color }, resolved)?),
            Preset::Edges => {
                let parameters = sraa_edges::Parameters::new(corner, right, down, origin);
                Sraa::Edges(kernels.edges.bind(&sraa_edges::Inputs { depth, normal, color }, &parameters, resolved)?)
            }
            Preset::Full => {
                placing = Some(places()?);
                let parameters = sraa_full::Parameters::new(corner, right, down, origin);
                let inputs = sraa_full::Inputs { depth, normal, color, place };
                Sraa::Full(kernels.full.bind(&inputs, &parameters, resolved)?)
            }
            Preset::Guided => {
                placing = Some(places()?);
                guide = Some(Guide::new(kernels, targets, [depth, normal, albedo])?);
                let parameters = sraa_guided::Parameters::new(corner, right, down, origin);
                let (color, guide_mean) = (&targets.difference, &targets.guide_mean);
                let inputs = sraa_guided::Inputs { depth, normal, color, place, guide_mean };
                Sraa::Guided(kernels.guided.bind(&inputs, &parameters, resolved)?)
            }
        };
        Ok(Filter { place: placing, guide, sraa })
    }

    /// Follows the camera, in whose space the light's direction is.
    pub fn set_view(&self, queue: &wgpu::Queue, view: &View) {
        if let Some(Guide { sums, mean, residual, .. }) = &self.guide {
            sums.set_light_direction(queue, view.sun());
            mean.set_light_direction(queue, view.sun());
            residual.set_light_direction(queue, view.sun());
        }
    }

    /// Kernel between geometry and shading.
    pub fn before_shading(&self) -> Option<&Bound> {
        self.place.as_ref().map(sraa_place::Bound::inner)
    }

    /// Kernels after shading, in order.
    pub fn after_shading(&self) -> Vec<&Bound> {
        let mut all = Vec::new();
        if let Some(Guide { sums, scale, mean, residual }) = &self.guide {
            all.extend([sums.inner(), scale.inner(), mean.inner(), residual.inner()]);
        }
        all.push(match &self.sraa {
            Sraa::Paper(bound) => bound.inner(),
            Sraa::Fast(bound) => bound.inner(),
            Sraa::Edges(bound) => bound.inner(),
            Sraa::Full(bound) => bound.inner(),
            Sraa::Guided(bound) => bound.inner(),
        });
        all
    }
}

impl Guide {
    fn new(
        kernels: &Kernels,
        targets: &Targets,
        [depth, normal, albedo]: [&wgpu::TextureView; 3],
    ) -> Result<Self, Error> {
        let Targets { place, shaded: color, fit_sums: [both, own], guide_scale, .. } = targets;
        // Cheaper than the shading's light: no highlights, and a sky that is the same on all sides.
        let (sun, light, ambient) = ([0.0; 3], SUN_LIGHT.to_array(), (0.5 * (GROUND_LIGHT + SKY_LIGHT)).to_array());
        let tiles = [both.texture().width(), both.texture().height()];
        let sums = kernels.fit_sums.bind_region(
            &sraa_fit_sums::Inputs { depth, normal, color, place, albedo },
            &sraa_fit_sums::Parameters::new(sun, light, ambient),
            &sraa_fit_sums::Targets { both, own },
            Region::at([0, 0], tiles),
        )?;
        let scale = kernels.fit.bind(&sraa_fit::Inputs { both, own }, guide_scale)?;
        let mean = kernels.guide.bind(
            &sraa_guide::Inputs { depth, normal, albedo, guide_scale },
            &sraa_guide::Parameters::new(sun, light, ambient),
            &targets.guide_mean,
        )?;
        let residual = kernels.residual.bind(
            &sraa_residual::Inputs { depth, normal, color, place, albedo, guide_scale },
            &sraa_residual::Parameters::new(sun, light, ambient),
            &targets.difference,
        )?;
        Ok(Guide { sums, scale, mean, residual })
    }
}

//! Kernels of one preset, bound to the textures of one size.

use crate::shaders::{GuideShaders, Shaders, sraa_fit, sraa_fit_rows};
use crate::targets::{GuideTargets, Targets};
use crate::{Error, Options, Preset, Projection};
use straightline_runtime::{self as runtime, BindOptions, Bound, Passes, Region, Shader, UniformValue, wgpu};
use wgpu::{Queue, TextureView};

/// Kernels in the order in which they run.
#[derive(Debug)]
pub(crate) struct Filter {
    pub before_shading: Vec<Bound>,
    pub after_shading: Vec<Bound>,
}

/// Binds kernels to textures and uniforms by the names that they have for them.
struct Binder<'a> {
    passes: &'a mut Passes,
    views: Vec<(&'static str, &'a TextureView)>,
    uniforms: Vec<(&'static str, UniformValue)>,
}

impl Filter {
    /// Binds the kernels of a preset. Sizes, formats and the device's abilities are checked here, not in each frame.
    pub fn new(
        passes: &mut Passes,
        options: Options,
        (projection, size): (&Projection, [u32; 2]),
        targets: &Targets,
    ) -> Result<Filter, Error> {
        let shaders = Shaders::find(options, projection)?;
        let mut binder = Binder {
            passes,
            views: targets.geometry.read.iter().map(|(name, view)| (*name, view)).collect(),
            uniforms: uniforms(options.preset, projection, size),
        };
        binder.views.push(("color", &targets.color));
        binder.views.extend(targets.place.iter().map(|view| ("place", view)));
        let mut before_shading = Vec::new();
        if let (Some(shader), Some(place)) = (shaders.place, &targets.place) {
            before_shading.push(binder.bind(shader, place)?);
        }
        let mut after_shading = Vec::new();
        if let (Some(shaders), Some(guide)) = (&shaders.guide, &targets.guide) {
            after_shading = binder.bind_guide(shaders, guide)?;
        }
        after_shading.push(binder.bind(shaders.filter, &targets.resolved)?);
        Ok(Filter {
            before_shading,
            after_shading,
        })
    }

    /// Follows the camera.
    pub fn set_projection(
        &self,
        queue: &Queue,
        (preset, projection, size): (Preset, &Projection, [u32; 2]),
    ) -> Result<(), Error> {
        let values = uniforms(preset, projection, size);
        for bound in self.before_shading.iter().chain(&self.after_shading) {
            for (name, value) in values.iter().filter(|(name, _)| bound.has_uniform(name)) {
                bound.write_uniform(queue, name, value.clone())?;
            }
        }
        Ok(())
    }
}

impl<'a> Binder<'a> {
    fn bind<'t>(&mut self, shader: &Shader<'_>, target: impl Into<runtime::Targets<'t>>) -> Result<Bound, Error> {
        self.bind_with(shader, target, BindOptions::default())
    }

    fn bind_with<'t>(
        &mut self,
        shader: &Shader<'_>,
        target: impl Into<runtime::Targets<'t>>,
        options: BindOptions<'_>,
    ) -> Result<Bound, Error> {
        let pass = self.passes.get(shader)?;
        let views: Vec<_> = self
            .views
            .iter()
            .filter(|(name, _)| pass.inputs().any(|input| input == *name))
            .collect();
        let views: Vec<(&str, &TextureView)> = views.into_iter().copied().collect();
        let uniforms = self.uniforms.iter().filter(|(name, _)| pass.has_uniform(name));
        let options = uniforms.fold(options, |options, (name, value)| options.uniform(name, value.clone()));
        Ok(pass.bind_with(&views, target, &options)?)
    }

    /// Binds the kernels before a filter with a guide, and replaces the colour by its difference from the guide.
    fn bind_guide(&mut self, shaders: &GuideShaders, targets: &'a GuideTargets) -> Result<Vec<Bound>, Error> {
        let pair = |views: &'a [TextureView; 2]| [("both", &views[0]), ("own", &views[1])];
        let region = |view: &TextureView| {
            let size = [view.texture().width(), view.texture().height()];
            BindOptions::default().region(Region::at([0, 0], size))
        };
        let (tiles, rows) = (pair(&targets.tiles), pair(&targets.rows));
        let sums = self.bind_with(shaders.sums, &tiles, region(tiles[0].1))?;
        self.views.extend(tiles);
        let row_sums = self.bind_with(&sraa_fit_rows::SHADER, &rows, region(rows[0].1))?;
        self.views.retain(|(name, _)| !["both", "own"].contains(name));
        self.views.extend(rows);
        let scale = self.bind(&sraa_fit::SHADER, &targets.scale)?;
        self.views.push(("guide_scale", &targets.scale));
        let mean = self.bind(shaders.mean, &targets.mean)?;
        let residual = self.bind(shaders.residual, &targets.difference)?;
        self.views.retain(|(name, _)| *name != "color");
        self.views
            .extend([("color", &targets.difference), ("guide_mean", &targets.mean)]);
        Ok(vec![sums, row_sums, scale, mean, residual])
    }
}

/// Uniforms of the kernels; each kernel has some of them.
fn uniforms(preset: Preset, projection: &Projection, size: [u32; 2]) -> Vec<(&'static str, UniformValue)> {
    let [corner, right, down] = projection.rays(size);
    let [near, far] = projection.planes();
    // Scales of the presets for relative differences, at the depth where the picture is 1 high. `paper` compares scene units.
    let depth_scale = match preset {
        Preset::Paper => 1.0,
        Preset::Fast => 3.0 / projection.height(),
        Preset::Edges | Preset::Full | Preset::Guided => 10.0 / projection.height(),
    };
    vec![
        ("ray_corner", corner.into()),
        ("ray_right", right.into()),
        ("ray_down", down.into()),
        ("ray_forward", projection.forward().into()),
        ("origin", [0_i32, 0].into()),
        ("near", near.into()),
        ("far", far.into()),
        ("depth_scale", depth_scale.into()),
    ]
}

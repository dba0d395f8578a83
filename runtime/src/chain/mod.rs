//! Filters of several passes, with the textures between them.

mod bind;
mod bound;
mod pictures;
mod recipe;
#[cfg(feature = "manifest")]
mod travelling;

use crate::inputs::Abilities;
use crate::overrides::find_override;
use crate::{Error, Pass, PassOptions, Shader};
use recipe::Recipe;
use std::sync::Arc;
use straightline_manifest::chain::ChainPlan;
use wgpu::{Device, TextureFormat};

pub use bound::BoundChain;

/// Passes that run one after another, such as the sizes of a bloom or the three passes of SMAA, on one device.
///
/// Making one compiles its shaders, each once. [`bind`](Self::bind) creates the textures between the passes, in sizes
/// that follow from the inputs. A chain can be shared between threads.
///
/// ```no_run
/// use straightline_runtime::{BindOptions, BoundChain, Chain, ChainShaders, Error, PassOptions, wgpu};
///
/// struct Bloom {
///     chain: Chain,
///     bound: BoundChain,
/// }
///
/// impl Bloom {
///     // Usually `shaders::bloom::CHAIN`.
///     fn new(
///         device: &wgpu::Device,
///         shaders: &ChainShaders,
///         [color, target]: [&wgpu::TextureView; 2],
///     ) -> Result<Self, Error> {
///         let chain = Chain::new(device, shaders, &PassOptions::default())?;
///         let bound = chain.bind(&[("color", color)], target)?;
///         Ok(Bloom { chain, bound })
///     }
///
///     // The window has another size, and so have both textures.
///     fn resize(self, [color, target]: [&wgpu::TextureView; 2]) -> Result<Self, Error> {
///         let Bloom { chain, bound } = self;
///         let options = BindOptions::default().uniform("strength", 0.5);
///         let bound = chain.rebind(bound, &[("color", color)], target, &options)?;
///         Ok(Bloom { chain, bound })
///     }
///
///     fn frame(&self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
///         self.bound.write_uniform(queue, "strength", 0.4)?;
///         self.bound.encode(encoder);
///         Ok(())
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Chain {
    device: Device,
    recipe: Arc<Recipe>,
    /// A pass for each shader and the formats that it writes.
    passes: Vec<Pass>,
    /// Number in `passes` of each pass of the plan.
    pass_numbers: Vec<usize>,
    /// Texels along a side of a texture that the device allows.
    most_texels: u32,
}

/// The shaders of a chain with its plan: the constant `CHAIN` that the generator wrote.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainShaders {
    plan: ChainPlan,
    shaders: &'static [(&'static str, &'static Shader<'static>)],
}

impl ChainShaders {
    /// A chain of constants, for generated code alone.
    #[doc(hidden)]
    pub const fn generated(plan: ChainPlan, shaders: &'static [(&'static str, &'static Shader<'static>)]) -> Self {
        ChainShaders { plan, shaders }
    }

    /// The plan.
    pub fn plan(&self) -> &ChainPlan {
        &self.plan
    }

    /// The shaders by the names that the plan's passes have for them.
    pub fn shaders(&self) -> &'static [(&'static str, &'static Shader<'static>)] {
        self.shaders
    }
}

impl Chain {
    /// The chain that a build script wrote as a constant.
    ///
    /// # Errors
    ///
    /// Those of [`from_shaders`](Self::from_shaders).
    pub fn new(device: &Device, shaders: &ChainShaders, options: &PassOptions) -> Result<Self, Error> {
        Self::from_shaders(device, &shaders.plan, shaders.shaders, options)
    }

    /// A chain of `plan`, whose passes name the `shaders`: each exactly once. `options` apply to the chain's results:
    /// formats are those of targets that the caller gives, by the names of the results. An override applies to every
    /// pass that has it.
    ///
    /// # Errors
    ///
    /// [`Error::Chain`] if the plan contradicts itself or does not fit the shaders, or if a pass cannot be made: the
    /// problem has the name of the pass and its error. [`Error::TargetFormat`] for the format of a result that the
    /// chain does not have; [`Error::UnknownOverride`] for an override that no pass has; [`Error::DeviceLost`] and
    /// [`Error::OutOfMemory`].
    pub fn from_shaders(
        device: &Device,
        plan: &ChainPlan,
        shaders: &[(&str, &Shader<'_>)],
        options: &PassOptions,
    ) -> Result<Self, Error> {
        let recipe = Recipe::new(plan, shaders, options)?;
        recipe.check_reads(shaders, &Abilities::new(device))?;
        for (name, _) in &options.overrides {
            let all = shaders.iter().flat_map(|(_, shader)| shader.plan.overrides.iter());
            find_override(all, &plan.chain, name)?;
        }
        let mut passes: Vec<Pass> = Vec::new();
        let mut made: Vec<(usize, Vec<TextureFormat>)> = Vec::new();
        let mut pass_numbers = Vec::new();
        for (step, pass) in recipe.steps.iter().zip(plan.passes.iter()) {
            let formats: Vec<TextureFormat> = step.writes.iter().map(|picture| recipe.formats[*picture]).collect();
            let wanted = (step.shader, formats);
            let number = match made.iter().position(|made| *made == wanted) {
                Some(number) => number,
                None => {
                    let (_, shader) = shaders[step.shader];
                    let outputs = shader.plan.outputs.iter().zip(&wanted.1);
                    let of_shader = |name: &str| shader.plan.overrides.iter().any(|of| of.name == name);
                    let mut bare = PassOptions::default()
                        .unbounded_loops(options.unbounded_loops)
                        .pipeline_cache(options.cache.as_ref());
                    let overrides = options.overrides.iter().filter(|(name, _)| of_shader(name));
                    bare.overrides.extend(overrides.cloned());
                    let options = outputs.fold(bare, |options, (output, format)| {
                        options.format_of(&output.name, *format)
                    });
                    let pass = Pass::from_shader(device, shader, &options)
                        .map_err(|error| recipe.name_pass(pass, &shader.plan, error))?;
                    passes.push(pass);
                    made.push(wanted);
                    passes.len() - 1
                }
            };
            pass_numbers.push(number);
        }
        Ok(Chain {
            device: device.clone(),
            recipe: Arc::new(recipe),
            passes,
            pass_numbers,
            most_texels: device.limits().max_texture_dimension_2d,
        })
    }

    /// The chain's name.
    pub fn name(&self) -> &str {
        &self.recipe.plan.chain
    }

    /// The plan: its passes, and the pictures between them.
    pub fn plan(&self) -> &ChainPlan {
        &self.recipe.plan
    }

    /// Names of the inputs that [`bind`](Self::bind) wants: textures, samplers and buffers.
    pub fn inputs(&self) -> impl ExactSizeIterator<Item = &str> {
        self.recipe.plan.inputs.iter().map(AsRef::as_ref)
    }

    /// Names of the targets that [`bind`](Self::bind) wants, with the format that each must have.
    pub fn targets(&self) -> impl Iterator<Item = (&str, TextureFormat)> {
        let pictures = self.recipe.plan.pictures.iter().zip(&self.recipe.formats);
        let results = pictures.filter(|(picture, _)| picture.memory.is_none());
        results.map(|(picture, format)| (&*picture.name, *format))
    }
}

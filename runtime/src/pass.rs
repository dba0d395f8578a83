//! The pass: one emitted shader on a device, ready to be bound.

use crate::guard::LossProbe;
use crate::inputs::Abilities;
use crate::layout::Layout;
use crate::module::Source;
use crate::overrides::{chosen_overrides, pipeline_constants};
use crate::pipeline::{Choices, Pipeline, check_formats};
use crate::plan::Plan;
use crate::{Error, PassOptions, Shader};
use std::sync::Arc;
use std::time::Duration;
use wgpu::{Device, TextureFormat};

/// An emitted shader on one device: pipeline and bind group layouts.
///
/// Making one compiles the shader; keep it, and [`bind`](Self::bind) it to what it is to read and write. A pass can be shared
/// between threads.
#[derive(Debug)]
pub struct Pass {
    pub(crate) device: Device,
    pub(crate) plan: Arc<Plan>,
    pub(crate) layout: Layout,
    pub(crate) pipeline: Pipeline,
    creation_time: Duration,
    pub(crate) formats: Vec<TextureFormat>,
    pub(crate) abilities: Abilities,
    pub(crate) loss_probe: LossProbe,
}

impl Pass {
    /// A pass of `shader`: of the constant `SHADER` that a build script wrote, or of one that was read.
    ///
    /// # Errors
    ///
    /// [`Error::UnknownOverride`], [`Error::OverrideType`] and [`Error::OverrideValue`] for an override that the shader
    /// does not have or that cannot have the value; [`Error::Limit`], [`Error::Shader`], [`Error::Pipeline`] and
    /// [`Error::OutOfMemory`] if the device cannot run the shader; [`Error::TargetFormat`] if the shader cannot write the
    /// format asked for; [`Error::UnboundedLoop`] if loops are to go without a bound and one may not end;
    /// [`Error::DeviceLost`].
    pub fn from_shader(device: &Device, shader: &Shader<'_>, options: &PassOptions) -> Result<Self, Error> {
        check_varyings(&shader.plan)?;
        let source = Source::from_shader(shader, options);
        Self::from_plan(device, shader.plan.clone(), source, options).map_err(|error| shader.locate(error))
    }

    /// A pass of a shader whose plan is `plan`.
    pub(crate) fn from_plan(
        device: &Device,
        plan: Plan,
        source: Source<'_>,
        options: &PassOptions,
    ) -> Result<Self, Error> {
        check_features(device, &plan)?;
        let formats = check_formats(device, &plan, options)?;
        let constants = pipeline_constants(&chosen_overrides(&plan, options)?);
        let doing = format!("making a pass of `{}`", plan.kernel);
        let loss_probe = LossProbe::new(device, &doing)?;
        let layout = Layout::new(device, &plan)?;
        let choices = Choices {
            formats: &formats,
            constants: &constants,
            cache: options.cache.as_ref(),
        };
        let (pipeline, creation_time) = Pipeline::new(device, &plan, &layout, source, choices)?;
        // Lost meanwhile, everything above was made without complaint and is dead.
        loss_probe.check(device, &doing)?;
        Ok(Pass {
            device: device.clone(),
            plan: Arc::new(plan),
            layout,
            pipeline,
            creation_time,
            formats,
            abilities: Abilities::new(device),
            loss_probe,
        })
    }

    /// The kernel's name.
    pub fn kernel(&self) -> &str {
        &self.plan.kernel
    }

    /// Names of the inputs that [`bind`](Self::bind) wants, textures, samplers and buffers, in binding order.
    pub fn inputs(&self) -> impl ExactSizeIterator<Item = &str> {
        self.plan.inputs.iter().map(|input| input.name.as_ref())
    }

    /// Returns whether the shader has a uniform of this name, so that it can be bound with a value
    /// ([`BindOptions::uniform`](crate::BindOptions::uniform)).
    pub fn has_uniform(&self, name: &str) -> bool {
        self.plan.has_uniform(name)
    }

    /// Returns whether the shader was generated for regions, so that a rectangle can be bound ([`BindOptions::region`](crate::BindOptions::region)).
    pub fn filters_regions(&self) -> bool {
        self.plan.region.is_some()
    }

    /// The format that the target must have; of several, the first one. Panics if the kernel has none.
    pub fn target_format(&self) -> TextureFormat {
        self.formats[0]
    }

    /// Names of the targets that [`bind`](Self::bind) wants, with the format that each must have, in the order of the
    /// kernel's fields.
    pub fn targets(&self) -> impl ExactSizeIterator<Item = (&str, TextureFormat)> {
        let names = self.plan.outputs.iter().map(|output| output.name.as_ref());
        names.zip(self.formats.iter().copied())
    }

    /// Returns the time that the device took to make the pipeline: wgpu's translation of the checked shader into the backend's
    /// language, and the driver's compilation. Some drivers compile only when the pass first runs.
    pub fn creation_time(&self) -> Duration {
        self.creation_time
    }
}

/// Refuses a shader that needs triangles.
pub(crate) fn check_varyings(plan: &Plan) -> Result<(), Error> {
    match plan.varyings.first() {
        None => Ok(()),
        Some(first) => Err(Error::Pipeline {
            kernel: plan.kernel.to_string(),
            description: format!(
                "its `{}` is interpolated, and a pass has no vertices to interpolate between: draw your triangles with it by \
                 `Draw`, or generate it for compute, where it is read from a texture",
                first.name
            ),
        }),
    }
}

/// Rejects shaders that need a feature which the device or this crate lacks.
pub(crate) fn check_features(device: &Device, plan: &Plan) -> Result<(), Error> {
    let refused = |description: String| Error::Pipeline {
        kernel: plan.kernel.to_string(),
        description,
    };
    for feature in plan.features.iter() {
        let (needed, why) = match feature.as_ref() {
            "subgroup" => (
                wgpu::Features::SUBGROUP,
                "it sends messages by quad operations, and the device was created without the feature SUBGROUP: ask for \
                 that, or generate the shader with the transport `derivatives` or `block`"
                    .to_owned(),
            ),
            "shader-f16" => (
                wgpu::Features::SHADER_F16,
                "it computes in half precision, and the device was created without the feature SHADER_F16: ask for that \
                 in `DeviceDescriptor::required_features` where the adapter has it, or generate the shader with the \
                 precision `f32`"
                    .to_owned(),
            ),
            "immediates" => {
                let size = plan.immediate_size();
                let why = format!(
                    "its uniforms are {size} bytes of immediates, and the device was created without the feature IMMEDIATES: ask \
                     for that in `DeviceDescriptor::required_features`, and for `max_immediate_size: {size}` in `required_limits`, \
                     or generate the shader with `parameters` as `uniform`"
                );
                (wgpu::Features::IMMEDIATES, why)
            }
            _ => return Err(refused(format!("it needs `{feature}`, which this crate does not know"))),
        };
        if !device.features().contains(needed) {
            return Err(refused(why));
        }
    }
    Ok(())
}

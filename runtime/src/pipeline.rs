//! Compiling a shader, and choosing the format that it writes.

use crate::guard::{guarded, scoped};
use crate::layout::{Layout, texture_format};
use crate::module::Source;
use crate::plan::{OutputPlan, Plan};
use crate::{Error, PassOptions};
use std::time::{Duration, Instant};
use wgpu::{Device, TextureFormat};

/// A pipeline of either stage.
#[derive(Debug)]
pub(crate) enum Pipeline {
    Compute {
        pipeline: wgpu::ComputePipeline,
        workgroup: [u32; 3],
    },
    Render(wgpu::RenderPipeline),
}

impl Pipeline {
    /// Compiles a shader for a target of `format`, and tells how long making the pipeline took once the shader was checked.
    pub(crate) fn new(
        device: &Device,
        plan: &Plan,
        layout: &Layout,
        source: Source<'_>,
        format: TextureFormat,
    ) -> Result<(Self, Duration), Error> {
        let kernel = &plan.kernel;
        let label = Some(kernel.as_str());
        let doing = format!("compiling `{kernel}`");
        let refused = |description| Error::Pipeline {
            kernel: kernel.clone(),
            description,
        };
        let module = source.module(device, plan)?;
        let start = Instant::now();
        let pipeline = match plan.output {
            OutputPlan::Storage { workgroup, .. } => {
                let pipeline = guarded(device, &doing, refused, || {
                    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                        label,
                        layout: Some(&layout.pipeline),
                        module: &module,
                        entry_point: Some(&plan.entry_point),
                        compilation_options: wgpu::PipelineCompilationOptions::default(),
                        cache: None,
                    })
                })?;
                Pipeline::Compute { pipeline, workgroup }
            }
            OutputPlan::Attachment { .. } => {
                let pipeline = guarded(device, &doing, refused, || {
                    let fullscreen = device.create_shader_module(wgpu::include_wgsl!("fullscreen.wgsl"));
                    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                        label,
                        layout: Some(&layout.pipeline),
                        vertex: wgpu::VertexState {
                            module: &fullscreen,
                            entry_point: Some("fullscreen"),
                            compilation_options: wgpu::PipelineCompilationOptions::default(),
                            buffers: &[],
                        },
                        primitive: wgpu::PrimitiveState::default(),
                        depth_stencil: None,
                        multisample: wgpu::MultisampleState::default(),
                        fragment: Some(wgpu::FragmentState {
                            module: &module,
                            entry_point: Some(&plan.entry_point),
                            compilation_options: wgpu::PipelineCompilationOptions::default(),
                            targets: &[Some(format.into())],
                        }),
                        multiview_mask: None,
                        cache: None,
                    })
                })?;
                Pipeline::Render(pipeline)
            }
        };
        Ok((pipeline, start.elapsed()))
    }
}

/// The format that the pipeline is to write: the one asked for if the shader and the device can.
pub(crate) fn check_format(device: &Device, plan: &Plan, options: &PassOptions) -> Result<TextureFormat, Error> {
    let refuse = |format, reason| {
        Err(Error::TargetFormat {
            kernel: plan.kernel.clone(),
            format,
            reason,
        })
    };
    match plan.output {
        OutputPlan::Storage { format, .. } => {
            let written = texture_format(format);
            match options.target_format {
                Some(asked) if asked != written => refuse(
                    asked,
                    format!("its compute shader writes {written:?}; generate it for another format, or as fragment"),
                ),
                _ => Ok(written),
            }
        }
        OutputPlan::Attachment { format } => {
            let format = options.target_format.unwrap_or_else(|| texture_format(format));
            if !matches!(
                format.sample_type(None, None),
                Some(wgpu::TextureSampleType::Float { .. })
            ) {
                return refuse(
                    format,
                    "the result is a colour of floats; use a float or normalised format".to_owned(),
                );
            }
            let missing = format.required_features() - device.features();
            if !missing.is_empty() {
                return refuse(
                    format,
                    format!("the device was created without the feature {missing:?}"),
                );
            }
            let target = wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d::default(),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            };
            // One texel tells better than any table what this adapter can draw to.
            match scoped(device, || device.create_texture(&target)) {
                Ok(_) => Ok(format),
                Err(wgpu::Error::OutOfMemory { .. }) => Err(Error::OutOfMemory {
                    doing: format!("making a pass of `{}`", plan.kernel),
                }),
                Err(error) => refuse(format, error.to_string().trim().to_owned()),
            }
        }
    }
}

//! Compiling a shader, and choosing the format that it writes.

use crate::error::Names;
use crate::guard::{run_guarded, run_scoped};
use crate::layout::{Layout, texture_format};
use crate::module::Source;
use crate::overrides::borrow_constants;
use crate::plan::{OutputPlan, Plan, StagePlan};
use crate::{Error, PassOptions};
use std::time::Duration;
use straightline_manifest::Component;
use web_time::Instant;
use wgpu::{Device, TextureFormat};

/// Options of a pipeline that the plan leaves open.
#[derive(Clone, Copy)]
pub(crate) struct Choices<'a> {
    /// Formats of the targets.
    pub(crate) formats: &'a [TextureFormat],
    /// Numbers and values of overrides.
    pub(crate) constants: &'a [(String, f64)],
    pub(crate) cache: Option<&'a wgpu::PipelineCache>,
}

/// A pipeline of either stage.
#[derive(Clone, Debug)]
pub(crate) enum Pipeline {
    Compute {
        pipeline: wgpu::ComputePipeline,
        workgroup: [u32; 3],
    },
    Render(wgpu::RenderPipeline),
}

impl Pipeline {
    /// Compiles a shader, and returns the time that making the pipeline took once the shader was checked.
    pub(crate) fn new(
        device: &Device,
        plan: &Plan,
        layout: &Layout,
        source: Source<'_>,
        choices: Choices<'_>,
    ) -> Result<(Self, Duration), Error> {
        let kernel = &plan.kernel;
        let label = Some(kernel.as_ref());
        let doing = format!("compiling `{kernel}`");
        let refused = |description| Error::Pipeline {
            kernel: kernel.to_string(),
            description,
        };
        let module = source.create_module(device, plan)?;
        let start = Instant::now();
        let pipeline = match plan.stage {
            StagePlan::Compute {
                workgroup,
                fills_memory,
            } => {
                let pipeline = run_guarded(device, &doing, refused, || {
                    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                        label,
                        layout: Some(&layout.pipeline),
                        module: &module,
                        entry_point: Some(&plan.entry_point),
                        compilation_options: wgpu::PipelineCompilationOptions {
                            constants: &borrow_constants(choices.constants),
                            zero_initialize_workgroup_memory: !fills_memory,
                        },
                        cache: choices.cache,
                    })
                })?;
                Pipeline::Compute { pipeline, workgroup }
            }
            StagePlan::Fragment => {
                let cover = run_guarded(device, &doing, refused, || {
                    device.create_shader_module(wgpu::include_wgsl!("fullscreen.wgsl"))
                })?;
                let side = VertexSide {
                    module: &cover,
                    entry_point: "fullscreen",
                    buffers: &[],
                    primitive: wgpu::PrimitiveState::default(),
                    depth_stencil: None,
                    multisample: wgpu::MultisampleState::default(),
                    blend: None,
                };
                let pipeline = render_pipeline(device, plan, layout, (side, &module), choices)?;
                Pipeline::Render(pipeline)
            }
        };
        Ok((pipeline, start.elapsed()))
    }
}

/// All of a render pipeline but its fragment shader.
pub(crate) struct VertexSide<'a> {
    pub(crate) module: &'a wgpu::ShaderModule,
    pub(crate) entry_point: &'a str,
    pub(crate) buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    pub(crate) primitive: wgpu::PrimitiveState,
    pub(crate) depth_stencil: Option<wgpu::DepthStencilState>,
    pub(crate) multisample: wgpu::MultisampleState,
    /// Of every target.
    pub(crate) blend: Option<wgpu::BlendState>,
}

/// A pipeline that draws with the plan's fragment shader.
pub(crate) fn render_pipeline(
    device: &Device,
    plan: &Plan,
    layout: &Layout,
    (side, fragment): (VertexSide<'_>, &wgpu::ShaderModule),
    choices: Choices<'_>,
) -> Result<wgpu::RenderPipeline, Error> {
    let kernel = &plan.kernel;
    let targets: Vec<_> = choices
        .formats
        .iter()
        .map(|format| {
            Some(wgpu::ColorTargetState {
                blend: side.blend,
                ..(*format).into()
            })
        })
        .collect();
    let refused = |description| Error::Pipeline {
        kernel: kernel.to_string(),
        description,
    };
    run_guarded(device, &format!("compiling `{kernel}`"), refused, || {
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(kernel),
            layout: Some(&layout.pipeline),
            vertex: wgpu::VertexState {
                module: side.module,
                entry_point: Some(side.entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: side.buffers,
            },
            primitive: side.primitive,
            depth_stencil: side.depth_stencil,
            multisample: side.multisample,
            fragment: Some(wgpu::FragmentState {
                module: fragment,
                entry_point: Some(&plan.entry_point),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &borrow_constants(choices.constants),
                    ..wgpu::PipelineCompilationOptions::default()
                },
                targets: &targets,
            }),
            multiview_mask: None,
            cache: choices.cache,
        })
    })
}

/// The formats that the pipeline is to write: those asked for, if the shader and the device can.
pub(crate) fn check_formats(device: &Device, plan: &Plan, options: &PassOptions) -> Result<Vec<TextureFormat>, Error> {
    let refuse = |format, reason| Error::TargetFormat {
        kernel: plan.kernel.to_string(),
        format,
        reason,
    };
    let known = || {
        plan.outputs
            .iter()
            .map(|output| output.name.as_ref())
            .collect::<Names>()
    };
    for (name, format) in &options.formats {
        if plan.outputs.iter().all(|output| output.name != *name) {
            return Err(refuse(*format, format!("it writes no `{name}`; it writes {}", known())));
        }
    }
    if let Some(format) = options.target_format
        && plan.outputs.len() > 1
    {
        let reason = format!("it writes {}: say with `format_of` which is meant", known());
        return Err(refuse(format, reason));
    }
    let asked = |output: &OutputPlan| {
        let named = options.formats.iter().rev().find(|(name, _)| *name == output.name);
        named.map(|(_, format)| *format).or(options.target_format)
    };
    let formats = plan.outputs.iter().map(|output| {
        let format = check_format(device, plan, output, asked(output));
        format.map_err(|refused| match refused {
            Refused::As(format, reason) => refuse(format, reason),
            Refused::Memory => Error::OutOfMemory {
                doing: format!("making a pass of `{}`", plan.kernel),
            },
        })
    });
    let formats = formats.collect::<Result<Vec<_>, _>>()?;
    if let StagePlan::Fragment = plan.stage {
        check_bytes(device, plan, &formats)?;
    }
    Ok(formats)
}

/// Refuses colours that together are more than a tile of the device holds.
fn check_bytes(device: &Device, plan: &Plan, formats: &[TextureFormat]) -> Result<(), Error> {
    let mut needed = 0;
    for format in formats {
        let (bytes, alignment) = (format.target_pixel_byte_cost(), format.target_component_alignment());
        needed = u32::next_multiple_of(needed, alignment.unwrap_or(1)) + bytes.unwrap_or(0);
    }
    let available = device.limits().max_color_attachment_bytes_per_sample;
    match needed > available {
        true => Err(Error::Limit {
            kernel: plan.kernel.to_string(),
            limit: "max_color_attachment_bytes_per_sample",
            needed: u64::from(needed),
            available: u64::from(available),
        }),
        false => Ok(()),
    }
}

/// Reason why a format cannot be written.
enum Refused {
    As(TextureFormat, String),
    Memory,
}

fn check_format(
    device: &Device,
    plan: &Plan,
    output: &OutputPlan,
    asked: Option<TextureFormat>,
) -> Result<TextureFormat, Refused> {
    let written = texture_format(output.format);
    if let StagePlan::Compute { .. } = plan.stage {
        return match asked {
            Some(asked) if asked != written => Err(Refused::As(
                asked,
                format!("its compute shader writes {written:?}; generate it for another format, or as fragment"),
            )),
            _ => Ok(written),
        };
    }
    let format = asked.unwrap_or(written);
    let refuse = |reason: String| Err(Refused::As(format, reason));
    let (fits, what, use_instead) = match (output.format.component_type(), format.sample_type(None, None)) {
        (Component::Float, found) => (
            matches!(found, Some(wgpu::TextureSampleType::Float { .. })),
            "a colour of floats",
            "a float or normalised format",
        ),
        (Component::Uint, found) => (
            found == Some(wgpu::TextureSampleType::Uint),
            "of u32",
            "a format of u32",
        ),
        (Component::Sint, found) => (
            found == Some(wgpu::TextureSampleType::Sint),
            "of i32",
            "a format of i32",
        ),
    };
    if !fits {
        return refuse(format!("the result is {what}; use {use_instead}"));
    }
    if format.components() > output.format.components() {
        return refuse(format!(
            "`{}` has {} of the format's {} components; use one such as {written:?}",
            output.name,
            output.format.components(),
            format.components()
        ));
    }
    let missing = format.required_features() - device.features();
    if !missing.is_empty() {
        return refuse(format!("the device was created without the feature {missing:?}"));
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
    // Creating a texture of one texel shows better than any table whether this adapter can draw to the format.
    match run_scoped(device, || device.create_texture(&target)) {
        Ok(_) => Ok(format),
        Err(wgpu::Error::OutOfMemory { .. }) => Err(Refused::Memory),
        Err(error) => refuse(error.to_string().trim().to_owned()),
    }
}

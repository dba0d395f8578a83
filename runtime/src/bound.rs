//! A pass with all that it reads and writes, ready to be recorded.

use crate::inputs::texture_size;
use crate::layout::BoundGroup;
use crate::pipeline::Pipeline;
use crate::plan::Plan;
use crate::timer::{Span, Timer};
use crate::uniforms::{UniformValue, Uniforms};
use crate::{Error, Region};
use std::sync::Arc;
use straightline_manifest::plan::workgroups_of_tiles;
use wgpu::{CommandEncoder, ComputePass, Queue, RenderPass, TextureView};

/// Maximum number of targets of a fragment shader: wgpu's limit on any device.
pub(crate) const MAX_TARGETS: usize = 8;

/// A [`Pass`](crate::Pass) with its inputs, targets and uniforms: made by [`Pass::bind`](crate::Pass::bind), and recorded
/// any number of times.
///
/// It keeps its resources alive and has no lifetime: keep it until an input or a target is replaced, for example after a
/// resize. It can be shared between threads, and outlives the pass.
///
/// The device and the resources were checked when it was bound. A device that is lost later, or a texture that was
/// destroyed, causes an error at submission, as with any wgpu pass.
#[derive(Debug)]
pub struct Bound {
    pub(crate) plan: Arc<Plan>,
    pub(crate) work: Work,
    /// Pixels that are written.
    pub(crate) rectangle: Region,
    pub(crate) groups: Vec<BoundGroup>,
    pub(crate) uniforms: Uniforms,
}

/// Operation that a bound pass records: a dispatch or a draw.
#[derive(Debug)]
pub(crate) enum Work {
    Compute {
        pipeline: wgpu::ComputePipeline,
        /// Across and down.
        workgroups: [u32; 2],
    },
    Draw {
        pipeline: wgpu::RenderPipeline,
        /// [`MAX_TARGETS`] at most.
        targets: Vec<TextureView>,
        /// `true` if pixels outside of the rectangle keep their contents.
        is_part: bool,
    },
}

impl Work {
    /// Returns the operation with which `pipeline` fills `size` pixels of `targets`. If only a part of them, the rest keeps its
    /// contents.
    pub(crate) fn new(
        plan: &Plan,
        pipeline: &Pipeline,
        targets: &[&TextureView],
        (size, is_part): ([u32; 2], bool),
    ) -> Work {
        match pipeline {
            Pipeline::Compute { pipeline, workgroup } => Work::Compute {
                pipeline: pipeline.clone(),
                workgroups: workgroups_of_tiles(
                    plan.outputs
                        .iter()
                        .zip(targets)
                        .map(|(output, target)| (output.tile, texture_size(target.texture()))),
                )
                .unwrap_or_else(|| [0, 1].map(|axis| size[axis].div_ceil(workgroup[axis] * plan.block[axis]))),
            },
            Pipeline::Render(pipeline) => Work::Draw {
                pipeline: pipeline.clone(),
                targets: targets.iter().map(|target| (*target).clone()).collect(),
                is_part,
            },
        }
    }
}

impl Bound {
    /// The kernel's name.
    pub fn kernel(&self) -> &str {
        &self.plan.kernel
    }

    /// Records the pass into `encoder`, which is of the same device: a compute or a render pass of its own. It cannot fail and
    /// checks nothing; of its own it allocates nothing.
    pub fn encode(&self, encoder: &mut CommandEncoder) {
        self.record_pass(encoder, None);
    }

    /// [`encode`](Self::encode), timed on the GPU as the next span of `timer`.
    ///
    /// # Errors
    ///
    /// [`Error::TimerFull`]. Nothing has been recorded then.
    pub fn encode_timed(&self, encoder: &mut CommandEncoder, timer: &mut Timer) -> Result<(), Error> {
        let span = timer.span()?;
        self.record_pass(encoder, Some(&span));
        Ok(())
    }

    /// Records the dispatch into a compute pass of the caller's, in a debug group with the kernel's name: between other
    /// dispatches, without a pass of its own. It checks nothing but the stage, and allocates nothing of its own.
    ///
    /// It sets the pipeline and the kernel's bind groups, and leaves them set. What an earlier dispatch of the pass has
    /// written can be read: wgpu orders the dispatches of a compute pass.
    ///
    /// ```no_run
    /// # use straightline_runtime::{Bound, Error, wgpu};
    /// fn record(encoder: &mut wgpu::CommandEncoder, [blur, sharpen]: [&Bound; 2]) -> Result<(), Error> {
    ///     let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    ///     blur.encode_into(&mut pass)?;
    ///     sharpen.encode_into(&mut pass)
    /// }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::PassKind`] for a fragment shader. Nothing has been recorded then.
    pub fn encode_into(&self, pass: &mut ComputePass<'_>) -> Result<(), Error> {
        let Work::Compute { pipeline, workgroups } = &self.work else {
            return Err(self.wrong_pass());
        };
        pass.push_debug_group(&self.plan.kernel);
        self.dispatch(pass, pipeline, *workgroups);
        pass.pop_debug_group();
        Ok(())
    }

    /// Draws the kernel over all pixels of a render pass of the caller's, in a debug group with the kernel's name. It
    /// checks nothing but the stage, and allocates nothing of its own.
    ///
    /// It writes to the attachments of `pass`, not to the targets that it was bound with. They need the size and the
    /// formats of those, one sample a pixel, and no depth or stencil buffer beside them. wgpu reports an attachment that
    /// does not fit, or that shows an input, when the caller's encoder is finished. It does not report another size: then
    /// the shader reads outside of its inputs.
    ///
    /// It sets the pipeline and the kernel's bind groups, and leaves them set. The scissor and the viewport of `pass`
    /// apply; a shader for regions sets the scissor to its rectangle, and leaves it.
    ///
    /// # Errors
    ///
    /// [`Error::PassKind`] for a compute shader. Nothing has been recorded then.
    pub fn draw_into(&self, pass: &mut RenderPass<'_>) -> Result<(), Error> {
        let Work::Draw { pipeline, .. } = &self.work else {
            return Err(self.wrong_pass());
        };
        pass.push_debug_group(&self.plan.kernel);
        self.draw(pass, pipeline);
        pass.pop_debug_group();
        Ok(())
    }

    /// The error of a pass of the other kind.
    pub(crate) fn wrong_pass(&self) -> Error {
        Error::PassKind {
            kernel: self.plan.kernel.to_string(),
            is_compute: self.is_compute(),
        }
    }

    pub(crate) fn is_compute(&self) -> bool {
        matches!(self.work, Work::Compute { .. })
    }

    /// Sets the uniform `name` for the next submission to `queue`, which must be the device's own. A matrix or an array of
    /// the kernel is one value: `[[1.0, 0.0], [0.0, 1.0]]`, columns first.
    ///
    /// A queue of another device writes nothing: wgpu reports that to the error handler of that device, as for any
    /// `write_buffer`.
    ///
    /// As with any `write_buffer`, all encoders of one submission see the last value written before it. Other [`Bound`]s of
    /// the same pass keep their values. Numbers, vectors and matrices cause no allocation here.
    ///
    /// Immediates are recorded: a value holds from the next [`encode`](Self::encode) on, and `queue` is not used.
    ///
    /// # Errors
    ///
    /// [`Error::UnknownUniform`], or [`Error::UniformType`] for a value of another type. Nothing has been written then.
    pub fn write_uniform(&self, queue: &Queue, name: &str, value: impl Into<UniformValue>) -> Result<(), Error> {
        self.uniforms.write_value(&self.plan, queue, name, &value.into())
    }

    /// Returns whether the shader has a uniform of this name.
    pub fn has_uniform(&self, name: &str) -> bool {
        self.plan.has_uniform(name)
    }

    /// Sets all uniforms at once. `bytes` is the uniform struct in the buffer's layout: little-endian, each field at the
    /// manifest's offset, and as long as the manifest's size, padding included. (Several structs follow each other in
    /// binding order.)
    ///
    /// For the time at which values take effect, see [`write_uniform`](Self::write_uniform). No allocation happens here.
    ///
    /// # Errors
    ///
    /// [`Error::NoUniforms`], or [`Error::UniformSize`] for another length. Nothing has been written then.
    pub fn write_uniforms(&self, queue: &Queue, bytes: &[u8]) -> Result<(), Error> {
        self.uniforms.write_all(&self.plan, queue, bytes)
    }

    /// Writes `bytes` at `offset` of the uniform struct, for generated code, which knows both.
    #[doc(hidden)]
    pub fn write_at(&self, queue: &Queue, offset: u32, bytes: &[u8]) {
        self.uniforms.write_at(queue, offset, bytes);
    }

    fn record_pass(&self, encoder: &mut CommandEncoder, span: Option<&Span<'_>>) {
        let label = Some(self.plan.kernel.as_ref());
        match &self.work {
            Work::Compute { pipeline, workgroups } => {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label,
                    timestamp_writes: span.map(Span::compute_writes),
                });
                self.dispatch(&mut pass, pipeline, *workgroups);
            }
            Work::Draw {
                pipeline,
                targets,
                is_part,
            } => {
                // On the stack: nothing is allocated here.
                let attachments: [_; MAX_TARGETS] = std::array::from_fn(|k| {
                    targets.get(k).map(|view| wgpu::RenderPassColorAttachment {
                        view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            // Clearing spares tiled GPUs from loading the old pixels, where all of them are overwritten.
                            load: match is_part {
                                true => wgpu::LoadOp::Load,
                                false => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                            },
                            store: wgpu::StoreOp::Store,
                        },
                    })
                });
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label,
                    color_attachments: &attachments[..targets.len()],
                    depth_stencil_attachment: None,
                    timestamp_writes: span.map(Span::render_writes),
                    occlusion_query_set: None,
                    multiview_mask: None,
                });
                self.draw(&mut pass, pipeline);
            }
        }
    }

    fn dispatch(&self, pass: &mut ComputePass<'_>, pipeline: &wgpu::ComputePipeline, [across, down]: [u32; 2]) {
        pass.set_pipeline(pipeline);
        for (index, group) in &self.groups {
            pass.set_bind_group(*index, group, &[]);
        }
        self.uniforms.record_immediates(|bytes| pass.set_immediates(0, bytes));
        pass.dispatch_workgroups(across, down, 1);
    }

    fn draw(&self, pass: &mut RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        pass.set_pipeline(pipeline);
        for (index, group) in &self.groups {
            pass.set_bind_group(*index, group, &[]);
        }
        self.uniforms.record_immediates(|bytes| pass.set_immediates(0, bytes));
        // Any other shader fills all of its targets.
        if self.plan.region.is_some() {
            let ([x, y], [width, height]) = (self.rectangle.place, self.rectangle.size);
            pass.set_scissor_rect(x, y, width, height);
        }
        pass.draw(0..3, 0..1);
    }
}

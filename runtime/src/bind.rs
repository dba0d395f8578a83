//! Binding a pass: everything that can fail is done here, once.

use crate::bound::{Bound, Work};
use crate::error::ViewProblem;
use crate::guard::run_guarded;
use crate::inputs::{arrange_inputs, check_inputs, check_targets, find_shared, frame_size, is_one_image, texture_size};
use crate::pipeline::Pipeline;
use crate::plan::StagePlan;
use crate::targets::Targets;
use crate::uniforms::{Uniforms, frame_option};
use crate::{BindOptions, Error, Pass, Region, Resource};
use std::sync::Arc;
use wgpu::TextureView;

impl Pass {
    /// Binds the pass to its inputs and targets. `inputs` are given by name in any order. `targets`, whose every pixel is
    /// written, is `&view`, or `&[("albedo", &albedo), ("depth", &depth)]` for a kernel that returns a structure of these
    /// fields. Uniforms start from the manifest's defaults.
    ///
    /// All checks are made here, and bind groups and uniform buffers are created; [`Bound::encode`] then only records. Bind
    /// again when an input or a target is replaced.
    ///
    /// If all inputs are textures, `inputs` can be a slice of views, `&[("color", &view)]`; otherwise convert each to a
    /// [`Resource`]: `&[("color", Resource::from(&view)), ("linear", (&sampler).into())]`. For a kernel without inputs,
    /// pass `&[] as &[(&str, Resource)]`.
    ///
    /// - A texture is a 2-D view, or a 2-D array view with at least as many layers as the manifest states. Its usage
    ///   includes [`TEXTURE_BINDING`](wgpu::TextureUsages::TEXTURE_BINDING), and it has the target's size unless the
    ///   manifest permits any. Its format has at least the components that the kernel reads: float, normalised or depth for
    ///   texel loads, float or normalised for filtering, depth for depth comparison. (For a combined depth-stencil texture,
    ///   pass a view of the depth aspect.) It has one sample a texel, or, if the kernel reads samples, at least as many as
    ///   the manifest states.
    /// - A sampler has a comparison function exactly if the kernel compares with it. One that gathers texels takes the
    ///   nearest and clamps to the edge, as wgpu's default does.
    /// - A buffer has [`STORAGE`](wgpu::BufferUsages::STORAGE) usage and room for at least one element. It is bound whole,
    ///   so its size determines the number of elements. A buffer that the kernel writes keeps its unwritten elements, and
    ///   must not be one that it reads. For a kernel that only writes buffers, pass no targets, `&[]`; it runs over its
    ///   inputs of the frame's size. Without such an input it runs over the grid that the uniform `resolution` sets, a
    ///   `[u32; 2]`.
    ///
    /// All targets have the same size, and a uniform `resolution` of the frame's size always holds it. Each has the format that [`targets`](Self::targets) returns, and
    /// [`STORAGE_BINDING`](wgpu::TextureUsages::STORAGE_BINDING) usage for compute or
    /// [`RENDER_ATTACHMENT`](wgpu::TextureUsages::RENDER_ATTACHMENT) for fragment.
    ///
    /// All resources must belong to the pass's device. wgpu reports resources of another device. It cannot detect resources
    /// of another *instance*, and may confuse them with others: create only one instance.
    ///
    /// wgpu does not expose the mip level and layers that a view shows. Pass views of level 0 that begin at the layer that
    /// the kernel calls 0: sizes and layers are checked on the texture.
    ///
    /// # Errors
    ///
    /// [`Error::MissingInput`], [`Error::UnknownInput`], [`Error::DuplicateInput`] and [`Error::InputKind`];
    /// [`Error::TargetNames`], [`Error::MissingTarget`], [`Error::UnknownTarget`] and [`Error::DuplicateTarget`];
    /// [`Error::Input`], [`Error::InputSampler`], [`Error::InputBuffer`], [`Error::Target`] and [`Error::Combination`] for
    /// unsuitable resources; [`Error::UniformUnset`]; [`Error::DeviceLost`] and [`Error::OutOfMemory`].
    pub fn bind<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
    ) -> Result<Bound, Error> {
        self.bind_with(inputs, targets, &BindOptions::default())
    }

    /// Binds as [`bind`](Self::bind), with other uniforms than the manifest's defaults, or for a rectangle.
    ///
    /// For a rectangle the pass reads at and around `region.first` of the inputs, and writes the pixels at `region.place`
    /// of the targets; all other pixels are unchanged. The inputs must have the same size, but not necessarily the
    /// target's.
    ///
    /// # Errors
    ///
    /// Those of [`bind`](Self::bind); [`Error::UnknownUniform`], [`Error::UniformType`], [`Error::NoUniforms`] and
    /// [`Error::UniformSize`]; and [`Error::Region`] if the shader filters whole images only, or the rectangle leaves the
    /// inputs or the target.
    pub fn bind_with<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
        options: &BindOptions<'_>,
    ) -> Result<Bound, Error> {
        let inputs: Vec<(&str, Resource<'r>)> = inputs.iter().map(|(name, input)| (*name, (*input).into())).collect();
        let outputs: Vec<&str> = self.plan.outputs.iter().map(|output| &*output.name).collect();
        let targets = targets.into().arrange_targets(&self.plan.kernel, &outputs)?;
        self.loss_probe
            .check(&self.device, &format!("binding `{}`", self.plan.kernel))?;
        let resources = arrange_inputs(&self.plan, &inputs)?;
        check_targets(&self.plan, &self.formats, &self.abilities, &targets)?;
        let whole = self.computed_size(&resources, &targets, options)?;
        self.check_grid(whole, targets.is_empty())?;
        let rectangle = self.choose_region(&resources, whole, options.region)?;
        let frame = match self.plan.region {
            Some(_) => frame_size(&self.plan, &resources),
            None => None,
        };
        check_inputs(&self.plan, &self.abilities, &resources, frame.unwrap_or(whole))?;
        let size = targets.first().map(|target| texture_size(target.texture()));
        let uniforms = Uniforms::new(&self.device, &self.plan, options, size)?;
        let buffer = match self.plan.region {
            Some(_) => Some(rectangle.create_buffer(&self.device, &self.plan.kernel)?),
            None => None,
        };
        let groups = self.layout.bind_resources(
            &self.device,
            &self.plan,
            &uniforms,
            &resources,
            (&targets, buffer.as_ref()),
        );
        let shared = find_shared(&self.plan, &resources, &targets);
        let bound = groups.and_then(|groups| {
            let bound = Bound {
                plan: Arc::clone(&self.plan),
                work: Work::new(
                    &self.plan,
                    &self.pipeline,
                    &targets,
                    (rectangle.size, options.region.is_some()),
                ),
                rectangle,
                groups,
                uniforms,
            };
            match (&self.pipeline, shared) {
                // Binding has judged every resource.
                (Pipeline::Compute { .. }, None) => Ok(bound),
                _ => self.try_out(&bound, shared.is_some()).map(|()| bound),
            }
        });
        bound.map_err(|error| match (error, shared) {
            // A texture of one image has no other part to show.
            (Error::Combination { kernel, .. }, Some((input, target))) if is_one_image(target.texture()) => {
                Error::Input {
                    kernel,
                    name: input.name.to_string(),
                    problem: ViewProblem::IsTarget,
                }
            }
            (error, _) => error,
        })
    }

    /// Returns the size of the computation: that of the targets. For a kernel without targets it is that of the inputs, or the
    /// uniform `resolution`.
    fn computed_size(
        &self,
        resources: &[Resource<'_>],
        targets: &[&TextureView],
        options: &BindOptions<'_>,
    ) -> Result<[u32; 2], Error> {
        let of_inputs = || frame_size(&self.plan, resources);
        let whole = targets
            .first()
            .map(|target| texture_size(target.texture()))
            .or_else(of_inputs);
        let whole = match whole {
            Some(whole) => Some(whole),
            None => frame_option(&self.plan, options)?,
        };
        whole.ok_or_else(|| Error::BadManifest {
            kernel: self.plan.kernel.to_string(),
            place: "output".to_owned(),
            problem: "nothing is given, and no input has a size that tells how many pixels there are".to_owned(),
        })
    }

    /// Checks that one dispatch covers the grid of a kernel without targets, which the caller may have set.
    fn check_grid(&self, whole: [u32; 2], is_grid: bool) -> Result<(), Error> {
        let StagePlan::Compute { workgroup, .. } = self.plan.stage else {
            return Ok(());
        };
        let most = [0, 1].map(|axis| self.abilities.most_pixels(workgroup[axis] * self.plan.block[axis]));
        let fits = (0..2).all(|axis| (1..=most[axis]).contains(&whole[axis]));
        if fits || !is_grid {
            return Ok(());
        }
        Err(Error::Region {
            kernel: self.plan.kernel.to_string(),
            region: Region::at([0, 0], whole),
            problem: format!("a dispatch of this device has 1x1 to {}x{} pixels", most[0], most[1]),
        })
    }

    /// The rectangle to filter: the one asked for, or all of the inputs.
    fn choose_region(
        &self,
        resources: &[Resource<'_>],
        whole: [u32; 2],
        region: Option<Region>,
    ) -> Result<Region, Error> {
        match (&self.plan.region, region) {
            (None, None) => Ok(Region::at([0, 0], whole)),
            (None, Some(region)) => Err(Error::Region {
                kernel: self.plan.kernel.to_string(),
                region,
                problem: "its shader filters whole images: generate it with `region`".to_owned(),
            }),
            (Some(_), region) => {
                let frame = frame_size(&self.plan, resources);
                let region = region.unwrap_or_else(|| Region::at([0, 0], frame.unwrap_or(whole)));
                region.check(&self.plan.kernel, frame, whole)?;
                Ok(region)
            }
        }
    }

    /// Records into an encoder that is thrown away. What wgpu holds against a colour target, or against reading and writing
    /// the same image, it says only when an encoder is finished; that must not be the caller's.
    ///
    /// Inputs have been bound by now, so the fault is the target's, unless that is `shared` with an input.
    fn try_out(&self, bound: &Bound, shared: bool) -> Result<(), Error> {
        let kernel = &self.plan.kernel;
        let refused = |description| match shared {
            true => Error::Combination {
                kernel: kernel.to_string(),
                description,
            },
            false => Error::Target {
                kernel: kernel.to_string(),
                name: None,
                problem: ViewProblem::Refused { description },
            },
        };
        run_guarded(&self.device, &format!("binding `{kernel}`"), refused, || {
            let mut encoder = self
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            bound.encode(&mut encoder);
            drop(encoder.finish());
        })
    }
}

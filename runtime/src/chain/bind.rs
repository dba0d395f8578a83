//! Binding a chain: sizes, textures, and each of its passes.

use super::pictures::Memory;
use super::recipe::Source;
use super::{BoundChain, Chain};
use crate::error::{ChainProblem, Error, ViewProblem};
use crate::inputs::{arrange_resources, is_one_image, texture_size};
use crate::{BindOptions, Resource, Targets};
use std::sync::Arc;
use wgpu::TextureView;

impl Chain {
    /// Computes the sizes of all pictures, results included, for these inputs: in the order in which they are written,
    /// by name. A target that the caller is to create has the size of the result.
    ///
    /// # Errors
    ///
    /// Those of [`bind`](Self::bind) for inputs; [`Error::Chain`] for a picture that is larger than the device allows.
    pub fn sizes<'r, R: Into<Resource<'r>> + Copy>(
        &self,
        inputs: &[(&str, R)],
    ) -> Result<Vec<(&str, [u32; 2])>, Error> {
        let sizes = self.compute_sizes(&self.arrange_inputs(inputs)?)?;
        let names = self.recipe.plan.pictures.iter().map(|picture| &*picture.name);
        Ok(names.zip(sizes).collect())
    }

    /// Binds the chain to its inputs and targets, and creates the textures between its passes. `inputs` and `targets`
    /// are given by name as for [`Pass::bind`](crate::Pass::bind); of a chain with one result, `targets` is `&view`.
    /// Targets have the sizes that [`sizes`](Self::sizes) returns. Uniforms start from their defaults.
    ///
    /// An input can be a target too, if every pass that reads it runs before the one that writes it. A result that
    /// later passes read needs the usage [`TEXTURE_BINDING`](wgpu::TextureUsages::TEXTURE_BINDING) besides.
    ///
    /// # Errors
    ///
    /// Those of [`Pass::bind`](crate::Pass::bind), for the chain's inputs and targets. [`Error::Chain`] if a picture is
    /// larger than the device allows, if a target has another size than the chain writes, or if a pass cannot be bound:
    /// the problem has the name of the pass and its error.
    pub fn bind<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
    ) -> Result<BoundChain, Error> {
        self.bind_with(inputs, targets, &BindOptions::default())
    }

    /// Binds as [`bind`](Self::bind), with other uniforms than the defaults. A value goes to every pass that has a
    /// uniform of its name.
    ///
    /// # Errors
    ///
    /// Those of [`bind`](Self::bind); [`Error::UnknownUniform`] and [`Error::UniformType`]; [`Error::Chain`] for a
    /// region and for uniforms as bytes, which only a pass has.
    pub fn bind_with<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
        options: &BindOptions<'_>,
    ) -> Result<BoundChain, Error> {
        self.bind_reusing(&self.arrange_inputs(inputs)?, targets.into(), options, Memory::new())
    }

    /// Binds as [`bind_with`](Self::bind_with), and takes those textures of `old` whose size is the same. The others
    /// are freed before new ones are created. Nothing else of `old` is used: uniforms start again. An `old` of another
    /// chain is dropped.
    ///
    /// # Errors
    ///
    /// Those of [`bind_with`](Self::bind_with). `old` is gone then, too.
    pub fn rebind<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        old: BoundChain,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
        options: &BindOptions<'_>,
    ) -> Result<BoundChain, Error> {
        let kept = match Arc::ptr_eq(&old.recipe, &self.recipe) {
            true => old.into_memory(),
            false => Memory::new(),
        };
        self.bind_reusing(&self.arrange_inputs(inputs)?, targets.into(), options, kept)
    }

    /// The resources in the order of the plan's inputs.
    fn arrange_inputs<'r, R: Into<Resource<'r>> + Copy>(
        &self,
        inputs: &[(&str, R)],
    ) -> Result<Vec<Resource<'r>>, Error> {
        let given: Vec<(&str, Resource<'r>)> = inputs.iter().map(|(name, input)| (*name, (*input).into())).collect();
        let needed: Vec<_> = self.inputs().zip(self.recipe.kinds.iter().copied()).collect();
        arrange_resources(self.name(), &needed, &given)
    }

    fn bind_reusing(
        &self,
        resources: &[Resource<'_>],
        targets: Targets<'_>,
        options: &BindOptions<'_>,
        kept: Memory,
    ) -> Result<BoundChain, Error> {
        self.check_options(options)?;
        let results: Vec<&str> = self.targets().map(|(name, _)| name).collect();
        let targets = targets.arrange_targets(self.name(), &results)?;
        let sizes = self.compute_sizes(resources)?;
        self.check_targets(&sizes, &targets)?;
        let memory = self.create_memory(&sizes, kept)?;
        let mut targets = targets.into_iter();
        let views = self.recipe.plan.pictures.iter().map(|picture| {
            let owned = picture.memory.and_then(|number| memory.get(&number));
            let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
            owned.map(view).or_else(|| targets.next().cloned())
        });
        // Each picture has a texture or a target: both were counted from the plan.
        let views: Vec<TextureView> = views.flatten().collect();
        self.check_overwritten(resources, &views)?;
        let passes = (0..self.recipe.steps.len()).map(|step| self.bind_pass(step, resources, &views, options));
        Ok(BoundChain {
            passes: passes.collect::<Result<_, _>>()?,
            recipe: Arc::clone(&self.recipe),
            views,
            memory,
        })
    }

    fn bind_pass(
        &self,
        number: usize,
        resources: &[Resource<'_>],
        views: &[TextureView],
        options: &BindOptions<'_>,
    ) -> Result<crate::Bound, Error> {
        let (step, plan) = (&self.recipe.steps[number], &self.recipe.plan.passes[number]);
        let pass = &self.passes[self.pass_numbers[number]];
        let inputs = plan.reads.iter().zip(&step.reads).map(|(read, source)| {
            let resource = match *source {
                Source::Input(input) => resources[input],
                Source::Picture(picture) => Resource::Texture(&views[picture]),
            };
            (&*read.name, resource)
        });
        let inputs: Vec<(&str, Resource<'_>)> = inputs.collect();
        let outputs = pass.plan.outputs.iter().zip(&step.writes);
        let targets: Vec<(&str, &TextureView)> = outputs
            .map(|(output, picture)| (&*output.name, &views[*picture]))
            .collect();
        let mut own = BindOptions::default();
        for (name, value) in &options.values {
            if self.recipe.find_uniform(name, value.ty())?.passes.contains(&number) {
                own = own.uniform(name, value.clone());
            }
        }
        let bound = pass.bind_with(&inputs, targets.as_slice(), &own);
        bound.map_err(|error| self.recipe.name_pass(plan, &pass.plan, error))
    }

    /// Refuses options that only a pass has, and values that no pass has.
    fn check_options(&self, options: &BindOptions<'_>) -> Result<(), Error> {
        let refuse = |problem| Err(self.recipe.error(ChainProblem::Option { problem }));
        if options.region.is_some() {
            return refuse("it filters whole images: leave `BindOptions::region` out");
        }
        if options.uniforms.is_some() {
            return refuse("its passes have uniforms of their own: give values by name, with `BindOptions::uniform`");
        }
        for (name, value) in &options.values {
            self.recipe.find_uniform(name, value.ty())?;
        }
        Ok(())
    }

    /// Checks that `targets` have the sizes of the results, and are different textures.
    fn check_targets(&self, sizes: &[[u32; 2]], targets: &[&TextureView]) -> Result<(), Error> {
        let pictures = self.recipe.plan.pictures.iter().zip(sizes);
        let results = pictures.filter(|(picture, _)| picture.memory.is_none());
        for (k, ((result, needed), view)) in results.zip(targets).enumerate() {
            let found = texture_size(view.texture());
            if found != *needed {
                return Err(self.recipe.error(ChainProblem::TargetSize {
                    target: result.name.to_string(),
                    rule: result.size.to_string(),
                    needed: *needed,
                    found,
                }));
            }
            if let Some(other) = targets[..k].iter().position(|other| shows_same(other, view)) {
                let other = self.targets().nth(other).map_or("", |(name, _)| name);
                return Err(Error::Target {
                    kernel: self.name().to_owned(),
                    name: Some(result.name.to_string()),
                    problem: ViewProblem::IsOtherTarget {
                        other: other.to_owned(),
                    },
                });
            }
        }
        Ok(())
    }

    /// Refuses an input that the chain has overwritten when a pass reads it. Only wgpu knows which part of a texture a
    /// view shows; of a texture of one image it is all.
    fn check_overwritten(&self, resources: &[Resource<'_>], views: &[TextureView]) -> Result<(), Error> {
        let mut written: Vec<&TextureView> = Vec::new();
        for step in &self.recipe.steps {
            written.extend(step.writes.iter().map(|picture| &views[*picture]));
            for source in &step.reads {
                let Source::Input(number) = *source else { continue };
                let Resource::Texture(input) = resources[number] else {
                    continue;
                };
                if written.iter().any(|target| shows_same(target, input)) {
                    return Err(Error::Input {
                        kernel: self.name().to_owned(),
                        name: self.recipe.plan.inputs[number].to_string(),
                        problem: ViewProblem::IsTarget,
                    });
                }
            }
        }
        Ok(())
    }
}

/// Returns whether two views are known to show the same image.
fn shows_same(one: &TextureView, other: &TextureView) -> bool {
    one == other || (one.texture() == other.texture() && is_one_image(one.texture()))
}

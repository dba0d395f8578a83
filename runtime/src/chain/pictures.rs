//! Sizes and textures of a chain's pictures.

use super::Chain;
use super::recipe::{Recipe, plan_error};
use crate::Resource;
use crate::error::{ChainProblem, Error};
use crate::guard::run_guarded;
use crate::inputs::texture_size;
use std::collections::BTreeMap;
use wgpu::{Texture, TextureUsages};

/// Textures of a bound chain by memory number.
pub(super) type Memory = BTreeMap<u32, Texture>;

impl Chain {
    /// Sizes of the pictures in their order. `resources` are in the order of the plan's inputs.
    pub(super) fn compute_sizes(&self, resources: &[Resource<'_>]) -> Result<Vec<[u32; 2]>, Error> {
        let plan = &self.recipe.plan;
        let size_of = |name: &str| {
            let number = plan.inputs.iter().position(|input| input == name)?;
            match resources.get(number)? {
                Resource::Texture(view) => Some(texture_size(view.texture())),
                _ => None,
            }
        };
        let sizes = plan.pictures.iter().map(|picture| {
            let size = picture
                .size
                .evaluate(&size_of)
                .map_err(|bad| plan_error(plan, format!("size of picture `{}`", picture.name), bad.to_string()))?;
            match size.iter().all(|side| *side <= self.most_texels) {
                true => Ok(size),
                false => Err(self.recipe.error(ChainProblem::PictureSize {
                    picture: picture.name.to_string(),
                    rule: picture.size.to_string(),
                    size,
                    most: self.most_texels,
                })),
            }
        });
        sizes.collect()
    }

    /// Textures for all memory numbers, of which those of `kept` that have the right size are used again.
    pub(super) fn create_memory(&self, sizes: &[[u32; 2]], mut kept: Memory) -> Result<Memory, Error> {
        let plan = &self.recipe.plan;
        let mut needed: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (number, picture) in plan.pictures.iter().enumerate() {
            if let Some(memory) = picture.memory {
                needed.entry(memory).or_default().push(number);
            }
        }
        // Frees the others before new ones are created.
        kept.retain(|memory, texture| {
            let first = needed.get(memory).and_then(|pictures| pictures.first());
            first.is_some_and(|first| sizes[*first] == texture_size(texture))
        });
        for (memory, pictures) in needed {
            if let std::collections::btree_map::Entry::Vacant(place) = kept.entry(memory) {
                place.insert(self.create_texture(&pictures, sizes[pictures[0]])?);
            }
        }
        Ok(kept)
    }

    /// A texture that holds `pictures`, one after another.
    fn create_texture(&self, pictures: &[usize], [width, height]: [u32; 2]) -> Result<Texture, Error> {
        let Recipe { plan, formats, .. } = &*self.recipe;
        let names: Vec<&str> = pictures.iter().map(|number| &*plan.pictures[*number].name).collect();
        let label = format!("{}: {}", plan.chain, names.join(", "));
        let refused = |description: String| plan_error(plan, format!("picture `{}`", names[0]), description);
        run_guarded(&self.device, &format!("making the texture `{label}`"), refused, || {
            self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(&label),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: formats[pictures[0]],
                usage: self.recipe.find_usages(pictures),
                view_formats: &[],
            })
        })
    }
}

impl Recipe {
    /// Usages of a texture that holds `pictures`: each can be copied and sampled by the caller, too, to look at it.
    fn find_usages(&self, pictures: &[usize]) -> TextureUsages {
        let writers = self
            .steps
            .iter()
            .filter(|step| step.writes.iter().any(|picture| pictures.contains(picture)));
        let usages = writers.map(|step| match step.computes {
            true => TextureUsages::STORAGE_BINDING,
            false => TextureUsages::RENDER_ATTACHMENT,
        });
        usages.fold(
            TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC,
            |all, usage| all | usage,
        )
    }
}

//! The plan of a manifest, which must not contradict itself.

use super::{
    InputKind, InputPlan, OutputPlan, OverridePlan, Plan, StagePlan, Text, TexturePlan, UniformPlan, VaryingPlan,
    binding,
};
use crate::{
    Access, Binding, BindingKind, BufferType, Form, Manifest, Output, REGION_SIZE, Scalar, Stage, UniformField,
    ViewDimension, region_fields,
};

/// A manifest that contradicts itself, or describes something that no shader of the generator needs.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct Contradiction {
    /// The part of the manifest, such as ``binding `depth` ``.
    pub place: String,
    /// The problem there.
    pub problem: String,
}

impl Plan {
    /// Reads `manifest`, whose schema the caller has compared.
    ///
    /// # Errors
    ///
    /// The first contradiction in it.
    pub fn from_manifest(manifest: &Manifest) -> Result<Self, Contradiction> {
        let bad = |place: String, problem: String| Contradiction { place, problem };
        if manifest.form == Form::Function {
            let problem = "the shader is a function for another one, and no pass runs it: put it into a shader of your own, or emit \
                           the form `entry`";
            return Err(bad("form".to_owned(), problem.to_owned()));
        }
        let stage = plan_stage(manifest).map_err(|problem| bad("output".to_owned(), problem))?;
        let varyings = plan_varyings(manifest).map_err(|problem| bad("varyings".to_owned(), problem))?;
        let overrides = plan_overrides(manifest).map_err(|problem| bad("overrides".to_owned(), problem))?;
        let mut outputs = Vec::new();
        for (location, source) in (0..).zip(&manifest.outputs) {
            let read = plan_output(manifest, source, location);
            let place = match manifest.outputs.len() {
                1 => "output".to_owned(),
                _ => format!("output `{}`", source.name),
            };
            outputs.push(read.map_err(|problem| bad(place, problem))?);
        }
        let mut bound = Bound::default();
        for binding in &manifest.bindings {
            let read = bound.add(binding);
            read.map_err(|problem| bad(format!("binding `{}`", binding.name), problem))?;
        }
        if let Some(source) = &manifest.immediates {
            let read = plan_uniform(&source.name, None, source.size, &source.fields);
            let read = read.and_then(|uniform| {
                let named = manifest.features.iter().any(|feature| feature == "immediates");
                require(named, || "the feature `immediates` is not listed".to_owned()).map(|()| uniform)
            });
            let place = format!("immediates `{}`", source.name);
            bound.uniforms.push(read.map_err(|problem| bad(place, problem))?);
        }
        let Bound {
            mut inputs,
            mut uniforms,
            region,
        } = bound;
        inputs.sort_by_key(|input| (input.group, input.binding));
        uniforms.sort_by_key(|uniform| uniform.place);
        let plan = Plan {
            kernel: manifest.kernel.clone().into(),
            entry_point: manifest.entry_point.clone().into(),
            stage,
            block: manifest.block.map(|side| side.max(1)),
            features: manifest.features.iter().cloned().map(Text::from).collect(),
            inputs: inputs.into(),
            uniforms: uniforms.into(),
            region,
            overrides: overrides.into(),
            varyings: varyings.into(),
            outputs: outputs.into(),
        };
        plan.check_unique()
            .map_err(|problem| bad("bindings".to_owned(), problem))?;
        Ok(plan)
    }

    /// Each place and each name is used once.
    fn check_unique(&self) -> Result<(), String> {
        let mut places = self.binding_places();
        let mut inputs: Vec<&str> = self.inputs.iter().map(|i| i.name.as_ref()).collect();
        let mut outputs: Vec<&str> = self.outputs.iter().map(|o| o.name.as_ref()).collect();
        let mut fields: Vec<&str> = self
            .uniforms
            .iter()
            .flat_map(|u| u.fields.iter())
            .map(|f| f.name.as_ref())
            .collect();
        if let Some((group, binding)) = find_repeated(&mut places) {
            return Err(format!("@group({group}) @binding({binding}) is listed twice"));
        }
        if let Some(name) = find_repeated(&mut inputs) {
            return Err(format!("input `{name}` is listed twice"));
        }
        if let Some(name) = find_repeated(&mut outputs) {
            return Err(format!("output `{name}` is listed twice"));
        }
        if let Some(name) = find_repeated(&mut fields) {
            return Err(format!("uniform `{name}` is listed twice"));
        }
        Ok(())
    }
}

/// Bindings of a manifest that have been read.
#[derive(Default)]
struct Bound {
    inputs: Vec<InputPlan>,
    uniforms: Vec<UniformPlan>,
    region: Option<UniformPlan>,
}

impl Bound {
    fn add(&mut self, source: &Binding) -> Result<(), String> {
        let (name, group, binding) = (Text::from(source.name.clone()), source.group, source.binding);
        let kind = match &source.kind {
            BindingKind::Texture {
                dimension,
                sample_type,
                components,
                layers,
                samples,
                extent,
            } => {
                let texture = TexturePlan {
                    dimension: *dimension,
                    sample_type: *sample_type,
                    components: *components,
                    layers: *layers,
                    samples: *samples,
                    extent: *extent,
                };
                binding::check_texture(&texture)?;
                InputKind::Texture(texture)
            }
            BindingKind::Sampler { sampler } => InputKind::Sampler(*sampler),
            BindingKind::Buffer {
                buffer_type,
                element,
                stride,
                fields,
            } => {
                let fits = matches!(buffer_type, BufferType::ReadOnlyStorage | BufferType::Storage);
                require(fits, || {
                    "its buffer_type is neither read-only-storage nor storage".to_owned()
                })?;
                InputKind::Buffer(binding::plan_buffer(
                    element,
                    *stride,
                    fields,
                    *buffer_type == BufferType::Storage,
                )?)
            }
            BindingKind::Uniform {
                buffer_type,
                size,
                fields,
            } => {
                let fits = *buffer_type == BufferType::Uniform;
                require(fits, || "its buffer_type is not uniform".to_owned())?;
                if source.is_region() {
                    let fits = *fields == region_fields() && *size == REGION_SIZE;
                    require(fits, || "its fields are not those of a region".to_owned())?;
                }
                let uniform = plan_uniform(&source.name, Some((group, binding)), *size, fields)?;
                if source.is_region() {
                    require(self.region.is_none(), || "it is listed twice".to_owned())?;
                    self.region = Some(uniform);
                } else {
                    self.uniforms.push(uniform);
                }
                return Ok(());
            }
        };
        self.inputs.push(InputPlan {
            name,
            group,
            binding,
            kind,
        });
        Ok(())
    }
}

/// A uniform struct, at a `place` if it is a buffer.
fn plan_uniform(
    name: &str,
    place: Option<(u32, u32)>,
    size: u32,
    fields: &[UniformField],
) -> Result<UniformPlan, String> {
    require(size > 0 && size.is_multiple_of(16), || {
        format!("{size} bytes, not a multiple of 16")
    })?;
    let fields = fields.iter().map(|field| binding::plan_field(field, size));
    Ok(UniformPlan {
        name: name.to_owned().into(),
        place,
        size,
        fields: fields.collect::<Result<Vec<_>, _>>()?.into(),
    })
}

/// The stage of `manifest`.
fn plan_stage(manifest: &Manifest) -> Result<StagePlan, String> {
    let writes = |binding: &Binding| matches!(&binding.kind, BindingKind::Buffer { buffer_type, .. } if *buffer_type == BufferType::Storage);
    let given = !manifest.outputs.is_empty();
    require(given || manifest.bindings.iter().any(writes), || {
        "nothing is written".to_owned()
    })?;
    match manifest.stage {
        Stage::Compute => {
            let Some(workgroup) = manifest.workgroup_size else {
                return Err("the stage is compute, but no workgroup_size is given".to_owned());
            };
            let whole = workgroup[0] > 0 && workgroup[1] > 0 && workgroup[2] == 1;
            require(whole, || format!("workgroup_size {workgroup:?} does not tile an image"))?;
            Ok(StagePlan::Compute {
                workgroup,
                fills_memory: manifest.fills_memory,
            })
        }
        Stage::Fragment => {
            require(given, || "the stage is fragment, but no colour is given".to_owned())?;
            require(manifest.workgroup_size.is_none(), || {
                "the stage is fragment, but has a workgroup_size".to_owned()
            })?;
            Ok(StagePlan::Fragment)
        }
    }
}

/// The varyings of `manifest`.
fn plan_varyings(manifest: &Manifest) -> Result<Vec<VaryingPlan>, String> {
    let all = &manifest.varyings;
    require(all.is_empty() || manifest.stage == Stage::Fragment, || {
        "the stage is compute, which interpolates nothing".to_owned()
    })?;
    let mut names: Vec<&str> = all.iter().map(|varying| varying.name.as_str()).collect();
    let mut locations: Vec<u32> = all.iter().map(|varying| varying.location).collect();
    if let Some(name) = find_repeated(&mut names) {
        return Err(format!("`{name}` is listed twice"));
    }
    if let Some(location) = find_repeated(&mut locations) {
        return Err(format!("location {location} is listed twice"));
    }
    match all.iter().find(|varying| varying.ty.scalar() != Scalar::F32) {
        Some(varying) => Err(format!(
            "`{}` is of type {}, and floats are interpolated",
            varying.name, varying.ty
        )),
        None => Ok(all.iter().map(VaryingPlan::from).collect()),
    }
}

/// The overrides of `manifest`: names and numbers are unique, and defaults lie in the ranges.
fn plan_overrides(manifest: &Manifest) -> Result<Vec<OverridePlan>, String> {
    let all = &manifest.overrides;
    let mut names: Vec<&str> = all.iter().map(|of| of.name.as_str()).collect();
    let mut ids: Vec<u32> = all.iter().map(|of| of.id).collect();
    if let Some(name) = find_repeated(&mut names) {
        return Err(format!("`{name}` is listed twice"));
    }
    if let Some(id) = find_repeated(&mut ids) {
        return Err(format!("number {id} is listed twice"));
    }
    let each = all.iter().map(|of| {
        let (name, ty, default) = (&of.name, of.ty, of.default);
        require(ty.holds(default), || {
            format!("the default {default} of `{name}` is no {ty}")
        })?;
        let plan = OverridePlan {
            name: name.clone().into(),
            id: of.id,
            ty,
            default,
            range: of.range,
        };
        require(plan.allows(default), || {
            format!("the default {default} of `{name}` is out of its range")
        })?;
        Ok(plan)
    });
    each.collect()
}

impl From<&crate::Varying> for VaryingPlan {
    fn from(varying: &crate::Varying) -> Self {
        VaryingPlan {
            name: varying.name.clone().into(),
            ty: varying.ty,
            location: varying.location,
        }
    }
}

/// An output of `manifest`, which is to be at `location` in a fragment shader.
fn plan_output(manifest: &Manifest, output: &Output, location: u32) -> Result<OutputPlan, String> {
    require(output.access == Access::WriteOnly, || {
        "the result is only written".to_owned()
    })?;
    require(output.view_dimension == ViewDimension::D2, || {
        "the result is 2d".to_owned()
    })?;
    let place = match manifest.stage {
        Stage::Compute => {
            let (Some(group), Some(binding)) = (output.group, output.binding) else {
                return Err("the stage is compute, but group and binding are not both given".to_owned());
            };
            require(output.location.is_none(), || {
                "the stage is compute, but a location is given".to_owned()
            })?;
            Some((group, binding))
        }
        Stage::Fragment => {
            let bound = output.group.is_some() || output.binding.is_some();
            require(!bound, || {
                "the stage is fragment, but a group or binding is given".to_owned()
            })?;
            require(output.location == Some(location), || {
                format!("the stage is fragment, but the location is not {location}")
            })?;
            None
        }
    };
    if let Some(tile) = output.tile {
        require(manifest.stage == Stage::Compute, || {
            "the stage is fragment, but a tile is given".to_owned()
        })?;
        require(!tile.contains(&0), || "a tile has no texels".to_owned())?;
        require(manifest.outputs.iter().all(|other| other.tile.is_some()), || {
            "it has a tile, and another output has none".to_owned()
        })?;
    }
    Ok(OutputPlan {
        name: output.name.clone().into(),
        place,
        format: output.format,
        tile: output.tile,
    })
}

pub(super) fn require(holds: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}

fn find_repeated<T: Ord + Copy>(items: &mut [T]) -> Option<T> {
    items.sort_unstable();
    items.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

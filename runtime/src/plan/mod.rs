//! A manifest, checked for itself: what a pass binds, in the terms that the rest of the crate uses.

mod binding;

use crate::uniforms::UniformValue;
use crate::{Error, ResourceKind};
use straightline_manifest::{
    Access, Binding, BindingKind, BufferType, Dimension, Extent, Form, Format, Manifest, Output, Part, REGION_SIZE,
    SampleType, SamplerType, Scalar, Stage, ValueType, Varying, ViewDimension, region_fields,
};

/// What to bind where. Every number in it has been checked, except against the device.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) kernel: String,
    pub(crate) entry_point: String,
    /// Pixels that one invocation computes.
    pub(crate) block: [u32; 2],
    /// In binding order.
    pub(crate) inputs: Vec<InputPlan>,
    /// In binding order.
    pub(crate) uniforms: Vec<UniformPlan>,
    /// Of a shader that filters a rectangle.
    pub(crate) region: Option<UniformPlan>,
    pub(crate) stage: StagePlan,
    /// What is interpolated; of a fragment shader only.
    pub(crate) varyings: Vec<Varying>,
    /// In the order of their locations.
    pub(crate) outputs: Vec<OutputPlan>,
    /// Names that the text spells otherwise.
    pub(crate) spelled: Vec<Spelled>,
}

/// A resource that the caller gives by name.
#[derive(Debug)]
pub(crate) struct InputPlan {
    pub(crate) name: String,
    pub(crate) group: u32,
    pub(crate) binding: u32,
    pub(crate) kind: InputKind,
}

/// What an input must be.
#[derive(Clone, Copy, Debug)]
pub(crate) enum InputKind {
    Texture(TexturePlan),
    Sampler(SamplerType),
    Buffer(BufferPlan),
}

impl InputKind {
    /// The kind of resource that is bound.
    pub(crate) fn resource(self) -> ResourceKind {
        match self {
            InputKind::Texture(_) => ResourceKind::Texture,
            InputKind::Sampler(_) => ResourceKind::Sampler,
            InputKind::Buffer(_) => ResourceKind::Buffer,
        }
    }
}

/// A texture that the shader reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TexturePlan {
    pub(crate) dimension: Dimension,
    pub(crate) sample_type: SampleType,
    pub(crate) components: u8,
    pub(crate) layers: u32,
    pub(crate) samples: u32,
    pub(crate) extent: Extent,
}

/// A storage buffer that the shader reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BufferPlan {
    /// Of structures none: they are known by their size.
    pub(crate) element: Option<ValueType>,
    pub(crate) stride: u32,
    /// Whether the shader writes to it.
    pub(crate) written: bool,
}

/// A uniform struct.
#[derive(Debug)]
pub(crate) struct UniformPlan {
    pub(crate) name: String,
    pub(crate) group: u32,
    pub(crate) binding: u32,
    pub(crate) size: u32,
    pub(crate) fields: Vec<FieldPlan>,
}

/// A field of a uniform struct.
#[derive(Debug)]
pub(crate) struct FieldPlan {
    pub(crate) name: String,
    /// A number or a vector.
    pub(crate) ty: ValueType,
    pub(crate) offset: u32,
    pub(crate) default: Option<UniformValue>,
    /// Of what value it is a part.
    pub(crate) part: Option<Part>,
}

impl FieldPlan {
    /// The name that the kernel's source has for the value: that of the whole.
    pub(crate) fn whole(&self) -> &str {
        self.part.as_ref().map_or(&self.name, |part| &part.of)
    }
}

/// The stage.
#[derive(Clone, Copy, Debug)]
pub(crate) enum StagePlan {
    Compute { workgroup: [u32; 3] },
    Fragment,
}

/// Where a result goes.
#[derive(Debug)]
pub(crate) struct OutputPlan {
    pub(crate) name: String,
    /// Group and binding number of a storage texture; of a colour attachment there are none.
    pub(crate) place: Option<(u32, u32)>,
    pub(crate) format: Format,
}

/// A name of the kernel's that the text spells otherwise.
#[derive(Debug)]
pub(crate) struct Spelled {
    of: String,
    /// Number of a binding; none of a member of the uniform struct.
    binding: Option<u32>,
    name: String,
}

impl Plan {
    /// Reads `manifest`, refusing one that contradicts itself.
    pub(crate) fn new(manifest: &Manifest) -> Result<Self, Error> {
        let bad = |place: String, problem: String| Error::BadManifest {
            kernel: manifest.kernel.clone(),
            place,
            problem,
        };
        if manifest.schema != straightline_manifest::SCHEMA {
            return Err(straightline_manifest::Error::Schema { found: manifest.schema }.into());
        }
        if manifest.form == Form::Function {
            let problem = "the shader is a function for another one, and no pass runs it: put it into a shader of your own, or emit \
                           the form `entry`";
            return Err(bad("form".to_owned(), problem.to_owned()));
        }
        let mut plan = Plan {
            kernel: manifest.kernel.clone(),
            entry_point: manifest.entry_point.clone(),
            block: manifest.block.map(|side| side.max(1)),
            inputs: Vec::new(),
            uniforms: Vec::new(),
            region: None,
            stage: stage(manifest).map_err(|problem| bad("output".to_owned(), problem))?,
            varyings: varyings(manifest).map_err(|problem| bad("varyings".to_owned(), problem))?,
            outputs: Vec::new(),
            spelled: spelled(manifest),
        };
        for (location, source) in (0..).zip(&manifest.outputs) {
            let read = output(manifest, source, location);
            let place = match manifest.outputs.len() {
                1 => "output".to_owned(),
                _ => format!("output `{}`", source.name),
            };
            plan.outputs.push(read.map_err(|problem| bad(place, problem))?);
        }
        for binding in &manifest.bindings {
            let read = plan.add(binding);
            read.map_err(|problem| bad(format!("binding `{}`", binding.name), problem))?;
        }
        plan.inputs.sort_by_key(|input| (input.group, input.binding));
        plan.uniforms.sort_by_key(|uniform| (uniform.group, uniform.binding));
        plan.check_unique()
            .map_err(|problem| bad("bindings".to_owned(), problem))?;
        Ok(plan)
    }

    fn add(&mut self, source: &Binding) -> Result<(), String> {
        let (name, group, binding) = (source.name.clone(), source.group, source.binding);
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
                InputKind::Buffer(binding::buffer(
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
                require(*size > 0 && size % 16 == 0, || {
                    format!("{size} bytes, not a multiple of 16")
                })?;
                if source.is_region() {
                    let fits = *fields == region_fields() && *size == REGION_SIZE;
                    require(fits, || "its fields are not those of a region".to_owned())?;
                }
                let fields = fields
                    .iter()
                    .map(|f| binding::field(f, *size))
                    .collect::<Result<Vec<_>, _>>()?;
                let uniform = UniformPlan {
                    name,
                    group,
                    binding,
                    size: *size,
                    fields,
                };
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

    /// What the text calls a binding or an output.
    pub(crate) fn in_text<'p>(&'p self, name: &'p str, binding: u32) -> &'p str {
        let of = |one: &&Spelled| one.binding == Some(binding) && one.of == name;
        self.spelled.iter().find(of).map_or(name, |one| &one.name)
    }

    /// What the text calls a member of the uniform struct.
    pub(crate) fn member_in_text<'p>(&'p self, name: &'p str) -> &'p str {
        let of = |one: &&Spelled| one.binding.is_none() && one.of == name;
        self.spelled.iter().find(of).map_or(name, |one| &one.name)
    }

    /// What an error calls an output: nothing where it is the only one.
    pub(crate) fn target_name(&self, output: usize) -> Option<String> {
        let named = self.outputs.get(output).filter(|_| self.outputs.len() > 1);
        named.map(|output| output.name.clone())
    }

    /// The structs of values set at run time, that of the region among them.
    pub(crate) fn uniform_structs(&self) -> impl Iterator<Item = &UniformPlan> {
        self.uniforms.iter().chain(&self.region)
    }

    /// Group and binding number of everything, sorted.
    fn places(&self) -> Vec<(u32, u32)> {
        let mut places: Vec<(u32, u32)> = self.inputs.iter().map(|i| (i.group, i.binding)).collect();
        places.extend(self.uniform_structs().map(|u| (u.group, u.binding)));
        places.extend(self.outputs.iter().filter_map(|output| output.place));
        places.sort_unstable();
        places
    }

    /// The first binding number that leaves one out: group, number, and the number that is left out.
    pub(crate) fn hole(&self) -> Option<(u32, u32, u32)> {
        let places = self.places();
        let mut groups = places.chunk_by(|a, b| a.0 == b.0);
        groups.find_map(|group| {
            let mut numbered = group.iter().zip(0..);
            numbered.find_map(|((group, binding), k)| (*binding != k).then_some((*group, *binding, k)))
        })
    }

    /// Each place and each name is used once.
    fn check_unique(&self) -> Result<(), String> {
        let mut places = self.places();
        let mut inputs: Vec<&str> = self.inputs.iter().map(|i| i.name.as_str()).collect();
        let mut outputs: Vec<&str> = self.outputs.iter().map(|o| o.name.as_str()).collect();
        let mut fields: Vec<&str> = self
            .uniforms
            .iter()
            .flat_map(|u| &u.fields)
            .map(|f| f.name.as_str())
            .collect();
        if let Some((group, binding)) = repeated(&mut places) {
            return Err(format!("@group({group}) @binding({binding}) is listed twice"));
        }
        if let Some(name) = repeated(&mut inputs) {
            return Err(format!("input `{name}` is listed twice"));
        }
        if let Some(name) = repeated(&mut outputs) {
            return Err(format!("output `{name}` is listed twice"));
        }
        if let Some(name) = repeated(&mut fields) {
            return Err(format!("uniform `{name}` is listed twice"));
        }
        Ok(())
    }
}

/// The names that the WGSL has in place of the kernel's.
fn spelled(manifest: &Manifest) -> Vec<Spelled> {
    let named = manifest
        .language_bindings
        .iter()
        .filter(|b| b.language == "wgsl" && b.location.is_none());
    let each = named.filter_map(|b| {
        Some(Spelled {
            of: b.of.clone()?,
            binding: b.binding,
            name: b.name.clone(),
        })
    });
    each.collect()
}

/// The stage of `manifest`.
fn stage(manifest: &Manifest) -> Result<StagePlan, String> {
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
            Ok(StagePlan::Compute { workgroup })
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
fn varyings(manifest: &Manifest) -> Result<Vec<Varying>, String> {
    let all = &manifest.varyings;
    require(all.is_empty() || manifest.stage == Stage::Fragment, || {
        "the stage is compute, which interpolates nothing".to_owned()
    })?;
    let mut names: Vec<&str> = all.iter().map(|varying| varying.name.as_str()).collect();
    let mut locations: Vec<u32> = all.iter().map(|varying| varying.location).collect();
    if let Some(name) = repeated(&mut names) {
        return Err(format!("`{name}` is listed twice"));
    }
    if let Some(location) = repeated(&mut locations) {
        return Err(format!("location {location} is listed twice"));
    }
    match all.iter().find(|varying| varying.ty.scalar() != Scalar::F32) {
        Some(varying) => Err(format!(
            "`{}` is of type {}, and floats are interpolated",
            varying.name, varying.ty
        )),
        None => Ok(all.clone()),
    }
}

/// An output of `manifest`, which is to be at `location` in a fragment shader.
fn output(manifest: &Manifest, output: &Output, location: u32) -> Result<OutputPlan, String> {
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
    Ok(OutputPlan {
        name: output.name.clone(),
        place,
        format: output.format,
    })
}

fn require(holds: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}

fn repeated<T: Ord + Copy>(items: &mut [T]) -> Option<T> {
    items.sort_unstable();
    items.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

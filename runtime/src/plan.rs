//! A manifest, checked for itself: what a pass binds, in the terms that the rest of the crate uses.

use crate::Error;
use crate::uniforms::{UniformType, UniformValue};
use straightline_manifest::{Access, Binding, BindingKind, Dimension, Format, Manifest, Stage, UniformField};

/// What to bind where. Every number in it has been checked, except against the device.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) kernel: String,
    pub(crate) entry_point: String,
    pub(crate) textures: Vec<TexturePlan>,
    pub(crate) uniforms: Vec<UniformPlan>,
    pub(crate) output: OutputPlan,
}

/// A texture that the shader reads.
#[derive(Clone, Debug)]
pub(crate) struct TexturePlan {
    pub(crate) name: String,
    pub(crate) group: u32,
    pub(crate) binding: u32,
    pub(crate) dimension: Dimension,
    pub(crate) components: u8,
    pub(crate) layers: u32,
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
    pub(crate) ty: UniformType,
    pub(crate) offset: u32,
    pub(crate) default: Option<UniformValue>,
}

/// Where the result goes, and with it the stage.
#[derive(Debug)]
pub(crate) enum OutputPlan {
    /// Compute.
    Storage {
        name: String,
        group: u32,
        binding: u32,
        format: Format,
        workgroup: [u32; 3],
    },
    /// Fragment, at location 0.
    Attachment { format: Format },
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
        let mut plan = Plan {
            kernel: manifest.kernel.clone(),
            entry_point: manifest.entry_point.clone(),
            textures: Vec::new(),
            uniforms: Vec::new(),
            output: output(manifest).map_err(|problem| bad("output".to_owned(), problem))?,
        };
        for binding in &manifest.bindings {
            let read = plan.add(binding);
            read.map_err(|problem| bad(format!("binding `{}`", binding.name), problem))?;
        }
        plan.check_unique()
            .map_err(|problem| bad("bindings".to_owned(), problem))?;
        Ok(plan)
    }

    fn add(&mut self, source: &Binding) -> Result<(), String> {
        let (name, group, binding) = (source.name.clone(), source.group, source.binding);
        match &source.kind {
            BindingKind::Texture {
                access,
                dimension,
                components,
                layers,
            } => {
                require(*access == Access::Read, || "a texture is only read".to_owned())?;
                require((1..=4).contains(components), || {
                    format!("{components} components, not 1 to 4")
                })?;
                require(*layers >= 1, || "no layers".to_owned())?;
                require(*dimension == Dimension::D2Array || *layers == 1, || {
                    format!("2d, but with {layers} layers")
                })?;
                let (dimension, components, layers) = (*dimension, *components, *layers);
                self.textures.push(TexturePlan {
                    name,
                    group,
                    binding,
                    dimension,
                    components,
                    layers,
                });
            }
            BindingKind::Uniform { access, size, fields } => {
                require(*access == Access::Read, || "a uniform is only read".to_owned())?;
                require(*size > 0 && size % 16 == 0, || {
                    format!("{size} bytes, not a multiple of 16")
                })?;
                let fields = fields.iter().map(|f| field(f, *size)).collect::<Result<Vec<_>, _>>()?;
                self.uniforms.push(UniformPlan {
                    name,
                    group,
                    binding,
                    size: *size,
                    fields,
                });
            }
        }
        Ok(())
    }

    /// Each place and each name is used once.
    fn check_unique(&self) -> Result<(), String> {
        let mut places: Vec<(u32, u32)> = self.textures.iter().map(|t| (t.group, t.binding)).collect();
        places.extend(self.uniforms.iter().map(|u| (u.group, u.binding)));
        if let OutputPlan::Storage { group, binding, .. } = &self.output {
            places.push((*group, *binding));
        }
        let mut inputs: Vec<&str> = self.textures.iter().map(|t| t.name.as_str()).collect();
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
            return Err(format!("texture `{name}` is listed twice"));
        }
        if let Some(name) = repeated(&mut fields) {
            return Err(format!("uniform `{name}` is listed twice"));
        }
        Ok(())
    }
}

fn output(manifest: &Manifest) -> Result<OutputPlan, String> {
    let output = &manifest.output;
    require(output.access == Access::Write, || {
        "the result is only written".to_owned()
    })?;
    match manifest.stage {
        Stage::Compute => {
            let (Some(group), Some(binding)) = (output.group, output.binding) else {
                return Err("the stage is compute, but group and binding are not both given".to_owned());
            };
            require(output.location.is_none(), || {
                "the stage is compute, but a location is given".to_owned()
            })?;
            let Some(workgroup) = manifest.workgroup_size else {
                return Err("the stage is compute, but no workgroup_size is given".to_owned());
            };
            let whole = workgroup[0] > 0 && workgroup[1] > 0 && workgroup[2] == 1;
            require(whole, || format!("workgroup_size {workgroup:?} does not tile an image"))?;
            Ok(OutputPlan::Storage {
                name: output.name.clone(),
                group,
                binding,
                format: output.format,
                workgroup,
            })
        }
        Stage::Fragment => {
            let bound = output.group.is_some() || output.binding.is_some();
            require(!bound, || {
                "the stage is fragment, but a group or binding is given".to_owned()
            })?;
            require(output.location == Some(0), || {
                "the stage is fragment, but the location is not 0".to_owned()
            })?;
            require(manifest.workgroup_size.is_none(), || {
                "the stage is fragment, but has a workgroup_size".to_owned()
            })?;
            Ok(OutputPlan::Attachment { format: output.format })
        }
    }
}

fn field(field: &UniformField, block: u32) -> Result<FieldPlan, String> {
    let UniformField {
        name,
        ty: text,
        offset,
        size,
        default,
    } = field;
    let ty = UniformType::from_wgsl(text)
        .ok_or_else(|| format!("field `{name}` is of type `{text}`, not a 32-bit scalar or vector"))?;
    require(*size == ty.size(), || {
        format!(
            "field `{name}` of type {ty} takes {size} bytes instead of {}",
            ty.size()
        )
    })?;
    require(offset % 4 == 0, || {
        format!("field `{name}` lies at offset {offset}, not a multiple of 4")
    })?;
    let inside = offset.checked_add(*size).is_some_and(|end| end <= block);
    require(inside, || {
        format!("field `{name}` ends beyond the buffer of {block} bytes")
    })?;
    let default = match default {
        None => None,
        Some(value) => Some(
            ty.scalar(*value)
                .ok_or_else(|| format!("the default {value} of field `{name}` is no {ty}"))?,
        ),
    };
    Ok(FieldPlan {
        name: name.clone(),
        ty,
        offset: *offset,
        default,
    })
}

fn require(holds: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}

fn repeated<T: Ord + Copy>(items: &mut [T]) -> Option<T> {
    items.sort_unstable();
    items.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

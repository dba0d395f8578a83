//! Compares a shader with its plan.
//!
//! wgpu checks a shader against the layout it is given, which finds a binding that the layout lacks. It does not
//! find two textures that changed places, a uniform field that moved, or another workgroup size; each of those
//! would run and give a wrong picture.

use crate::spelling::Spelling;
use naga::{AddressSpace, Expression, GlobalVariable, ImageClass, Literal, Module, ScalarKind, ShaderStage, TypeInner};
use straightline_manifest::plan::{
    BufferPlan, InputKind, InputPlan, OutputPlan, Plan, StagePlan, TexturePlan, UniformPlan,
};
use straightline_manifest::{Component, Dimension, Format, OverrideType, SampleType, SamplerType, Scalar, ValueType};

/// Checks that `module` is the shader that `plan` describes, with names as `spelling` has them.
pub fn check_plan(plan: &Plan, spelling: &Spelling<'_>, module: &Module) -> Result<(), String> {
    entry_point(plan, module)?;
    for input in plan.inputs.iter() {
        check_input(spelling, module, input)?;
    }
    for uniform in plan.uniform_structs() {
        check_uniform(spelling, module, uniform)?;
    }
    for output in plan.outputs.iter() {
        if let Some(place) = output.place {
            check_storage(spelling, module, output, place)?;
        }
    }
    check_overrides(plan, module)?;
    nothing_else(plan, module)
}

/// Checks that the overrides are those of the plan, by their numbers, with the same types and defaults.
fn check_overrides(plan: &Plan, module: &Module) -> Result<(), String> {
    for of in plan.overrides.iter() {
        let (name, id) = (&of.name, of.id);
        let numbered = module
            .overrides
            .iter()
            .find(|(_, found)| found.id.map(u32::from) == Some(id));
        let Some((_, found)) = numbered else {
            return Err(format!("it has no override @id({id}), where `{name}` should be"));
        };
        let default = found.init.map(|init| &module.global_expressions[init]);
        let bits = match default {
            Some(Expression::Literal(Literal::F32(number))) => (OverrideType::F32, number.to_bits()),
            Some(Expression::Literal(Literal::I32(number))) => (OverrideType::I32, *number as u32),
            Some(Expression::Literal(Literal::U32(number))) => (OverrideType::U32, *number),
            Some(Expression::Literal(Literal::Bool(on))) => (OverrideType::Bool, u32::from(*on)),
            _ => return Err(format!("the override `{name}` has no default")),
        };
        if bits != (of.ty, of.ty.bits(of.default)) {
            let wanted = (of.ty, of.default);
            return Err(format!(
                "the default of the override `{name}` is not the {} {} of the manifest",
                wanted.0, wanted.1
            ));
        }
    }
    match module.overrides.len() > plan.overrides.len() {
        true => Err(format!(
            "it has {} overrides, and the manifest lists {}",
            module.overrides.len(),
            plan.overrides.len()
        )),
        false => Ok(()),
    }
}

fn entry_point(plan: &Plan, module: &Module) -> Result<(), String> {
    let wanted = match plan.stage {
        StagePlan::Compute { .. } => ShaderStage::Compute,
        StagePlan::Fragment => ShaderStage::Fragment,
    };
    let name = &plan.entry_point;
    let Some(entry) = module.entry_points.iter().find(|entry| entry.name == *name) else {
        let others: Vec<_> = module
            .entry_points
            .iter()
            .map(|entry| format!("`{}`", entry.name))
            .collect();
        return Err(format!("it has no entry point `{name}`, only {}", join_names(&others)));
    };
    if entry.stage != wanted {
        return Err(format!(
            "entry point `{name}` is of stage {:?}, the manifest says {wanted:?}",
            entry.stage
        ));
    }
    match plan.stage {
        StagePlan::Compute { workgroup, .. } if entry.workgroup_size != workgroup => Err(format!(
            "its workgroup size is {:?}, the manifest says {workgroup:?}",
            entry.workgroup_size
        )),
        StagePlan::Compute { .. } => Ok(()),
        StagePlan::Fragment => check_varyings(plan, module, entry).and_then(|()| check_colours(plan, module, entry)),
    }
}

/// Returns the members with a location in a parameter or result of an entry point, or the value itself if it has one.
pub fn located_members(
    module: &Module,
    binding: &Option<naga::Binding>,
    ty: naga::Handle<naga::Type>,
) -> Vec<(naga::Binding, naga::Handle<naga::Type>)> {
    let members = match &module.types[ty].inner {
        TypeInner::Struct { members, .. } => members.as_slice(),
        _ => &[],
    };
    let members = members.iter().map(|member| (&member.binding, member.ty));
    std::iter::once((binding, ty))
        .chain(members)
        .filter_map(|(binding, ty)| match binding {
            Some(found @ naga::Binding::Location { .. }) => Some((found.clone(), ty)),
            _ => None,
        })
        .collect()
}

/// Checks that the interpolated inputs of a fragment shader are those that the manifest lists.
fn check_varyings(plan: &Plan, module: &Module, entry: &naga::EntryPoint) -> Result<(), String> {
    let arguments = entry.function.arguments.iter();
    let found: Vec<_> = arguments
        .flat_map(|a| located_members(module, &a.binding, a.ty))
        .collect();
    for varying in plan.varyings.iter() {
        let at = |binding: &naga::Binding| matches!(binding, naga::Binding::Location { location, .. } if *location == varying.location);
        let fits = found
            .iter()
            .any(|(binding, ty)| at(binding) && is_type(&module.types[*ty].inner, varying.ty));
        if !fits {
            return Err(format!(
                "it takes no `{}` of type {} at location {}",
                varying.name, varying.ty, varying.location
            ));
        }
    }
    match found.len() > plan.varyings.len() {
        true => Err(format!(
            "it takes {} interpolated values, and the manifest lists {}",
            found.len(),
            plan.varyings.len()
        )),
        false => Ok(()),
    }
}

/// The locations of a fragment shader's colours are those of the manifest, and of the same kind and number of components.
fn check_colours(plan: &Plan, module: &Module, entry: &naga::EntryPoint) -> Result<(), String> {
    let result = entry.function.result.as_ref();
    let given = result.map_or_else(Vec::new, |result| located_members(module, &result.binding, result.ty));
    let given = given.into_iter().filter_map(|(binding, ty)| match binding {
        naga::Binding::Location { location, .. } => Some((location, ty)),
        naga::Binding::BuiltIn(_) => None,
    });
    let mut found: Vec<(u32, naga::Handle<naga::Type>)> = given.collect();
    found.sort_unstable_by_key(|(location, _)| *location);
    let fits = |(k, output): (usize, &OutputPlan)| {
        let Some((location, ty)) = found.get(k) else {
            return false;
        };
        let (components, kind) = match module.types[*ty].inner {
            TypeInner::Scalar(scalar) => (1, scalar.kind),
            TypeInner::Vector { size, scalar } => (size as u8, scalar.kind),
            _ => return false,
        };
        *location as usize == k && components == output.format.components() && kind == scalar_kind(output.format)
    };
    match plan.outputs.iter().enumerate().find(|(k, output)| !fits((*k, output))) {
        Some((k, output)) => Err(format!(
            "it gives no `{}` for {} at location {k}",
            output.name, output.format
        )),
        None if found.len() > plan.outputs.len() => Err(format!(
            "it gives {} colours, and the manifest lists {}",
            found.len(),
            plan.outputs.len()
        )),
        None => Ok(()),
    }
}

fn scalar_kind(format: Format) -> ScalarKind {
    match format.component_type() {
        Component::Float => ScalarKind::Float,
        Component::Uint => ScalarKind::Uint,
        Component::Sint => ScalarKind::Sint,
    }
}

/// The variable at a place, which must be called `name`, as the text spells it.
fn find_variable<'m>(
    spelling: &Spelling<'_>,
    module: &'m Module,
    name: &str,
    (group, binding): (u32, u32),
) -> Result<&'m GlobalVariable, String> {
    let name = spelling.of_binding(name, binding);
    let at_place = |v: &GlobalVariable| {
        v.binding
            .as_ref()
            .is_some_and(|b| b.group == group && b.binding == binding)
    };
    let Some((_, variable)) = module.global_variables.iter().find(|(_, v)| at_place(v)) else {
        return Err(format!(
            "it has nothing at @group({group}) @binding({binding}), where `{name}` should be"
        ));
    };
    match variable.name.as_deref() {
        Some(found) if found == name => Ok(variable),
        found => Err(format!(
            "`{}` is at @group({group}) @binding({binding}), where `{name}` should be",
            found.unwrap_or("<unnamed>")
        )),
    }
}

/// The variable of immediates, which must be called `name`, as the text spells it. A module has one at most.
fn find_immediates<'m>(spelling: &Spelling<'_>, module: &'m Module, name: &str) -> Result<&'m GlobalVariable, String> {
    let name = spelling.of_immediates(name);
    let mut variables = module.global_variables.iter().map(|(_, variable)| variable);
    let found =
        variables.find(|variable| variable.space == AddressSpace::Immediate && variable.name.as_deref() == Some(name));
    found.ok_or_else(|| format!("it has no immediates `{name}`"))
}

fn check_input(spelling: &Spelling<'_>, module: &Module, plan: &InputPlan) -> Result<(), String> {
    let variable = find_variable(spelling, module, &plan.name, (plan.group, plan.binding))?;
    let found = &module.types[variable.ty].inner;
    let (fits, wanted) = match &plan.kind {
        InputKind::Texture(texture) => {
            let (inner, text) = texture_type(texture);
            (*found == inner, text)
        }
        InputKind::Sampler(sampler) => {
            let (comparison, text) = match sampler {
                SamplerType::Filtering | SamplerType::NonFiltering => (false, "sampler"),
                SamplerType::Comparison => (true, "sampler_comparison"),
            };
            (*found == TypeInner::Sampler { comparison }, text.to_owned())
        }
        InputKind::Buffer(buffer) => (
            is_buffer(module, variable, buffer),
            match buffer.element {
                Some(element) => format!("var<storage, read> of type array<{element}>"),
                None => format!(
                    "var<storage, read> of an array of structures of {} bytes",
                    buffer.stride
                ),
            },
        ),
    };
    if fits {
        Ok(())
    } else {
        Err(format!("`{}` is not a `{wanted}`", plan.name))
    }
}

/// The type of a texture, and how WGSL spells it.
fn texture_type(plan: &TexturePlan) -> (TypeInner, String) {
    use naga::ImageDimension::{Cube, D2, D3};
    let (dim, arrayed, multi, shape) = match plan.dimension {
        Dimension::D2 => (D2, false, false, "2d"),
        Dimension::D2Array => (D2, true, false, "2d_array"),
        Dimension::D3 => (D3, false, false, "3d"),
        Dimension::Cube => (Cube, false, false, "cube"),
        Dimension::D2Multisampled => (D2, false, true, "multisampled_2d"),
    };
    let (kind, texel) = match plan.sample_type {
        SampleType::Depth => {
            let class = ImageClass::Depth { multi };
            return (
                TypeInner::Image { dim, arrayed, class },
                format!("texture_depth_{shape}"),
            );
        }
        SampleType::Unfilterable | SampleType::Filterable => (ScalarKind::Float, "f32"),
        SampleType::Sint => (ScalarKind::Sint, "i32"),
        SampleType::Uint => (ScalarKind::Uint, "u32"),
    };
    let class = ImageClass::Sampled { kind, multi };
    (
        TypeInner::Image { dim, arrayed, class },
        format!("texture_{shape}<{texel}>"),
    )
}

/// Returns whether `variable` is a storage buffer of `plan`'s elements, atomic ones among them, accessed as `plan` says.
fn is_buffer(module: &Module, variable: &GlobalVariable, plan: &BufferPlan) -> bool {
    let access = AddressSpace::Storage {
        access: match plan.written {
            true => naga::StorageAccess::LOAD | naga::StorageAccess::STORE,
            false => naga::StorageAccess::LOAD,
        },
    };
    let TypeInner::Array { base, size, stride } = module.types[variable.ty].inner else {
        return false;
    };
    let element = match module.types[base].inner {
        TypeInner::Atomic(scalar) if plan.written => TypeInner::Scalar(scalar),
        ref other => other.clone(),
    };
    variable.space == access
        && size == naga::ArraySize::Dynamic
        && stride == plan.stride
        && match (&element, plan.element) {
            (inner, Some(element)) => is_type(inner, element),
            (TypeInner::Struct { span, .. }, None) => *span == plan.stride,
            (_, None) => false,
        }
}

fn check_storage(
    spelling: &Spelling<'_>,
    module: &Module,
    OutputPlan { name, format, .. }: &OutputPlan,
    place: (u32, u32),
) -> Result<(), String> {
    let variable = find_variable(spelling, module, name, place)?;
    let wanted = TypeInner::Image {
        dim: naga::ImageDimension::D2,
        arrayed: false,
        class: ImageClass::Storage {
            format: match format {
                Format::Rgba8Unorm => naga::StorageFormat::Rgba8Unorm,
                Format::Rgba16Float => naga::StorageFormat::Rgba16Float,
                Format::Rgba32Float => naga::StorageFormat::Rgba32Float,
                Format::R32Float => naga::StorageFormat::R32Float,
                Format::Rg32Float => naga::StorageFormat::Rg32Float,
                Format::R32Uint => naga::StorageFormat::R32Uint,
                Format::Rg32Uint => naga::StorageFormat::Rg32Uint,
                Format::Rgba32Uint => naga::StorageFormat::Rgba32Uint,
                Format::R32Sint => naga::StorageFormat::R32Sint,
                Format::Rg32Sint => naga::StorageFormat::Rg32Sint,
                Format::Rgba32Sint => naga::StorageFormat::Rgba32Sint,
            },
            access: naga::StorageAccess::STORE,
        },
    };
    if module.types[variable.ty].inner == wanted {
        return Ok(());
    }
    Err(format!("`{name}` is not a `texture_storage_2d<{format}, write>`"))
}

fn check_uniform(spelling: &Spelling<'_>, module: &Module, plan: &UniformPlan) -> Result<(), String> {
    let name = &plan.name;
    let (variable, space, word) = match plan.place {
        Some(place) => (
            find_variable(spelling, module, name, place)?,
            AddressSpace::Uniform,
            "uniform",
        ),
        None => (
            find_immediates(spelling, module, name)?,
            AddressSpace::Immediate,
            "immediate",
        ),
    };
    let TypeInner::Struct { members, span } = &module.types[variable.ty].inner else {
        return Err(format!("`{name}` is not a struct"));
    };
    if variable.space != space {
        return Err(format!("`{name}` is not a `var<{word}>`"));
    }
    if *span > plan.size {
        return Err(format!("`{name}` takes {span} bytes, the manifest says {}", plan.size));
    }
    for field in plan.fields.iter() {
        let Some(member) = members
            .iter()
            .find(|m| m.name.as_deref() == Some(spelling.of_member(&field.name)))
        else {
            return Err(format!("`{name}` has no member `{}`", field.name));
        };
        if member.offset != field.offset {
            let (found, wanted) = (member.offset, field.offset);
            return Err(format!(
                "`{name}.{}` lies at offset {found}, the manifest says {wanted}",
                field.name
            ));
        }
        if !is_type(&module.types[member.ty].inner, field.ty) {
            return Err(format!("`{name}.{}` is not of type {}", field.name, field.ty));
        }
    }
    match members.iter().find(|m| {
        plan.fields
            .iter()
            .all(|f| m.name.as_deref() != Some(spelling.of_member(&f.name)))
    }) {
        None => Ok(()),
        Some(member) => {
            let member = member.name.as_deref().unwrap_or("<unnamed>");
            Err(format!(
                "`{name}` has a member `{member}` that the manifest does not list"
            ))
        }
    }
}

pub fn is_type(inner: &TypeInner, ty: ValueType) -> bool {
    let (components, scalar) = match *inner {
        TypeInner::Scalar(scalar) => (1, scalar),
        TypeInner::Vector { size, scalar } => (size as u8, scalar),
        _ => return false,
    };
    let kind = match ty.scalar() {
        Scalar::F32 => ScalarKind::Float,
        Scalar::I32 => ScalarKind::Sint,
        Scalar::U32 => ScalarKind::Uint,
    };
    components == ty.components() && scalar.kind == kind && scalar.width == 4
}

/// Every resource of the shader is in the manifest.
fn nothing_else(plan: &Plan, module: &Module) -> Result<(), String> {
    let mut known: Vec<(u32, u32)> = plan.inputs.iter().map(|i| (i.group, i.binding)).collect();
    known.extend(plan.uniform_structs().filter_map(|uniform| uniform.place));
    known.extend(plan.outputs.iter().filter_map(|output| output.place));
    for (_, variable) in module.global_variables.iter() {
        let name = variable.name.as_deref().unwrap_or("<unnamed>");
        if variable.space == AddressSpace::Immediate && plan.immediate_size() == 0 {
            return Err(format!("it uses the immediates `{name}`, which the manifest lacks"));
        }
        if let Some(place) = &variable.binding
            && !known.contains(&(place.group, place.binding))
        {
            let (group, binding) = (place.group, place.binding);
            return Err(format!(
                "it uses `{name}` at @group({group}) @binding({binding}), which the manifest lacks"
            ));
        }
    }
    Ok(())
}

fn join_names(names: &[String]) -> String {
    if names.is_empty() {
        "none at all".to_owned()
    } else {
        names.join(", ")
    }
}

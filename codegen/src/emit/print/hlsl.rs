//! HLSL of shader model 5.1 and later.

mod declarations;

use super::expr::{float_literal, integer_literal, unsigned_literal};
use super::overrides::PrintOverrides;
use super::{Language, Text, header_comment};
use crate::emit::DebugInfo;
use crate::emit::ast::{Builtin, Effect, Expr, Module, Op, Ty};
use crate::emit::derived::Derived;
use crate::emit::host_reads;
use crate::emit::own_words::{UNIFORMS, VARIABLE};
use crate::emit::resources::Resources;
use declarations::{structure_declarations, uniform_members};
use straightline_evaluator::ir::{self, AtomicOp, Axis, BinaryOp, QuadDirection, Scalar, Span, TextureKind, UnaryOp};
use straightline_manifest::{Format, REGION, Stage};

pub use declarations::{buffer_declared, sampler_declared, texture_declared, type_name, variable_declared};

/// HLSL.
pub struct Hlsl<'a> {
    pub(super) resources: &'a Resources,
    /// Functions that query the size of a resource.
    sizes: Vec<Size>,
}

/// A size that a shader queries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Size {
    Texture(u32),
    Levels(u32),
    Layers(u32),
    Buffer(u32),
    Output,
}

impl Size {
    fn from_op(op: &Op) -> Option<Size> {
        match op {
            Op::Ir(ir::Op::TextureSize(texture)) => Some(Size::Texture(*texture)),
            Op::Ir(ir::Op::TextureLevels(texture)) => Some(Size::Levels(*texture)),
            Op::Ir(ir::Op::TextureLayers(texture)) => Some(Size::Layers(*texture)),
            Op::Ir(ir::Op::BufferLen(buffer)) => Some(Size::Buffer(*buffer)),
            Op::Builtin(Builtin::OutputSize) => Some(Size::Output),
            _ => None,
        }
    }
}

impl<'a> Hlsl<'a> {
    /// Creates the printer for a module.
    pub fn new(resources: &'a Resources, module: &Module<'_>) -> Hlsl<'a> {
        let mut sizes = Vec::new();
        let mut see = |expr: &Expr| {
            if let Some(size) = Size::from_op(&expr.op)
                && !sizes.contains(&size)
            {
                sizes.push(size);
            }
        };
        module.body.iter().for_each(|stmt| stmt.visit(&mut see));
        Hlsl { resources, sizes }
    }

    fn is_function(&self) -> bool {
        self.resources.options.is_function()
    }

    /// Returns the call that queries a size.
    fn size_call(&self, size: Size) -> Text {
        let name = match size {
            Size::Texture(texture) | Size::Levels(texture) | Size::Layers(texture) => {
                &self.resources.texture(texture).name
            }
            Size::Buffer(buffer) => &self.resources.buffer(buffer).name,
            Size::Output => self.resources.sized_output(),
        };
        let name = Text::name(name);
        let given = self.is_function().then_some(&name);
        Text::call(self.size_of(size), &given.into_iter().collect::<Vec<_>>())
    }

    fn size_of(&self, size: Size) -> &str {
        self.resources.derived_name(match size {
            Size::Texture(texture) => Derived::Size(texture),
            Size::Levels(texture) => Derived::Levels(texture),
            Size::Layers(texture) => Derived::Layers(texture),
            Size::Buffer(buffer) => Derived::Length(buffer),
            Size::Output => Derived::OutputSize,
        })
    }

    /// Returns the function that queries a size, which HLSL returns through out parameters.
    fn size_function(&self, size: Size) -> String {
        let name = self.size_of(size);
        let taken = match (self.is_function(), size) {
            (false, _) | (_, Size::Output) => None,
            (_, Size::Buffer(buffer)) => Some(buffer_declared(self.resources, buffer)),
            (_, Size::Texture(texture) | Size::Levels(texture) | Size::Layers(texture)) => {
                Some(texture_declared(self.resources, texture))
            }
        };
        let taken = taken.unwrap_or_default();
        let (what, mut variables, result) = match size {
            Size::Output => (
                self.resources.sized_output(),
                vec!["width", "height"],
                "int2(width, height)",
            ),
            Size::Buffer(buffer) => (
                self.resources.buffer(buffer).name.as_str(),
                vec!["count", "stride"],
                "int(count)",
            ),
            Size::Texture(texture) | Size::Levels(texture) | Size::Layers(texture) => {
                let texture = self.resources.texture(texture);
                let mut variables = vec!["width", "height"];
                variables.extend(match texture.kind {
                    TextureKind::Volume => Some("depth"),
                    TextureKind::Layers | TextureKind::DepthLayers => Some("layers"),
                    TextureKind::Multisampled => Some("samples"),
                    TextureKind::Flat | TextureKind::Depth | TextureKind::Cube | TextureKind::DepthCube => None,
                });
                let result = match (size, texture.kind) {
                    (Size::Levels(_), _) => "int(levels)",
                    (Size::Layers(_), _) => "int(layers)",
                    (_, TextureKind::Volume) => "int3(width, height, depth)",
                    _ => "int2(width, height)",
                };
                (texture.name.as_str(), variables, result)
            }
        };
        let level = matches!(size, Size::Levels(_)).then_some("0");
        if level.is_some() {
            variables.push("levels");
        }
        let ty = result.split('(').next().unwrap_or_default();
        // Renames a local variable that would shadow the resource of the same name.
        let apart = |text: &str| match variables.contains(&what) {
            true => text.replace(what, &format!("{what}_of_it")),
            false => text.to_owned(),
        };
        let result = apart(result);
        let variables: Vec<String> = variables.iter().map(|variable| apart(variable)).collect();
        let arguments: Vec<&str> = level.into_iter().chain(variables.iter().map(String::as_str)).collect();
        format!(
            "{ty} {name}({taken}) {{\n    uint {};\n    {what}.GetDimensions({});\n    return {result};\n}}\n",
            variables.join(", "),
            arguments.join(", ")
        )
    }

    /// Packs coordinates and layer into one vector.
    fn pack_coordinates(&self, texture: u32, args: &[Text]) -> Text {
        match self.resources.texture(texture).kind.has_layers() {
            true => Text::call("float3", &[&args[0], &Text::call("float", &[&args[1]])]),
            false => args[0].clone(),
        }
    }

    /// Returns a call of a texture's method, with a sampler.
    fn sample_call(&self, texture: u32, method: &str, sampler: u32, args: &[&Text]) -> Text {
        let texture = &self.resources.texture(texture).name;
        let sampler = Text::name(self.resources.sampler(sampler).name.as_str());
        let mut all = vec![&sampler];
        all.extend(args);
        Text::call(&format!("{texture}.{method}"), &all)
    }
}

impl Language for Hlsl<'_> {
    fn type_spelling(&self, ty: Ty) -> String {
        type_name(ty)
    }

    fn scalar_literal(&self, kind: Scalar, half: bool, bits: u32) -> Text {
        match kind {
            Scalar::F32 if half => crate::emit::half::half_literal(bits),
            Scalar::F32 => float_literal(bits),
            // The smallest `int` cannot be written as a literal.
            Scalar::I32 if bits as i32 == i32::MIN => Text::name("(-2147483647 - 1)"),
            Scalar::I32 => integer_literal(i64::from(bits as i32), ""),
            Scalar::U32 | Scalar::Usize => unsigned_literal(bits),
            Scalar::Bool => Text::name(if bits != 0 { "true" } else { "false" }),
        }
    }

    fn builtin_value(&self, builtin: Builtin) -> Text {
        match builtin {
            Builtin::Invocation => Text::name("int2(id.xy)"),
            Builtin::Local => Text::name("int2(local_id.xy)"),
            Builtin::LocalIndex => Text::name("int(local_index)"),
            Builtin::Group => Text::name("int2(group_id.xy)"),
            Builtin::Position if self.is_function() => Text::name("position"),
            Builtin::Position => Text::name("position.xy"),
            Builtin::OutputSize => self.size_call(Size::Output),
            Builtin::RegionFirst => Text::name(format!("{REGION}.first")),
            Builtin::RegionSize => Text::name(format!("{REGION}.size")),
            Builtin::RegionPlace => Text::name(format!("{REGION}.place")),
        }
    }

    fn function_name(&self, op: &ir::Op) -> &'static str {
        match op {
            ir::Op::Unary(UnaryOp::Fract) => "frac",
            ir::Op::Unary(UnaryOp::InverseSqrt) => "rsqrt",
            ir::Op::Unary(UnaryOp::ReverseBits) => "reversebits",
            other => super::expr::wgsl_function(other),
        }
    }

    fn resource_read(&self, op: &ir::Op, args: &[Text]) -> Text {
        if let Some(call) = host_reads::host_call(self.resources, op, args) {
            return call;
        }
        let r = self.resources;
        let zero = Text::name("0");
        match op {
            ir::Op::Uniform(k) if self.is_function() => Text::name(r.uniform_name(*k)),
            ir::Op::Uniform(k) => Text::name(format!("{UNIFORMS}.{}", r.uniform_name(*k))),
            ir::Op::Override(k) => Text::name(r.bound_override(*k).of.name.as_str()),
            ir::Op::Varying(k) => Text::name(r.varying_name(*k)),
            ir::Op::TextureSize(texture) => self.size_call(Size::Texture(*texture)),
            ir::Op::TextureLevels(texture) => self.size_call(Size::Levels(*texture)),
            ir::Op::TextureLayers(texture) => self.size_call(Size::Layers(*texture)),
            ir::Op::BufferLen(buffer) => self.size_call(Size::Buffer(*buffer)),
            ir::Op::Load { texture, .. } => {
                let texture = r.texture(*texture);
                let load = format!("{}.Load", texture.name);
                if texture.kind == TextureKind::Multisampled {
                    return Text::call(&load, &[&args[0], &args[1]]);
                }
                let levelled = args.len() > 1 + usize::from(texture.kind.is_indexed());
                let mut parts: Vec<&Text> = args.iter().collect();
                if !levelled {
                    parts.push(&zero);
                }
                let lanes = usize::from(texture.kind.dimension_count()) + parts.len() - 1;
                Text::call(&load, &[&Text::call(&format!("int{lanes}"), &parts)])
            }
            ir::Op::Sample { texture, sampler, .. } => {
                let place = self.pack_coordinates(*texture, args);
                let layers = usize::from(r.texture(*texture).kind.has_layers());
                match &args[1 + layers..] {
                    [] => self.sample_call(*texture, "SampleLevel", *sampler, &[&place, &Text::name("0.0")]),
                    [level] => self.sample_call(*texture, "SampleLevel", *sampler, &[&place, level]),
                    [across, down, ..] => self.sample_call(*texture, "SampleGrad", *sampler, &[&place, across, down]),
                }
            }
            ir::Op::Gather {
                texture,
                sampler,
                component,
                ..
            } => {
                let method = ["GatherRed", "GatherGreen", "GatherBlue", "GatherAlpha"][*component as usize & 3];
                self.sample_call(*texture, method, *sampler, &[&self.pack_coordinates(*texture, args)])
            }
            ir::Op::Compare { texture, sampler, .. } => {
                let place = self.pack_coordinates(*texture, args);
                let reference = args.last().unwrap_or(&zero);
                self.sample_call(*texture, "SampleCmpLevelZero", *sampler, &[&place, reference])
            }
            ir::Op::GatherCompare { texture, sampler, .. } => {
                self.sample_call(*texture, "GatherCmp", *sampler, &[&args[0], &args[1]])
            }
            ir::Op::SharedLoad(shared) => Text::index(&Text::name(r.shared[*shared as usize].name.as_str()), &args[0]),
            ir::Op::BufferLoad { buffer, field, .. } => {
                let buffer = r.buffer(*buffer);
                let element = Text::index(&Text::name(buffer.name.as_str()), &args[0]);
                let part = super::element_part(&element, &buffer.element, *field, args.get(1));
                match (buffer.element.field_type(*field), args.len()) {
                    // An array element of three components occupies the space of four.
                    (Some(ty), 2) if ty.component_count() == 3 => Text::member(&part, "xyz"),
                    _ => part,
                }
            }
            ir::Op::QuadSwap(direction) => {
                let function = match direction {
                    QuadDirection::Horizontal => "QuadReadAcrossX",
                    QuadDirection::Vertical => "QuadReadAcrossY",
                    QuadDirection::Diagonal => "QuadReadAcrossDiagonal",
                };
                Text::call(function, &[&args[0]])
            }
            ir::Op::Derivative(axis) => {
                let function = if *axis == Axis::X { "ddx_fine" } else { "ddy_fine" };
                Text::call(function, &[&args[0]])
            }
            other => unreachable!("{other:?} is no read"),
        }
    }

    fn scalar_select(&self, _: Ty, condition: &Text, yes: &Text, no: &Text) -> Text {
        Text::choice(condition, yes, no)
    }

    // Scalars only: functions of vectors call those of scalars.
    fn component_select(&self, condition: &Text, yes: &Text, no: &Text) -> Text {
        Text::choice(condition, yes, no)
    }

    fn construct(&self, ty: Ty, parts: &[&Text]) -> Text {
        match parts {
            // A cast broadcasts one scalar to all components.
            [one] if ty.component_count() > 1 && !ty.is_array() => Text::prefix(&format!("({})", type_name(ty)), one),
            _ => Text::call(&type_name(ty), parts),
        }
    }

    fn splat(&self, ty: Ty, component: &Text) -> Text {
        Text::call(&type_name(ty), &vec![component; ty.component_count() as usize])
    }

    fn table_value(&self, _: Ty, parts: &[&Text]) -> Text {
        Text::list("{ ".to_owned(), parts, " }")
    }

    fn logical_operator(&self, op: BinaryOp, kind: Scalar) -> &'static str {
        match (op, kind) {
            (BinaryOp::And, Scalar::Bool) => "&&",
            (_, Scalar::Bool) => "||",
            (BinaryOp::And, _) => "&",
            _ => "|",
        }
    }

    fn let_head(&self, name: &str, ty: Ty) -> String {
        variable_declared(name, ty)
    }

    fn var_head(&self, name: &str, ty: Ty, _: bool) -> String {
        variable_declared(name, ty)
    }

    fn table_head(&self, name: &str, ty: Ty) -> String {
        format!("static const {}", variable_declared(name, ty))
    }

    fn loop_head(&self, counter: &str, ty: Ty, start: &str, bound: &str) -> String {
        format!("for ({} {counter} = {start}; {bound}; {counter}++) {{", type_name(ty))
    }

    fn if_head(&self) -> [&'static str; 2] {
        ["if (", ") {"]
    }

    fn function_head(&self, name: &str, params: &[(&str, Ty)], result: Ty) -> String {
        let params: Vec<String> = params.iter().map(|(name, ty)| variable_declared(name, *ty)).collect();
        format!("{} {name}({}) {{", type_name(result), params.join(", "))
    }

    fn texel_store(&self, output: usize, place: &Text, value: &Text) -> Text {
        let name = &self.resources.outputs[output].name;
        Text::list(format!("{name}[{}] = ", place.code), &[value], "")
    }

    fn effect_statement(&self, effect: &Effect, args: &[Text], before: Option<&str>) -> (String, Text) {
        let name = self.resources.element_and_name(effect.memory).1;
        let place = Text::index(&Text::name(name), &args[0]);
        let Some(op) = effect.op else {
            return (format!("{} = ", place.code), args[1].clone());
        };
        // HLSL has no atomic load; an atomic `or` with 0 changes nothing.
        let (function, value) = match op {
            AtomicOp::Load => ("InterlockedOr".to_owned(), Text::name("0")),
            op => (format!("Interlocked{op:?}"), args[1].clone()),
        };
        let before = before.map(Text::name);
        let all: Vec<&Text> = [&place, &value].into_iter().chain(&before).collect();
        (String::new(), Text::call(&function, &all))
    }

    fn unsigned_length(&self, buffer: u32) -> Text {
        Text::call("uint", &[&self.size_call(Size::Buffer(buffer))])
    }

    fn gives_before(&self) -> bool {
        false
    }

    fn barrier_statements(&self, buffers: bool) -> &'static [&'static str] {
        match buffers {
            true => &["AllMemoryBarrierWithGroupSync();"],
            false => &["GroupMemoryBarrierWithGroupSync();"],
        }
    }

    fn output_statements(&self, values: &[Text]) -> Vec<(String, Text)> {
        let returned = |value: Text| ("return ".to_owned(), value);
        match values {
            [one] => vec![returned(one.clone())],
            several => {
                let r = self.resources;
                let mut lines = vec![(format!("{} ", r.outputs_type()), Text::name(VARIABLE))];
                let assigned = r.outputs.iter().zip(several);
                lines.extend(assigned.map(|(o, value)| (format!("{VARIABLE}.{} = ", o.name), value.clone())));
                lines.push(returned(Text::name(VARIABLE)));
                lines
            }
        }
    }

    fn preamble(&self, header: &[String]) -> String {
        let r = self.resources;
        let mut out = String::new();
        out += &header_comment(header);
        out.push('\n');
        out += &structure_declarations(r);
        let overrides = self.override_macros(|ty, name, value| format!("static const {ty} {name} = {value};"));
        if self.is_function() {
            if !overrides.is_empty() {
                out += &format!("{overrides}\n");
            }
            if r.outputs.len() > 1 {
                out += &format!("{}\n", self.outputs_structure());
            }
            for size in self.sizes.iter().filter(|_| !r.options.calls_host()) {
                out += &format!("{}\n", self.size_function(*size));
            }
            return out.trim_end().to_owned() + "\n";
        }
        for bound in &r.read {
            let register = r.places.register_at('t', bound.binding);
            out += &format!("{} : register({register});\n", texture_declared(r, bound.index));
        }
        for (k, binding) in &r.read_buffers {
            let register = r.places.register_at(r.buffer_class(*k), *binding);
            out += &format!("{} : register({register});\n", buffer_declared(r, *k));
        }
        for (k, binding) in &r.used_samplers {
            let register = r.places.register_at('s', *binding);
            out += &format!("{} : register({register});\n", sampler_declared(r, *k));
        }
        for output in &r.outputs {
            let Some(binding) = output.binding else { continue };
            let unorm = if output.format == Format::Rgba8Unorm {
                "unorm "
            } else {
                ""
            };
            let texel = type_name(output.texel_type().into());
            let register = r.places.register_at('u', binding);
            out += &format!("RWTexture2D<{unorm}{texel}> {} : register({register});\n", output.name);
        }
        if let Some(binding) = r.uniform_binding() {
            out += "\nstruct Parameters {\n";
            for line in uniform_members(r) {
                out += &format!("    {line};\n");
            }
            let register = r.places.register_at('b', binding);
            out += "};\n\n";
            out += &match r.has_immediates() {
                // DXC warns of the attribute unless it writes SPIR-V.
                true => format!(
                    "#ifdef __spirv__\n[[vk::push_constant]]\n#endif\nConstantBuffer<Parameters> {UNIFORMS} : register({register});\n"
                ),
                false => {
                    format!("cbuffer Parameters_buffer : register({register}) {{\n    Parameters {UNIFORMS};\n}}\n")
                }
            };
        }
        if let Some(binding) = r.region_binding() {
            out += &format!("\nstruct Region {{\n    {}\n", r.region_comment());
            out += "    int2 first;\n    int2 size;\n    int2 place;\n};\n\n";
            let register = r.places.register_at('b', binding);
            out += &format!("cbuffer Region_buffer : register({register}) {{\n    Region {REGION};\n}}\n");
        }
        if !overrides.is_empty() {
            out += &format!("\n{overrides}");
        }
        for shared in r.shared_memory() {
            let element = type_name(shared.element.into());
            out += &format!("groupshared {element} {}[{}];\n", shared.name, shared.len);
        }
        for size in &self.sizes {
            out += &format!("\n{}", self.size_function(*size));
        }
        if r.options.stage == Stage::Fragment && r.outputs.len() > 1 {
            out += &format!("\n{}", self.outputs_structure());
        }
        out
    }

    fn line_directive(&self, span: &Span) -> Option<String> {
        let lines = self.resources.options.debug == DebugInfo::Lines;
        let path = self.resources.files.get(span.file as usize)?;
        let escaped = path.replace('\\', "\\\\").replace('"', "\\\"");
        lines.then(|| format!("#line {} \"{escaped}\"", span.line))
    }

    fn entry_head(&self) -> String {
        if self.is_function() {
            return self.kernel_function_head();
        }
        let r = self.resources;
        let entry = &r.entry;
        match r.options.stage {
            Stage::Compute => {
                let [x, y, z] = r.workgroup_size();
                let mut told = vec!["uint3 id : SV_DispatchThreadID"];
                let zeroes = r.is_zeroed();
                told.extend(r.asks_local.then_some("uint3 local_id : SV_GroupThreadID"));
                told.extend(zeroes.then_some("uint local_index : SV_GroupIndex"));
                told.extend(r.asks_group.then_some("uint3 group_id : SV_GroupID"));
                format!("[numthreads({x}, {y}, {z})]\nvoid {entry}({}) {{", told.join(", "))
            }
            Stage::Fragment => {
                let varyings = r.varyings.iter().enumerate().map(|(k, varying)| {
                    let declared = variable_declared(&varying.name, varying.ty.into());
                    format!(", {declared} : TEXCOORD{k}")
                });
                let varyings: String = varyings.collect();
                let (result, semantic) = match &r.outputs[..] {
                    [one] => (type_name(one.texel_type().into()), " : SV_Target0"),
                    _ => (r.outputs_type(), ""),
                };
                format!("{result} {entry}(float4 position : SV_Position{varyings}){semantic} {{")
            }
        }
    }
}

impl Hlsl<'_> {
    /// Declares the structure of several outputs; for an entry point with their locations.
    fn outputs_structure(&self) -> String {
        let r = self.resources;
        let fields = r
            .outputs
            .iter()
            .enumerate()
            .map(|(k, output)| match self.is_function() {
                true => format!("    {};\n", variable_declared(&output.name, output.ty.into())),
                false => format!(
                    "    {} : SV_Target{k};\n",
                    variable_declared(&output.name, output.texel_type().into())
                ),
            });
        format!("struct {} {{\n{}}};\n", r.outputs_type(), fields.collect::<String>())
    }

    /// Returns the result type of a function.
    pub(super) fn result_type(&self) -> String {
        match &self.resources.outputs[..] {
            [one] => type_name(one.ty.into()),
            _ => self.resources.outputs_type(),
        }
    }
}

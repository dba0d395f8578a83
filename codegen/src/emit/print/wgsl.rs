//! WGSL as WebGPU and wgpu read it.

use super::expr::{float_literal, integer_literal, unsigned_literal};
use super::overrides::PrintOverrides;
use super::{Language, Text, header_comment};
use crate::emit::ast::{Builtin, Effect, Ty};
use crate::emit::derived::Derived;
use crate::emit::host_reads;
use crate::emit::outputs::{BoundOutput, one_bits};
use crate::emit::own_words::UNIFORMS;
use crate::emit::resources::Resources;
use std::fmt::Write;
use straightline_evaluator::ir::{
    self, Access, Axis, BinaryOp, Element, QuadDirection, Scalar, Texture, TextureKind, Type,
};
use straightline_manifest::{REGION, Stage};

/// WGSL.
pub struct Wgsl<'a> {
    /// The shader's bindings.
    pub resources: &'a Resources,
}

impl Wgsl<'_> {
    fn texture_and_sampler(&self, texture: u32, sampler: u32) -> [Text; 2] {
        let texture = self.resources.texture(texture).name.as_str();
        let sampler = self.resources.sampler(sampler).name.as_str();
        [texture, sampler].map(Text::name)
    }

    /// Returns the number of levels or layers of a texture, as `i32`.
    fn count_call(&self, function: &str, texture: u32) -> Text {
        let name = Text::name(self.resources.texture(texture).name.as_str());
        Text::call("i32", &[&Text::call(function, &[&name])])
    }
}

impl Language for Wgsl<'_> {
    fn type_spelling(&self, ty: Ty) -> String {
        ty.short_name()
    }

    fn scalar_literal(&self, kind: Scalar, half: bool, bits: u32) -> Text {
        match kind {
            Scalar::F32 if half => crate::emit::half::half_literal(bits),
            Scalar::F32 => float_literal(bits),
            Scalar::I32 if bits as i32 == i32::MIN => Text::name("i32(-2147483648)"),
            Scalar::I32 => integer_literal(i64::from(bits as i32), ""),
            Scalar::U32 | Scalar::Usize => unsigned_literal(bits),
            Scalar::Bool => Text::name(if bits != 0 { "true" } else { "false" }),
        }
    }

    fn builtin_value(&self, builtin: Builtin) -> Text {
        match builtin {
            Builtin::Invocation => Text::name("vec2i(id.xy)"),
            Builtin::Local => Text::name("vec2i(local_id.xy)"),
            Builtin::LocalIndex => Text::name("i32(local_index)"),
            Builtin::Group => Text::name("vec2i(group_id.xy)"),
            Builtin::Position if self.function_leads() => Text::name("position"),
            Builtin::Position => Text::name("position.xy"),
            Builtin::OutputSize => Text::name(format!("vec2i(textureDimensions({}))", self.resources.sized_output())),
            Builtin::RegionFirst => Text::name(format!("{REGION}.first")),
            Builtin::RegionSize => Text::name(format!("{REGION}.size")),
            Builtin::RegionPlace => Text::name(format!("{REGION}.place")),
        }
    }

    fn resource_read(&self, op: &ir::Op, args: &[Text]) -> Text {
        if let Some(call) = host_reads::host_call(self.resources, op, args) {
            return call;
        }
        match op {
            ir::Op::Uniform(k) if self.function_leads() => Text::name(self.resources.uniform_name(*k)),
            ir::Op::Uniform(k) => Text::name(format!("{UNIFORMS}.{}", self.resources.uniform_name(*k))),
            ir::Op::Override(k) => Text::name(self.resources.derived_name(Derived::Held(*k))),
            ir::Op::Varying(k) => Text::name(self.resources.varying_name(*k)),
            ir::Op::TextureSize(texture) => {
                let name = Text::name(self.resources.texture(*texture).name.as_str());
                let ty = Ty::from(self.resources.texture(*texture).kind.coordinate_type()).short_name();
                Text::call(&ty, &[&Text::call("textureDimensions", &[&name])])
            }
            ir::Op::TextureLevels(texture) => self.count_call("textureNumLevels", *texture),
            ir::Op::TextureLayers(texture) => self.count_call("textureNumLayers", *texture),
            ir::Op::Load { texture, .. } => {
                let texture = self.resources.texture(*texture);
                let (name, level) = (Text::name(texture.name.as_str()), Text::name("0"));
                let mut all = vec![&name];
                all.extend(args);
                let levelled = args.len() > 1 + usize::from(texture.kind.is_indexed());
                if texture.kind != TextureKind::Multisampled && !levelled {
                    all.push(&level);
                }
                Text::call("textureLoad", &all)
            }
            ir::Op::Sample { texture, sampler, .. } => {
                let behind = args.len() - usize::from(self.resources.texture(*texture).kind.has_layers());
                let [name, sampler] = self.texture_and_sampler(*texture, *sampler);
                let finest = Text::name("0.0");
                let mut all = vec![&name, &sampler];
                all.extend(args);
                match behind {
                    1 => all.push(&finest),
                    2 => {}
                    _ => return Text::call("textureSampleGrad", &all),
                }
                Text::call("textureSampleLevel", &all)
            }
            ir::Op::Gather {
                texture,
                sampler,
                component,
                ..
            } => {
                let [texture, sampler] = self.texture_and_sampler(*texture, *sampler);
                let component = Text::name(component.to_string());
                let all: Vec<&Text> = [&component, &texture, &sampler].into_iter().chain(args).collect();
                Text::call("textureGather", &all)
            }
            ir::Op::Compare { texture, sampler, .. } => {
                let [texture, sampler] = self.texture_and_sampler(*texture, *sampler);
                let all: Vec<&Text> = [&texture, &sampler].into_iter().chain(args).collect();
                Text::call("textureSampleCompareLevel", &all)
            }
            ir::Op::GatherCompare { texture, sampler, .. } => {
                let [texture, sampler] = self.texture_and_sampler(*texture, *sampler);
                Text::call("textureGatherCompare", &[&texture, &sampler, &args[0], &args[1]])
            }
            ir::Op::BufferLoad { buffer, field, .. } => {
                let buffer = self.resources.buffer(*buffer);
                let element = Text::index(&Text::name(buffer.name.as_str()), &args[0]);
                super::element_part(&element, &buffer.element, *field, args.get(1))
            }
            ir::Op::SharedLoad(shared) => Text::index(
                &Text::name(self.resources.shared[*shared as usize].name.as_str()),
                &args[0],
            ),
            ir::Op::BufferLen(buffer) => {
                let length = self.unsigned_length(*buffer);
                Text::call("i32", &[&length])
            }
            ir::Op::QuadSwap(direction) => {
                let function = match direction {
                    QuadDirection::Horizontal => "quadSwapX",
                    QuadDirection::Vertical => "quadSwapY",
                    QuadDirection::Diagonal => "quadSwapDiagonal",
                };
                Text::call(function, &[&args[0]])
            }
            ir::Op::Derivative(axis) => {
                let function = if *axis == Axis::X { "dpdxFine" } else { "dpdyFine" };
                Text::call(function, &[&args[0]])
            }
            other => unreachable!("{other:?} is no read"),
        }
    }

    fn scalar_select(&self, ty: Ty, condition: &Text, yes: &Text, no: &Text) -> Text {
        if ty.scalar_kind() == Some(Scalar::Bool) {
            // `a < b, c, d > e` would be parsed as a list of template arguments.
            return Text::call("select", &[&no.in_parentheses(), &yes.in_parentheses(), condition]);
        }
        Text::call("select", &[no, yes, condition])
    }

    fn component_select(&self, condition: &Text, yes: &Text, no: &Text) -> Text {
        Text::call("select", &[no, yes, condition])
    }

    fn bitcast(&self, to: Ty, x: &Text) -> Text {
        Text::call(&format!("bitcast<{}>", to.short_name()), &[x])
    }

    fn construct(&self, ty: Ty, parts: &[&Text]) -> Text {
        if ty.scalar_kind() == Some(Scalar::Bool) && parts.len() > 1 {
            // `a < b, c > d` would be parsed as a list of template arguments.
            let parts: Vec<Text> = parts.iter().map(|part| part.in_parentheses()).collect();
            return Text::call(&ty.short_name(), &parts.iter().collect::<Vec<_>>());
        }
        Text::call(&ty.short_name(), parts)
    }

    // Operands are pure, and naga compiles `&&` and `||` to control flow.
    fn logical_operator(&self, op: BinaryOp, _: Scalar) -> &'static str {
        if op == BinaryOp::And { "&" } else { "|" }
    }

    fn let_head(&self, name: &str, _: Ty) -> String {
        format!("let {name}")
    }

    fn var_head(&self, name: &str, ty: Ty, has_value: bool) -> String {
        match has_value {
            true => format!("var {name}"),
            false => format!("var {name}: {}", ty.short_name()),
        }
    }

    fn table_head(&self, name: &str, _: Ty) -> String {
        format!("const {name}")
    }

    fn loop_head(&self, counter: &str, _: Ty, start: &str, bound: &str) -> String {
        format!("for (var {counter} = {start}; {bound}; {counter}++) {{")
    }

    fn endless_head(&self) -> &'static str {
        "loop {"
    }

    fn if_head(&self) -> [&'static str; 2] {
        ["if ", " {"]
    }

    fn function_head(&self, name: &str, params: &[(&str, Ty)], result: Ty) -> String {
        let params: Vec<String> = params
            .iter()
            .map(|(name, ty)| format!("{name}: {}", ty.short_name()))
            .collect();
        format!("fn {name}({}) -> {} {{", params.join(", "), result.short_name())
    }

    fn texel_store(&self, output: usize, place: &Text, value: &Text) -> Text {
        let output = &self.resources.outputs[output];
        let name = Text::name(output.name.as_str());
        Text::call("textureStore", &[&name, place, &pad_texel(self, output, value)])
    }

    fn effect_statement(&self, effect: &Effect, args: &[Text], before: Option<&str>) -> (String, Text) {
        let name = self.resources.element_and_name(effect.memory).1;
        let place = Text::index(&Text::name(name), &args[0]);
        let Some(op) = effect.op else {
            return (format!("{} = ", place.code), args[1].clone());
        };
        let place = Text::name(format!("&{}", place.code));
        let all: Vec<&Text> = std::iter::once(&place).chain(&args[1..]).collect();
        let call = Text::call(&format!("atomic{op:?}"), &all);
        (before.map_or_else(String::new, |var| format!("{var} = ")), call)
    }

    fn unsigned_length(&self, buffer: u32) -> Text {
        let name = Text::name(format!("&{}", self.resources.buffer(buffer).name));
        Text::call("arrayLength", &[&name])
    }

    fn barrier_statements(&self, buffers: bool) -> &'static [&'static str] {
        match buffers {
            true => &["storageBarrier();", "workgroupBarrier();"],
            false => &["workgroupBarrier();"],
        }
    }

    fn output_statements(&self, values: &[Text]) -> Vec<(String, Text)> {
        let value = match values {
            [one] => one.clone(),
            several => Text::call(&self.resources.outputs_type(), &several.iter().collect::<Vec<_>>()),
        };
        vec![("return ".to_owned(), value)]
    }

    fn preamble(&self, header: &[String]) -> String {
        let r = self.resources;
        let mut out = String::new();
        if r.half {
            out += "enable f16;\n\n";
        }
        out += &header_comment(header);
        out.push('\n');
        for structure in r.read_structures() {
            out += &format!("struct {} {{\n", structure.name);
            for field in &structure.fields {
                out += &format!("    {}: {},\n", field.name, Ty::from(field.ty).short_name());
            }
            out += "}\n\n";
        }
        let group = r.places.bind_group();
        let mut bind = |binding: u32, what: String| {
            let _ = writeln!(out, "@group({group}) @binding({binding}) var{what};");
        };
        for bound in &r.read {
            let texture = r.texture(bound.index);
            bind(bound.binding, format!(" {}: {}", texture.name, texture_type(texture)));
        }
        for (k, binding) in &r.read_buffers {
            let buffer = r.buffer(*k);
            let element = match &buffer.element {
                Element::Value(ty) => Ty::from(*ty).short_name(),
                Element::Struct(structure) => structure.name.clone(),
            };
            let (access, element) = match buffer.access {
                Access::Read => ("read", element),
                Access::Write => ("read_write", element),
                Access::Atomic => ("read_write", format!("atomic<{element}>")),
            };
            bind(
                *binding,
                format!("<storage, {access}> {}: array<{element}>", buffer.name),
            );
        }
        for (k, binding) in &r.used_samplers {
            let sampler = r.sampler(*k);
            let ty = sampler_type(sampler.comparison);
            bind(*binding, format!(" {}: {ty}", sampler.name));
        }
        for output in &r.outputs {
            let (name, format) = (&output.name, output.format.wgsl_name());
            if let Some(binding) = output.binding {
                bind(binding, format!(" {name}: texture_storage_2d<{format}, write>"));
            }
        }
        if let Some(binding) = r.uniform_binding() {
            out += "\nstruct Parameters {\n";
            for field in &r.fields {
                out += &format!("    {}: {},\n", field.name, field.ty);
            }
            out += "}\n\n";
            out += &match r.has_immediates() {
                true => format!("var<immediate> {UNIFORMS}: Parameters;\n"),
                false => format!("@group({group}) @binding({binding}) var<uniform> {UNIFORMS}: Parameters;\n"),
            };
        }
        if let Some(binding) = r.region_binding() {
            out += &format!("\nstruct Region {{\n    {}\n", r.region_comment());
            out += "    first: vec2i,\n    size: vec2i,\n    place: vec2i,\n}\n\n";
            out += &format!("@group({group}) @binding({binding}) var<uniform> {REGION}: Region;\n");
        }
        if !r.overrides.is_empty() {
            out += &format!("\n{}", self.override_declarations());
        }
        for shared in r.shared_memory() {
            let element = Ty::from(shared.element).short_name();
            let element = if shared.atomic {
                format!("atomic<{element}>")
            } else {
                element
            };
            let _ = writeln!(out, "var<workgroup> {}: array<{element}, {}>;", shared.name, shared.len);
        }
        if r.options.stage == Stage::Fragment && r.outputs.len() > 1 {
            out += &format!("\n{}", self.outputs_structure());
        }
        out
    }

    fn entry_head(&self) -> String {
        if self.function_leads() {
            return self.kernel_function_head();
        }
        let r = self.resources;
        let entry = &r.entry;
        match r.options.stage {
            Stage::Compute => {
                let [x, y, z] = r.workgroup_size();
                let mut told = vec!["@builtin(global_invocation_id) id: vec3u"];
                told.extend(r.asks_local.then_some("@builtin(local_invocation_id) local_id: vec3u"));
                told.extend(r.asks_group.then_some("@builtin(workgroup_id) group_id: vec3u"));
                let start = format!("@compute @workgroup_size({x}, {y}, {z})\nfn {entry}(");
                match &told[..] {
                    [one] => format!("{start}{one}) {{"),
                    several => {
                        let lines: String = several.iter().map(|one| format!("    {one},\n")).collect();
                        format!("{start}\n{lines}) {{")
                    }
                }
            }
            Stage::Fragment => {
                let varyings = r
                    .manifest_varyings()
                    .map(|v| format!(", @location({}) {}: {}", v.location, v.name, v.ty));
                let varyings: String = varyings.collect();
                let result = match &r.outputs[..] {
                    [one] => format!("@location(0) {}", Ty::from(one.texel_type()).short_name()),
                    _ => r.outputs_type(),
                };
                format!("@fragment\nfn {entry}(@builtin(position) position: vec4f{varyings}) -> {result} {{")
            }
        }
    }

    fn function_leads(&self) -> bool {
        self.resources.options.is_function()
    }

    fn trailing_text(&self) -> Option<String> {
        let several = self.resources.outputs.len() > 1;
        let parts = [
            several.then(|| self.outputs_structure()),
            (!self.resources.overrides.is_empty()).then(|| self.override_declarations()),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        (self.function_leads() && !parts.is_empty()).then(|| parts.join("\n"))
    }
}

impl Wgsl<'_> {
    /// Declares the overrides, each with the variable that the kernel reads. An expression of overrides alone is
    /// evaluated when the pipeline is created, which fails where it overflows or divides by zero; one of variables does
    /// not.
    fn override_declarations(&self) -> String {
        let r = self.resources;
        let mut out = self.override_comment();
        let [mut declared, mut held] = [String::new(), String::new()];
        for (k, bound) in &r.overrides {
            let (of, variable) = (&bound.of, r.derived_name(Derived::Held(*k)));
            let (name, ty) = (&of.name, Ty::from(of.ty).short_name());
            let default = self.override_default(of);
            if r.holds_defaults {
                held += &format!("var<private> {variable}: {ty} = {default};\n");
                continue;
            }
            // The host of a function has overrides of its own, and numbers them.
            let id = match self.function_leads() {
                true => String::new(),
                false => format!("@id({}) ", of.id),
            };
            declared += &format!("{id}override {name}: {ty} = {default};{}\n", self.range_comment(of));
            held += &format!("var<private> {variable}: {ty} = {name};\n");
        }
        out += &declared;
        out + &held
    }

    /// Declares the structure of several outputs; for an entry point with their locations.
    fn outputs_structure(&self) -> String {
        let r = self.resources;
        let fields = r
            .outputs
            .iter()
            .enumerate()
            .map(|(k, output)| match self.function_leads() {
                true => format!("    {}: {},\n", output.name, Ty::from(output.ty).short_name()),
                false => format!(
                    "    @location({k}) {}: {},\n",
                    output.name,
                    Ty::from(output.texel_type()).short_name()
                ),
            });
        format!("struct {} {{\n{}}}\n", r.outputs_type(), fields.collect::<String>())
    }

    /// Returns the result type of a function.
    pub(super) fn result_type(&self) -> String {
        match &self.resources.outputs[..] {
            [one] => Ty::from(one.ty).short_name(),
            _ => self.resources.outputs_type(),
        }
    }
}

/// Pads a value to a texel of four components, as stores require in every format.
pub(super) fn pad_texel(language: &dyn Language, output: &BoundOutput, value: &Text) -> Text {
    let texel = output.texel_type();
    let kind = texel.scalar_kind().unwrap_or(Scalar::F32);
    let whole = language.type_spelling(Type::value(kind, 4).into());
    let [zero, one] = [0, one_bits(Some(kind))].map(|bits| language.scalar_literal(kind, false, bits));
    match texel.component_count() {
        1 => Text::call(&whole, &[value, &zero, &zero, &one]),
        2 => Text::call(&whole, &[value, &zero, &one]),
        _ => value.clone(),
    }
}

pub(super) fn sampler_type(comparison: bool) -> &'static str {
    match comparison {
        true => "sampler_comparison",
        false => "sampler",
    }
}

pub(super) fn texture_type(texture: &Texture) -> String {
    let shape = match texture.kind {
        TextureKind::Flat => "2d",
        TextureKind::Layers => "2d_array",
        TextureKind::Volume => "3d",
        TextureKind::Cube => "cube",
        TextureKind::Multisampled => "multisampled_2d",
        TextureKind::Depth => return "texture_depth_2d".to_owned(),
        TextureKind::DepthLayers => return "texture_depth_2d_array".to_owned(),
        TextureKind::DepthCube => return "texture_depth_cube".to_owned(),
    };
    format!("texture_{shape}<{}>", texture.scalar)
}

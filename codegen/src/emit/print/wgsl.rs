//! WGSL as WebGPU and wgpu read it.

use super::expr::{float, integer, unsigned};
use super::{Language, Text, commented, loose};
use crate::emit::ast::{Builtin, Ty};
use crate::emit::resources::{OUTPUT, Resources, UNIFORMS};
use crate::ir::{self, Axis, BinaryOp, Direction, Element, Scalar, Texture, TextureKind, Type};
use std::fmt::Write;
use straightline_manifest::{Precision, REGION, Stage};

/// WGSL.
pub struct Wgsl<'a> {
    /// The shader's bindings.
    pub resources: &'a Resources,
}

impl Wgsl<'_> {
    fn pair(&self, texture: u32, sampler: u32) -> [Text; 2] {
        let texture = self.resources.texture(texture).name.as_str();
        let sampler = self.resources.sampler(sampler).name.as_str();
        [texture, sampler].map(Text::name)
    }

    /// How many levels or layers a texture has.
    fn count(&self, function: &str, texture: u32) -> Text {
        let name = Text::name(self.resources.texture(texture).name.as_str());
        Text::call("i32", &[&Text::call(function, &[&name])])
    }
}

impl Wgsl<'_> {
    /// Names at module scope that this language adds, or of parameters that are fields of a uniform struct otherwise.
    pub fn names(&self) -> Vec<String> {
        match self.resources.options.is_function() {
            true => self.resources.uniforms.iter().map(|u| loose(&u.name)).collect(),
            false => self.resources.structure_names(),
        }
    }
}

impl Language for Wgsl<'_> {
    fn ty(&self, ty: Ty) -> String {
        type_name(ty)
    }

    fn scalar(&self, kind: Scalar, half: bool, bits: u32) -> Text {
        match kind {
            Scalar::F32 if half => crate::emit::half::literal(bits),
            Scalar::F32 => float(bits),
            Scalar::I32 if bits as i32 == i32::MIN => Text::name("i32(-2147483648)"),
            Scalar::I32 => integer(i64::from(bits as i32), ""),
            Scalar::U32 => unsigned(bits),
            Scalar::Bool => Text::name(if bits != 0 { "true" } else { "false" }),
        }
    }

    fn builtin(&self, builtin: Builtin) -> Text {
        match builtin {
            Builtin::Invocation => Text::name("vec2i(id.xy)"),
            Builtin::Position if self.leads() => Text::name("position"),
            Builtin::Position => Text::name("position.xy"),
            Builtin::OutputSize => Text::name(format!("vec2i(textureDimensions({OUTPUT}))")),
            Builtin::RegionFirst => Text::name(format!("{REGION}.first")),
            Builtin::RegionSize => Text::name(format!("{REGION}.size")),
            Builtin::RegionPlace => Text::name(format!("{REGION}.place")),
        }
    }

    fn read(&self, op: &ir::Op, args: &[Text]) -> Text {
        match op {
            ir::Op::Uniform(k) if self.leads() => Text::name(loose(self.resources.uniform(*k))),
            ir::Op::Uniform(k) => Text::name(format!("{UNIFORMS}.{}", self.resources.uniform(*k))),
            ir::Op::Varying(k) => Text::name(self.resources.varying(*k)),
            ir::Op::TextureSize(texture) => {
                let name = Text::name(self.resources.texture(*texture).name.as_str());
                let ty = type_name(self.resources.texture(*texture).kind.coordinate().into());
                Text::call(&ty, &[&Text::call("textureDimensions", &[&name])])
            }
            ir::Op::TextureLevels(texture) => self.count("textureNumLevels", *texture),
            ir::Op::TextureLayers(texture) => self.count("textureNumLayers", *texture),
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
                let [name, sampler] = self.pair(*texture, *sampler);
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
                let [texture, sampler] = self.pair(*texture, *sampler);
                let component = Text::name(component.to_string());
                Text::call("textureGather", &[&component, &texture, &sampler, &args[0]])
            }
            ir::Op::Compare { texture, sampler, .. } => {
                let [texture, sampler] = self.pair(*texture, *sampler);
                let all: Vec<&Text> = [&texture, &sampler].into_iter().chain(args).collect();
                Text::call("textureSampleCompareLevel", &all)
            }
            ir::Op::GatherCompare { texture, sampler, .. } => {
                let [texture, sampler] = self.pair(*texture, *sampler);
                Text::call("textureGatherCompare", &[&texture, &sampler, &args[0], &args[1]])
            }
            ir::Op::BufferLoad { buffer, field, .. } => {
                let buffer = self.resources.buffer(*buffer);
                let element = Text::index(&Text::name(buffer.name.as_str()), &args[0]);
                super::part(&element, &buffer.element, *field, args.get(1))
            }
            ir::Op::BufferLen(buffer) => {
                let name = Text::name(format!("&{}", self.resources.buffer(*buffer).name));
                Text::call("i32", &[&Text::call("arrayLength", &[&name])])
            }
            ir::Op::Message(direction) => {
                let function = match direction {
                    Direction::Horizontal => "quadSwapX",
                    Direction::Vertical => "quadSwapY",
                    Direction::Diagonal => "quadSwapDiagonal",
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

    fn select(&self, ty: Ty, condition: &Text, yes: &Text, no: &Text) -> Text {
        if ty.kind() == Some(Scalar::Bool) {
            // `a < b, c, d > e` would begin a list of template arguments.
            return Text::call("select", &[&no.in_parentheses(), &yes.in_parentheses(), condition]);
        }
        Text::call("select", &[no, yes, condition])
    }

    fn choose(&self, condition: &Text, yes: &Text, no: &Text) -> Text {
        Text::call("select", &[no, yes, condition])
    }

    fn bitcast(&self, to: Ty, x: &Text) -> Text {
        Text::call(&format!("bitcast<{}>", type_name(to)), &[x])
    }

    fn construct(&self, ty: Ty, parts: &[&Text]) -> Text {
        if ty.kind() == Some(Scalar::Bool) && parts.len() > 1 {
            // `a < b, c > d` would begin a list of template arguments.
            let parts: Vec<Text> = parts.iter().map(|part| part.in_parentheses()).collect();
            return Text::call(&type_name(ty), &parts.iter().collect::<Vec<_>>());
        }
        Text::call(&type_name(ty), parts)
    }

    // Operands are pure, and naga makes control flow of `&&` and `||`.
    fn logical(&self, op: BinaryOp, _: Scalar) -> &'static str {
        if op == BinaryOp::And { "&" } else { "|" }
    }

    fn immutable(&self, name: &str, _: Ty) -> String {
        format!("let {name}")
    }

    fn mutable(&self, name: &str, ty: Ty, has_value: bool) -> String {
        match has_value {
            true => format!("var {name}"),
            false => format!("var {name}: {}", type_name(ty)),
        }
    }

    fn table(&self, name: &str, _: Ty) -> String {
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
            .map(|(name, ty)| format!("{name}: {}", type_name(*ty)))
            .collect();
        format!("fn {name}({}) -> {} {{", params.join(", "), type_name(result))
    }

    fn store(&self, place: &Text, colour: &Text) -> Text {
        Text::call("textureStore", &[&Text::name(OUTPUT), place, colour])
    }

    fn output(&self) -> String {
        "return ".to_owned()
    }

    fn preamble(&self, header: &[String]) -> String {
        let r = self.resources;
        let mut out = String::new();
        if r.options.precision == Precision::F16 {
            out += "enable f16;\n\n";
        }
        out += &commented(header);
        out.push('\n');
        for structure in r.structures() {
            out += &format!("struct {} {{\n", structure.name);
            for field in &structure.fields {
                out += &format!("    {}: {},\n", field.name, type_name(field.ty.into()));
            }
            out += "}\n\n";
        }
        let group = r.places.group();
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
                Element::Value(ty) => type_name((*ty).into()),
                Element::Struct(structure) => structure.name.clone(),
            };
            bind(*binding, format!("<storage, read> {}: array<{element}>", buffer.name));
        }
        for (k, binding) in &r.used_samplers {
            let sampler = r.sampler(*k);
            let ty = sampler_type(sampler.comparison);
            bind(*binding, format!(" {}: {ty}", sampler.name));
        }
        if let Some(binding) = r.output_binding() {
            let format = r.options.format.wgsl();
            bind(binding, format!(" {OUTPUT}: texture_storage_2d<{format}, write>"));
        }
        if let Some(binding) = r.uniform_binding() {
            out += "\nstruct Parameters {\n";
            for field in &r.fields {
                out += &format!("    {}: {},\n", field.name, field.ty);
            }
            out += &format!("}}\n\n@group({group}) @binding({binding}) var<uniform> {UNIFORMS}: Parameters;\n");
        }
        if let Some(binding) = r.region_binding() {
            out += &format!("\nstruct Region {{\n    {}\n", r.region_comment());
            out += "    first: vec2i,\n    size: vec2i,\n    place: vec2i,\n}\n\n";
            out += &format!("@group({group}) @binding({binding}) var<uniform> {REGION}: Region;\n");
        }
        out
    }

    fn entry_head(&self) -> String {
        if self.leads() {
            return self.taking();
        }
        let r = self.resources;
        let entry = &r.entry;
        match r.options.stage {
            Stage::Compute => {
                let [x, y, z] = r.options.workgroup();
                format!(
                    "@compute @workgroup_size({x}, {y}, {z})\nfn {entry}(@builtin(global_invocation_id) id: vec3u) {{"
                )
            }
            Stage::Fragment => {
                let varyings = r
                    .varyings()
                    .map(|v| format!(", @location({}) {}: {}", v.location, v.name, v.ty));
                let varyings: String = varyings.collect();
                format!("@fragment\nfn {entry}(@builtin(position) position: vec4f{varyings}) -> @location(0) vec4f {{")
            }
        }
    }

    fn leads(&self) -> bool {
        self.resources.options.is_function()
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

/// A type as WGSL spells it.
pub fn type_name(ty: Ty) -> String {
    match ty.shape {
        Type::Array { len, .. } => {
            format!("array<{}, {len}>", type_name(ty.element_ty()))
        }
        Type::Value { scalar, lanes } => {
            let scalar = match scalar {
                Scalar::F32 if ty.half => "h16".to_owned(),
                other => other.to_string(),
            };
            match (lanes, scalar.as_str()) {
                (1, "h16") => "f16".to_owned(),
                (1, _) => scalar,
                (_, "bool") => format!("vec{lanes}<bool>"),
                _ => format!("vec{lanes}{}", &scalar[..1]),
            }
        }
        Type::Results => "void".to_owned(),
    }
}

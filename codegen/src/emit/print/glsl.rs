//! GLSL 4.50 for Vulkan, with separate textures; GLSL of OpenGL and OpenGL ES, with combined samplers and loose uniforms.

mod types;

use super::expr::{float_literal, integer_literal, unsigned_literal};
use super::overrides::PrintOverrides;
use super::wgsl::pad_texel;
use super::{Language, Text, header_comment};
use crate::emit::ast::{Builtin, Effect, Module, Ty};
use crate::emit::derived::Derived;
use crate::emit::host_reads;
use crate::emit::own_words::{SAMPLER, UNIFORMS};
use crate::emit::resources::Resources;
use crate::emit::{DebugInfo, Target};
use std::cell::RefCell;
use std::collections::BTreeSet;
use straightline_evaluator::ir::{
    self, Access, AtomicOp, Axis, BinaryOp, Element, Memory, QuadDirection, Scalar, Span, TextureKind, Type, UnaryOp,
};
use straightline_manifest::{REGION, Stage};

pub use types::{image_type, plain_sampler, sampler_of, sampler_type, texture_type, type_name, variable_declared};

/// Uniforms of the region as loose variables, where no block holds them, with the names of the block's fields.
pub const LOOSE_REGION: [(&str, &str); 3] = [
    ("region_first", "first"),
    ("region_size", "size"),
    ("region_place", "place"),
];

/// Construct of GLSL 4.50 that naga's parser rejects or misinterprets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unread {
    /// A function for another shader: a text without `main`.
    Function,
    /// `.length()` of a buffer, for which naga produces an invalid module.
    Length,
    /// `textureGather`.
    Gather,
    /// `subgroupQuadSwapHorizontal` and similar functions.
    QuadSwap,
    /// `precise`.
    Precise,
    /// Texels of a texture with a comparison sampler, which naga treats as a pure depth texture.
    ComparedTexels,
    /// Writes to memory; naga does not know the atomic ones.
    Effect,
    /// `memoryBarrierShared` and similar functions.
    Barrier,
}

/// Printer for a version of GLSL.
pub struct Glsl<'a> {
    pub(super) resources: &'a Resources,
    pub(super) target: Target,
    /// Printed constructs that naga cannot parse.
    unread: RefCell<BTreeSet<Unread>>,
}

impl<'a> Glsl<'a> {
    /// Creates the printer for a target.
    pub fn new(resources: &'a Resources, target: Target) -> Glsl<'a> {
        Glsl {
            resources,
            target,
            unread: RefCell::default(),
        }
    }

    /// Returns the constructs that naga cannot parse, in everything printed for a module.
    pub fn unread_constructs(&self, module: &Module<'_>) -> BTreeSet<Unread> {
        let mut unread = self.unread.borrow().clone();
        unread.extend(self.is_function().then_some(Unread::Function));
        let precise = module.variables.iter().any(|variable| variable.precise);
        unread.extend(precise.then_some(Unread::Precise));
        unread
    }

    fn note_unread(&self, construct: Unread) {
        self.unread.borrow_mut().insert(construct);
    }

    fn is_function(&self) -> bool {
        self.resources.options.is_function()
    }

    pub(super) fn is_vulkan(&self) -> bool {
        self.target == Target::Glsl450
    }

    /// Returns the name of the combined sampler that reads a texture.
    fn combined_sampler(&self, texture: u32, sampler: Option<u32>) -> Text {
        let r = self.resources;
        let of_texture = || r.combined.iter().filter(|one| one.texture == texture);
        let same = of_texture().find(|one| one.sampler == sampler);
        let plain = || of_texture().find(|one| one.sampler.is_none_or(|s| !r.sampler(s).comparison));
        let found = same.or_else(plain).or_else(|| of_texture().next());
        Text::name(found.map_or("", |one| r.combined_name(*one)))
    }

    /// Returns the operand of a texel load or a size query.
    fn unfiltered_texture(&self, texture: u32) -> Text {
        if !self.is_vulkan() {
            return self.combined_sampler(texture, None);
        }
        if self
            .resources
            .read
            .iter()
            .any(|bound| bound.index == texture && bound.compared)
        {
            self.note_unread(Unread::ComparedTexels);
        }
        let texture = self.resources.texture(texture);
        Text::name(format!("{}({}, {SAMPLER})", plain_sampler(texture), texture.name))
    }

    /// Returns a texture combined with a sampler of the kernel.
    fn sampled_texture(&self, texture: u32, sampler: u32) -> Text {
        if !self.is_vulkan() {
            return self.combined_sampler(texture, Some(sampler));
        }
        let (texture, sampler) = (self.resources.texture(texture), self.resources.sampler(sampler));
        let kind = sampler_of(texture, sampler.comparison);
        Text::name(format!("{kind}({}, {})", texture.name, sampler.name))
    }

    /// Returns a gather of four texels around a point, or of their comparison results.
    fn gather_call(&self, args: &[&Text]) -> Text {
        self.note_unread(Unread::Gather);
        Text::call("textureGather", args)
    }

    /// Returns the number of elements of a buffer, as an `int`.
    fn buffer_length(&self, buffer: u32) -> Text {
        self.note_unread(Unread::Length);
        Text::name(format!("{}.elements.length()", self.resources.buffer(buffer).name))
    }

    /// Packs coordinates, layer and reference value into one vector. Returns the vector, the remaining arguments, and the
    /// vector's number of components.
    fn pack_coordinates(&self, texture: u32, args: &[Text], compares: bool) -> (Text, usize) {
        let kind = self.resources.texture(texture).kind;
        let layers = usize::from(kind.has_layers());
        let parts = 1 + layers + usize::from(compares);
        let components = usize::from(kind.position_type().component_count()) + parts - 1;
        if parts == 1 {
            return (args[0].clone(), components);
        }
        let mut all = args[..parts].to_vec();
        if layers == 1 {
            all[1] = Text::call("float", &[&all[1]]);
        }
        let all: Vec<&Text> = all.iter().collect();
        (Text::call(&format!("vec{components}"), &all), components)
    }

    /// Returns `layout(set = 0, binding = N)` with additional qualifiers, as far as the version supports bindings.
    pub(super) fn layout_qualifier(&self, binding: u32, before: &str, behind: &str) -> String {
        let binding = match self.target {
            Target::Glsl450 => format!("set = {}, binding = {binding}", self.resources.places.bind_group()),
            Target::Glsl430 | Target::Essl310 => format!("binding = {binding}"),
            _ => return String::new(),
        };
        format!("layout({before}{binding}{behind}) ")
    }

    /// Declares the storage buffers.
    pub(super) fn buffer_declarations(&self) -> String {
        let r = self.resources;
        let each = r.read_buffers.iter().map(|(k, binding)| {
            let (name, block) = (&r.buffer(*k).name, r.derived_name(Derived::Block(*k)));
            let element = match &r.buffer(*k).element {
                Element::Value(ty) => type_name((*ty).into()),
                Element::Struct(structure) => structure.name.clone(),
            };
            let layout = self.layout_qualifier(*binding, "std430, ", "");
            let qualifier = match r.buffer(*k).access {
                Access::Read => "readonly ",
                Access::Write => "writeonly ",
                Access::Atomic => "",
            };
            format!("{layout}{qualifier}buffer {block} {{ {element} elements[]; }} {name};\n")
        });
        let structures = r.read_structures().into_iter().map(|structure| {
            let fields = structure
                .fields
                .iter()
                .map(|f| format!("    {};\n", variable_declared(&f.name, f.ty.into())));
            format!("\nstruct {} {{\n{}}};\n\n", structure.name, fields.collect::<String>())
        });
        structures.collect::<String>() + &each.collect::<String>()
    }

    /// Declares the written images; for a fragment shader the interpolated inputs, with or without locations, and the
    /// colour outputs.
    pub(super) fn output_and_inputs(&self, located: bool) -> String {
        let r = self.resources;
        if r.options.stage == Stage::Compute {
            let images = r.outputs.iter().map(|output| {
                let format = format!(", {}", output.format.glsl_qualifier());
                let layout = self.layout_qualifier(output.binding.unwrap_or_default(), "", &format);
                format!("{layout}uniform writeonly {} {};\n", image_type(output), output.name)
            });
            return images.collect();
        }
        let each = r.varyings.iter().enumerate().map(|(k, varying)| {
            let declared = variable_declared(&varying.name, varying.ty.into());
            match located {
                true => format!("layout(location = {k}) in {declared};\n"),
                false => format!("in {declared};\n"),
            }
        });
        let outputs = r.outputs.iter().enumerate();
        let outputs = outputs.map(|(k, output)| {
            let declared = variable_declared(&output.name, output.texel_type().into());
            format!("layout(location = {k}) out {declared};\n")
        });
        each.collect::<String>() + &outputs.collect::<String>()
    }
}

impl Glsl<'_> {
    /// Declares the structure of several outputs, which a function returns.
    fn outputs_structure(&self) -> String {
        let r = self.resources;
        let fields = r
            .outputs
            .iter()
            .map(|o| format!("    {};\n", variable_declared(&o.name, o.ty.into())));
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

impl Language for Glsl<'_> {
    fn type_spelling(&self, ty: Ty) -> String {
        type_name(ty)
    }

    fn scalar_literal(&self, kind: Scalar, _: bool, bits: u32) -> Text {
        match kind {
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
            Builtin::Invocation => Text::name("ivec2(gl_GlobalInvocationID.xy)"),
            Builtin::Local => Text::name("ivec2(gl_LocalInvocationID.xy)"),
            Builtin::LocalIndex => Text::name("int(gl_LocalInvocationIndex)"),
            Builtin::Group => Text::name("ivec2(gl_WorkGroupID.xy)"),
            Builtin::Position if self.is_function() => Text::name("position"),
            Builtin::Position => Text::name("gl_FragCoord.xy"),
            Builtin::OutputSize => Text::name(format!("imageSize({})", self.resources.sized_output())),
            Builtin::RegionFirst | Builtin::RegionSize | Builtin::RegionPlace => {
                let field = match builtin {
                    Builtin::RegionFirst => "first",
                    Builtin::RegionSize => "size",
                    _ => "place",
                };
                Text::name(match self.is_vulkan() {
                    true => format!("{REGION}.{field}"),
                    false => format!("{REGION}_{field}"),
                })
            }
        }
    }

    fn function_name(&self, op: &ir::Op) -> &'static str {
        match op {
            ir::Op::Binary(BinaryOp::Atan2) => "atan",
            ir::Op::Unary(UnaryOp::Round) => "roundEven",
            ir::Op::Unary(UnaryOp::InverseSqrt) => "inversesqrt",
            ir::Op::Unary(UnaryOp::ReverseBits) => "bitfieldReverse",
            other => super::expr::wgsl_function(other),
        }
    }

    fn resource_read(&self, op: &ir::Op, args: &[Text]) -> Text {
        if let Some(call) = host_reads::host_call(self.resources, op, args) {
            return call;
        }
        let zero = Text::name("0");
        match op {
            ir::Op::Uniform(k) if !self.is_vulkan() || self.is_function() => {
                Text::name(self.resources.uniform_name(*k))
            }
            ir::Op::Uniform(k) => Text::name(format!("{UNIFORMS}.{}", self.resources.uniform_name(*k))),
            ir::Op::Override(k) => Text::name(self.resources.bound_override(*k).of.name.as_str()),
            ir::Op::Varying(k) => Text::name(self.resources.varying_name(*k)),
            ir::Op::TextureSize(texture) => {
                let name = self.unfiltered_texture(*texture);
                match self.resources.texture(*texture).kind {
                    TextureKind::Multisampled => Text::call("textureSize", &[&name]),
                    TextureKind::Layers | TextureKind::DepthLayers => {
                        Text::member(&Text::call("textureSize", &[&name, &zero]), "xy")
                    }
                    _ => Text::call("textureSize", &[&name, &zero]),
                }
            }
            ir::Op::TextureLevels(texture) => Text::call("textureQueryLevels", &[&self.unfiltered_texture(*texture)]),
            ir::Op::TextureLayers(texture) => Text::member(
                &Text::call("textureSize", &[&self.unfiltered_texture(*texture), &zero]),
                "z",
            ),
            ir::Op::Load { texture, .. } => {
                let kind = self.resources.texture(*texture).kind;
                let name = self.unfiltered_texture(*texture);
                if kind == TextureKind::Multisampled {
                    return Text::call("texelFetch", &[&name, &args[0], &args[1]]);
                }
                let indexed = usize::from(kind.is_indexed());
                let level = args.get(1 + indexed).unwrap_or(&zero);
                match indexed {
                    0 => Text::call("texelFetch", &[&name, &args[0], level]),
                    _ => {
                        let coord = Text::call("ivec3", &[&args[0], &args[1]]);
                        Text::call("texelFetch", &[&name, &coord, level])
                    }
                }
            }
            ir::Op::Sample { texture, sampler, .. } => {
                let through = self.sampled_texture(*texture, *sampler);
                let (place, _) = self.pack_coordinates(*texture, args, false);
                let layers = usize::from(self.resources.texture(*texture).kind.has_layers());
                match &args[1 + layers..] {
                    [] => Text::call("textureLod", &[&through, &place, &Text::name("0.0")]),
                    [level] => Text::call("textureLod", &[&through, &place, level]),
                    [across, down, ..] => Text::call("textureGrad", &[&through, &place, across, down]),
                }
            }
            ir::Op::Gather {
                texture,
                sampler,
                component,
                ..
            } => {
                let through = self.sampled_texture(*texture, *sampler);
                let (place, _) = self.pack_coordinates(*texture, args, false);
                self.gather_call(&[&through, &place, &Text::name(component.to_string())])
            }
            ir::Op::Compare { texture, sampler, .. } => {
                let through = self.sampled_texture(*texture, *sampler);
                let (place, components) = self.pack_coordinates(*texture, args, true);
                if components == 3 {
                    return Text::call("textureLod", &[&through, &place, &Text::name("0.0")]);
                }
                // No `textureLod` accepts these samplers; gradients of length 0 select the finest level.
                let step = Text::name(
                    match self.resources.texture(*texture).kind.position_type().component_count() {
                        2 => "vec2(0.0)",
                        _ => "vec3(0.0)",
                    },
                );
                Text::call("textureGrad", &[&through, &place, &step, &step])
            }
            ir::Op::GatherCompare { texture, sampler, .. } => {
                let through = self.sampled_texture(*texture, *sampler);
                self.gather_call(&[&through, &args[0], &args[1]])
            }
            ir::Op::SharedLoad(shared) => Text::index(
                &Text::name(self.resources.shared[*shared as usize].name.as_str()),
                &args[0],
            ),
            ir::Op::BufferLoad { buffer, field, .. } => {
                let buffer = self.resources.buffer(*buffer);
                let elements = Text::name(format!("{}.elements", buffer.name));
                let element = Text::index(&elements, &args[0]);
                super::element_part(&element, &buffer.element, *field, args.get(1))
            }
            ir::Op::BufferLen(buffer) => Text::call("int", &[&self.buffer_length(*buffer)]),
            ir::Op::QuadSwap(direction) => {
                self.note_unread(Unread::QuadSwap);
                let function = match direction {
                    QuadDirection::Horizontal => "subgroupQuadSwapHorizontal",
                    QuadDirection::Vertical => "subgroupQuadSwapVertical",
                    QuadDirection::Diagonal => "subgroupQuadSwapDiagonal",
                };
                Text::call(function, &[&args[0]])
            }
            ir::Op::Derivative(axis) => {
                let function = if *axis == Axis::X { "dFdxFine" } else { "dFdyFine" };
                Text::call(function, &[&args[0]])
            }
            other => unreachable!("{other:?} is no read"),
        }
    }

    fn scalar_select(&self, _: Ty, condition: &Text, yes: &Text, no: &Text) -> Text {
        Text::choice(condition, yes, no)
    }

    fn component_select(&self, condition: &Text, yes: &Text, no: &Text) -> Text {
        if !self.is_vulkan() {
            return Text::choice(condition, yes, no);
        }
        Text::call("mix", &[no, yes, condition])
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
        format!("const {}", variable_declared(name, ty))
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
        let output = &self.resources.outputs[output];
        let name = Text::name(output.name.as_str());
        Text::call("imageStore", &[&name, place, &pad_texel(self, output, value)])
    }

    fn effect_statement(&self, effect: &Effect, args: &[Text], before: Option<&str>) -> (String, Text) {
        self.note_unread(Unread::Effect);
        let (element, name) = self.resources.element_and_name(effect.memory);
        let elements = match effect.memory {
            Memory::Buffer(_) => Text::name(format!("{name}.elements")),
            Memory::Shared(_) | Memory::Image(_) => Text::name(name),
        };
        let place = Text::index(&elements, &args[0]);
        let Some(op) = effect.op else {
            return (format!("{} = ", place.code), args[1].clone());
        };
        // GLSL has no atomic load; an atomic `or` with 0 changes nothing.
        let (function, value) = match op {
            AtomicOp::Load => ("atomicOr".to_owned(), Text::name("0")),
            op => (format!("atomic{op:?}"), args[1].clone()),
        };
        let value = match (op, element) {
            (AtomicOp::Load, Type::U32) => Text::name("0u"),
            _ => value,
        };
        let call = Text::call(&function, &[&place, &value]);
        (before.map_or_else(String::new, |var| format!("{var} = ")), call)
    }

    fn unsigned_length(&self, buffer: u32) -> Text {
        Text::call("uint", &[&self.buffer_length(buffer)])
    }

    fn barrier_statements(&self, buffers: bool) -> &'static [&'static str] {
        self.note_unread(Unread::Barrier);
        match buffers {
            true => &["memoryBarrierBuffer();", "memoryBarrierShared();", "barrier();"],
            false => &["memoryBarrierShared();", "barrier();"],
        }
    }

    fn output_statements(&self, values: &[Text]) -> Vec<(String, Text)> {
        let r = self.resources;
        match values {
            [one] if self.is_function() => vec![("return ".to_owned(), one.clone())],
            several if self.is_function() => {
                let all = Text::call(&r.outputs_type(), &several.iter().collect::<Vec<_>>());
                vec![("return ".to_owned(), all)]
            }
            values => {
                let assigned = r.outputs.iter().zip(values);
                assigned
                    .map(|(output, value)| (format!("{} = ", output.name), value.clone()))
                    .collect()
            }
        }
    }

    fn preamble(&self, header: &[String]) -> String {
        let r = self.resources;
        let extension = "#extension GL_KHR_shader_subgroup_quad : require\n";
        let mut out = match (self.is_function(), r.subgroups) {
            (true, false) => String::new(),
            // Directives must precede everything else in the host's text.
            (true, true) => format!("// Needs {extension}"),
            (false, _) => format!("#version {}\n", self.target.glsl_version()),
        };
        if r.subgroups && !self.is_function() {
            out += extension;
        }
        out += &header_comment(header);
        if !r.read.is_empty() && self.is_vulkan() && !r.options.strip_comments {
            out +=
                "// GLSL names a texture together with a sampler even where it filters nothing: any sampler will do.\n";
        }
        out.push('\n');
        // If the host's functions read the textures, the function comes after the host's own precision statements.
        if matches!(self.target, Target::Essl310 | Target::Essl300) && !r.options.calls_host() {
            out += "precision highp float;\nprecision highp int;\n";
            for ty in self.opaque_types() {
                out += &format!("precision highp {ty};\n");
            }
            out.push('\n');
        }
        let overrides = match self.is_vulkan() && !self.is_function() {
            true => self.specialization_constants(),
            false => self.override_macros(|ty, name, value| format!("const {ty} {name} = {ty}({value});")),
        };
        if self.is_function() {
            out += &overrides;
            if r.outputs.len() > 1 {
                out += &self.outputs_structure();
            }
            return out.trim_end().to_owned() + "\n";
        }
        if r.options.stage == Stage::Compute {
            let [x, y, z] = r.workgroup_size();
            out += &format!("layout(local_size_x = {x}, local_size_y = {y}, local_size_z = {z}) in;\n\n");
        }
        out += &match self.is_vulkan() {
            true => self.of_vulkan(),
            false => self.opengl_declarations(),
        };
        if !overrides.is_empty() {
            out += &format!("\n{overrides}");
        }
        for shared in r.shared_memory() {
            let element = type_name(shared.element.into());
            out += &format!("shared {element} {}[{}];\n", shared.name, shared.len);
        }
        out
    }

    fn line_directive(&self, span: &Span) -> Option<String> {
        let lines = self.resources.options.debug == DebugInfo::Lines;
        // GLSL names files by numbers.
        lines.then(|| format!("#line {} {}", span.line, span.file))
    }

    fn entry_head(&self) -> String {
        if self.is_function() {
            return self.kernel_function_head();
        }
        "void main() {".to_owned()
    }
}

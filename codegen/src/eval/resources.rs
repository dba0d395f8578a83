//! Textures, samplers and buffers: the kernel's parameters of these types, and their methods.

use super::Evaluator;
// Booleans are in no buffer.
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::Type as SourceType;
use crate::ir::vector_named as vector_type;
use crate::ir::{Access, BinaryOp, Buffer, NodeId, Op, Sampler, Scalar, Texture, TextureKind, Type};

const PAIR: Type = Type::value(Scalar::I32, 2);

impl Evaluator<'_> {
    /// A parameter that stands for a resource; `None` if its type is none.
    pub fn resource(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        let SourceType::Name(type_name, args) = ty else {
            return Ok(None);
        };
        let (kind, framed) = match type_name.as_str() {
            "Frame" => (TextureKind::Flat, true),
            "FrameLayers" => (TextureKind::Layers, true),
            "Texture" => (TextureKind::Flat, false),
            "Multisampled" => (TextureKind::Multisampled, false),
            "DepthTexture" => (TextureKind::Depth, false),
            "Sampler" | "ComparisonSampler" => {
                self.unused_name(name, span)?;
                let samplers = &mut self.builder.graph_mut().samplers;
                samplers.push(Sampler {
                    name: name.to_owned(),
                    comparison: type_name == "ComparisonSampler",
                });
                return Ok(Some(Value::Sampler(samplers.len() as u32 - 1)));
            }
            "Buffer" | "StorageBuffer" | "AtomicBuffer" => {
                let element = self.element_type(name, args, span)?;
                let access = match type_name.as_str() {
                    "AtomicBuffer" => Access::Atomic,
                    "StorageBuffer" => Access::Write,
                    _ => Access::Read,
                };
                if access == Access::Atomic && !matches!(element, Type::I32 | Type::U32) {
                    return Err(Diagnostic::at(
                        span,
                        format!("the buffer `{name}` has no elements that are changed at once"),
                    )
                    .label("of this type")
                    .help("elements of an `AtomicBuffer` are u32 or i32")
                    .into());
                }
                self.unused_name(name, span)?;
                let buffers = &mut self.builder.graph_mut().buffers;
                buffers.push(Buffer {
                    name: name.to_owned(),
                    element,
                    access,
                });
                return Ok(Some(Value::Buffer(buffers.len() as u32 - 1)));
            }
            _ => return Ok(None),
        };
        let components = match args.as_slice() {
            [] if kind == TextureKind::Depth => Some(1),
            [SourceType::Name(texel, _)] if texel == "f32" => Some(1),
            [SourceType::Name(texel, _)] => vector_type(texel).filter(|(k, _)| *k == Scalar::F32).map(|(_, n)| n),
            _ => None,
        };
        let Some(components) = components else {
            return Err(Diagnostic::at(
                span,
                format!("the texture `{name}` has no texels that a shader can read"),
            )
            .label("of this type")
            .help("texels are f32, Vec2, Vec3 or Vec4")
            .into());
        };
        self.unused_name(name, span)?;
        let textures = &mut self.builder.graph_mut().textures;
        textures.push(Texture {
            name: name.to_owned(),
            kind,
            components,
            framed,
        });
        Ok(Some(Value::Texture(textures.len() as u32 - 1)))
    }

    /// Elements of a buffer lie one after the other natively and in a shader.
    fn element_type(&self, name: &str, args: &[SourceType], span: Span) -> Eval<Type> {
        let element = match args {
            [SourceType::Name(element, _)] => match element.as_str() {
                "f32" => Some(Type::F32),
                "i32" => Some(Type::I32),
                "u32" => Some(Type::U32),
                other => vector_type(other)
                    .filter(|(_, n)| *n != 3)
                    .map(|(kind, n)| Type::value(kind, n)),
            },
            _ => None,
        };
        element.ok_or_else(|| {
            Diagnostic::at(
                span,
                format!("the buffer `{name}` has no elements that a shader can read"),
            )
            .label("of this type")
            .note("a vector of 3 takes the room of 4 in a shader's array, and of 3 in Rust's")
            .help("elements are f32, i32, u32, or vectors of 2 or 4 of them")
            .into()
        })
    }

    /// Bindings go by name.
    pub fn unused_name(&self, name: &str, span: Span) -> Eval<()> {
        let graph = self.builder.graph();
        let mut names = graph.textures.iter().map(|t| &t.name);
        let taken = names.any(|n| n == name)
            || graph.buffers.iter().any(|b| b.name == name)
            || graph.samplers.iter().any(|s| s.name == name)
            || graph.uniforms.iter().any(|u| u.name == name)
            || graph.varyings.iter().any(|v| v.name == name);
        if taken {
            return Err(Diagnostic::at(span, format!("two inputs are called `{name}`"))
                .label("the second")
                .help("bindings go by name: rename one")
                .into());
        }
        Ok(())
    }

    /// A method of a texture.
    pub fn texture(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        let texture = self.builder.graph().textures[index as usize].clone();
        match (name, args) {
            ("size", []) => {
                let size = self.size_of(index);
                Ok(Value::Node(self.convert(size, Scalar::U32)))
            }
            ("load", [coord]) if !texture.kind.is_indexed() => self.load(index, coord, None, span),
            ("load", [coord, layer]) if texture.kind.is_indexed() => {
                let layer = self.index_node(layer, span)?;
                self.load(index, coord, Some(layer), span)
            }
            ("load", _) => {
                let expected = match texture.kind {
                    TextureKind::Layers => "a coordinate and a layer",
                    TextureKind::Multisampled => "a coordinate and a sample",
                    _ => "a coordinate",
                };
                Err(
                    Diagnostic::at(span, format!("`load` of `{}` takes {expected}", texture.name))
                        .label("called here")
                        .help("coordinates are IVec2, layers and samples usize")
                        .into(),
                )
            }
            ("sample", [Value::Sampler(sampler), uv]) if texture.kind == TextureKind::Flat => {
                let uv = self.uv(uv, span)?;
                self.filtering(*sampler, span)?;
                let ty = Type::value(Scalar::F32, texture.components);
                let op = Op::Sample {
                    texture: index,
                    sampler: *sampler,
                    site: self.site(),
                };
                Ok(Value::Node(self.builder.add(op, vec![uv], ty)))
            }
            ("gather", [component, Value::Sampler(sampler), uv]) if texture.kind == TextureKind::Flat => {
                let uv = self.uv(uv, span)?;
                self.filtering(*sampler, span)?;
                let component = match self.known_int(component) {
                    Some(k) if (0..i64::from(texture.components)).contains(&k) => k as u8,
                    _ => {
                        return Err(
                            Diagnostic::at(span, "the component to gather must be known and in the texture")
                                .help(format!("use 0 to {}", texture.components - 1))
                                .into(),
                        );
                    }
                };
                let op = Op::Gather {
                    texture: index,
                    sampler: *sampler,
                    component,
                    site: self.site(),
                };
                Ok(Value::Node(self.builder.add(op, vec![uv], Type::value(Scalar::F32, 4))))
            }
            ("compare", [Value::Sampler(sampler), uv, reference]) if texture.kind == TextureKind::Depth => {
                let uv = self.uv(uv, span)?;
                let reference = self.int_or_node(reference, Scalar::F32, span)?;
                if !self.builder.graph().samplers[*sampler as usize].comparison {
                    return Err(Diagnostic::at(span, "`compare` needs a `ComparisonSampler`").into());
                }
                let op = Op::Compare {
                    texture: index,
                    sampler: *sampler,
                    site: self.site(),
                };
                Ok(Value::Node(self.builder.add(op, vec![uv, reference], Type::F32)))
            }
            ("gather_compare", [Value::Sampler(sampler), uv, reference]) if texture.kind == TextureKind::Depth => {
                let uv = self.uv(uv, span)?;
                let reference = self.int_or_node(reference, Scalar::F32, span)?;
                if !self.builder.graph().samplers[*sampler as usize].comparison {
                    return Err(Diagnostic::at(span, "`gather_compare` needs a `ComparisonSampler`").into());
                }
                let op = Op::GatherCompare {
                    texture: index,
                    sampler: *sampler,
                    site: self.site(),
                };
                let ty = Type::value(Scalar::F32, 4);
                Ok(Value::Node(self.builder.add(op, vec![uv, reference], ty)))
            }
            _ => Err(no_such_method(&texture, name, span)),
        }
    }

    /// A method of a buffer.
    pub fn buffer(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        if self.builder.graph().buffers[index as usize].access != Access::Read {
            return self.written_buffer(index, name, args, span);
        }
        match (name, args) {
            ("len", []) => Ok(Value::Node(self.builder.add(
                Op::BufferLen(index),
                Vec::new(),
                Type::I32,
            ))),
            ("load", [at]) => {
                let at = self.index_node(at, span)?;
                let len = self.builder.add(Op::BufferLen(index), Vec::new(), Type::I32);
                let (zero, one) = (self.builder.i32(0), self.builder.i32(1));
                let last = self.builder.add(Op::Binary(BinaryOp::Sub), vec![len, one], Type::I32);
                self.name(&Value::Node(last), "last", span);
                let inside = self.builder.add(Op::Clamp, vec![at, zero, last], Type::I32);
                let ty = self.builder.graph().buffers[index as usize].element;
                let op = Op::BufferLoad {
                    buffer: index,
                    site: self.site(),
                };
                Ok(Value::Node(self.builder.add(op, vec![inside], ty)))
            }
            _ => Err(Diagnostic::at(span, format!("a buffer has no method `{name}`"))
                .label("not supported")
                .help("buffers have `load` and `len`")
                .into()),
        }
    }

    fn site(&mut self) -> u32 {
        self.sites += 1;
        self.sites
    }

    fn uv(&mut self, uv: &Value, span: Span) -> Eval<NodeId> {
        let id = self.node(uv, span)?;
        if self.ty(id) == Type::value(Scalar::F32, 2) {
            return Ok(id);
        }
        let found = self.ty(id).in_rust();
        Err(
            Diagnostic::at(span, format!("a place in a texture is a Vec2, not {found}"))
                .label("of this place")
                .help("(0, 0) is the upper left corner and (1, 1) the lower right: `(pixel.as_vec2() + 0.5) / size`")
                .into(),
        )
    }

    fn filtering(&self, sampler: u32, span: Span) -> Eval<()> {
        if self.builder.graph().samplers[sampler as usize].comparison {
            return Err(Diagnostic::at(span, "a `ComparisonSampler` does not filter colours")
                .help("take a `&Sampler`")
                .into());
        }
        Ok(())
    }

    /// Width and height of a texture, the frame's where it has that.
    fn size_of(&mut self, texture: u32) -> NodeId {
        let op = match self.builder.graph().textures[texture as usize].framed {
            true => Op::FrameSize,
            false => Op::TextureSize(texture),
        };
        self.builder.add(op, Vec::new(), PAIR)
    }

    /// A texel, its coordinate clamped to the texture.
    fn load(&mut self, texture: u32, coord: &Value, layer: Option<NodeId>, span: Span) -> Eval {
        let coord = self.node(coord, span)?;
        if self.ty(coord) != PAIR {
            return Err(Diagnostic::at(
                span,
                format!("a texel's coordinate is an IVec2, not {}", self.ty(coord).in_rust()),
            )
            .label("in this read")
            .help("convert it with `.as_ivec2()`")
            .into());
        }
        let size = self.size_of(texture);
        let one = self.builder.constant(PAIR, [1, 1, 0, 0]);
        let zero = self.builder.constant(PAIR, [0; 4]);
        let last = self.builder.add(Op::Binary(BinaryOp::Sub), vec![size, one], PAIR);
        self.name(&Value::Node(last), "last", span);
        let inside = self.builder.add(Op::Clamp, vec![coord, zero, last], PAIR);
        self.name(&Value::Node(inside), "at", span);
        let components = self.builder.graph().textures[texture as usize].components;
        let args = std::iter::once(inside).chain(layer).collect();
        let op = Op::Load {
            texture,
            site: self.site(),
        };
        Ok(Value::Node(self.builder.add(
            op,
            args,
            Type::value(Scalar::F32, components),
        )))
    }
}

fn no_such_method(texture: &Texture, name: &str, span: Span) -> Exit {
    let (ty, methods) = match (texture.kind, texture.framed) {
        (TextureKind::Flat, framed) => (
            if framed { "Frame" } else { "Texture" },
            "`load(coord)`, `sample(sampler, uv)`, `gather(component, sampler, uv)` and `size()`",
        ),
        (TextureKind::Layers, _) => ("FrameLayers", "`load(coord, layer)`"),
        (TextureKind::Multisampled, _) => ("Multisampled", "`load(coord, sample)` and `size()`"),
        (TextureKind::Depth, _) => (
            "DepthTexture",
            "`load(coord)`, `compare(sampler, uv, reference)`, `gather_compare(sampler, uv, reference)` and `size()`",
        ),
    };
    let error = Diagnostic::at(span, format!("a `{ty}` has no method `{name}` with such arguments"))
        .label("not supported")
        .help(format!("it has {methods}"));
    match name {
        "sample" | "gather" => error
            .note("a `Frame` or `Texture` is read between its texels, by a `Sampler`")
            .into(),
        _ => error.into(),
    }
}

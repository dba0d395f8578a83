//! Textures: kernel parameters of these types, and their methods.

use super::Evaluator;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::textures::{Gives, Param, TEXTURES, TextureMethod, TextureType};
use crate::front::tree::Type as SourceType;
use crate::ir::vector_named as vector_type;
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Texture, Type};

/// Arguments of a texture method.
#[derive(Default)]
struct TextureArguments {
    /// The coordinate or position, the layer or sample, and any other arguments of the read, in order.
    read: Vec<NodeId>,
    /// The mip level, unless it is the finest.
    level: Option<NodeId>,
    sampler: u32,
    component: u8,
}

impl Evaluator<'_> {
    /// Adds a texture parameter; `None` if its type is not a texture.
    pub(super) fn texture_parameter(
        &mut self,
        name: &str,
        type_name: &str,
        args: &[SourceType],
        span: Span,
    ) -> Eval<Option<Value>> {
        let Some(of) = TextureType::from_name(type_name) else {
            return Ok(None);
        };
        let texel = match args {
            [] if of.kind.is_depth() => Some((Scalar::F32, 1)),
            [SourceType::Name(texel, _)] => texel_named(texel).filter(|(k, _)| of.integers || *k == Scalar::F32),
            _ => None,
        };
        let Some((scalar, components)) = texel else {
            return Err(no_texels(name, of, args, span));
        };
        let name = &*self.input_name(name);
        let textures = &mut self.builder.graph_mut().textures;
        textures.push(Texture {
            name: name.to_owned(),
            kind: of.kind,
            scalar,
            components,
            declared: components,
            framed: of.framed,
        });
        Ok(Some(Value::Texture(textures.len() as u32 - 1)))
    }

    /// Evaluates a texture method.
    pub fn eval_texture_method(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        let texture = self.builder.graph().textures[index as usize].clone();
        let of = TextureType::from_texture(&texture);
        let Some(method) = of.find_method(name, args.len()) else {
            return Err(no_such_method(&texture, of, name, args.len(), span));
        };
        if method.is_filtered() && texture.scalar != Scalar::F32 {
            return Err(filtered_integers(&texture, name, span));
        }
        let given = self.texture_arguments(index, &texture, method, args, span)?;
        let texel = texture.texel_type();
        let four = Type::value(Scalar::F32, 4);
        let (op, args, ty) = match (method.gives, name) {
            (Gives::Size, _) => {
                let size = self.size_of(index, given.level);
                return Ok(Value::Node(self.convert_node(size, Scalar::U32)));
            }
            (Gives::Count, _) => {
                let op = match name {
                    "layers" => Op::TextureLayers(index),
                    _ => Op::TextureLevels(index),
                };
                let count = self.builder.add(op, Vec::new(), Type::I32);
                return Ok(self.as_usize(count));
            }
            (Gives::Four, "gather") => {
                let op = Op::Gather {
                    texture: index,
                    sampler: given.sampler,
                    component: given.component,
                    site: self.next_site(),
                };
                (op, given.read, four)
            }
            (Gives::Four, _) => {
                let op = Op::GatherCompare {
                    texture: index,
                    sampler: given.sampler,
                    site: self.next_site(),
                };
                (op, given.read, four)
            }
            (Gives::Share, _) => {
                let op = Op::Compare {
                    texture: index,
                    sampler: given.sampler,
                    site: self.next_site(),
                };
                (op, given.read, Type::F32)
            }
            (Gives::Texel, _) if method.is_filtered() => {
                let op = Op::Sample {
                    texture: index,
                    sampler: given.sampler,
                    site: self.next_site(),
                };
                (op, given.read, texel)
            }
            (Gives::Texel, _) => {
                let op = Op::Load {
                    texture: index,
                    site: self.next_site(),
                };
                let args = given.read.into_iter().chain(given.level).collect();
                (op, args, texel)
            }
        };
        Ok(Value::Node(self.builder.add(op, args, ty)))
    }

    /// Converts the arguments of a method to their types, and clamps coordinates to the texture.
    fn texture_arguments(
        &mut self,
        index: u32,
        texture: &Texture,
        method: &TextureMethod,
        args: &[Value],
        span: Span,
    ) -> Eval<TextureArguments> {
        let mut given = TextureArguments::default();
        let pairs = || method.params.iter().zip(args);
        let mut which = None;
        // A coordinate is clamped to the size of its level.
        for (param, arg) in pairs() {
            match param {
                Param::Level => given.level = self.clamp_level(index, arg, span)?,
                Param::Sample => which = Some(self.index_node(arg, span)?),
                Param::Layer => which = Some(self.clamp_layer(index, texture, method, arg, span)?),
                _ => {}
            }
        }
        for (param, arg) in pairs() {
            match (param, arg) {
                (Param::Level, _) => {}
                (Param::Sample | Param::Layer, _) => given.read.extend(which),
                (Param::Coordinate, coord) => {
                    let inside = self.clamp_coordinate(index, texture, coord, given.level, span)?;
                    given.read.push(inside);
                }
                (Param::Place, place) => {
                    let place = self.place_in(texture, place, span)?;
                    given.read.push(place);
                }
                (Param::Detail | Param::Reference, number) => {
                    let number = self.int_or_node(number, Scalar::F32, span)?;
                    given.read.push(number);
                }
                (Param::Step(_), step) => {
                    let step = self.place_in(texture, step, span)?;
                    given.read.push(step);
                }
                (Param::Component, component) => given.component = self.gather_component(texture, component, span)?,
                (Param::Filtering | Param::Comparing, Value::Sampler(sampler)) => {
                    let compares = self.builder.graph().samplers[*sampler as usize].comparison;
                    if compares != (*param == Param::Comparing) {
                        return Err(wrong_sampler(method.name, compares, span));
                    }
                    given.sampler = *sampler;
                }
                (Param::Filtering | Param::Comparing, _) => {
                    return Err(no_such_method(
                        texture,
                        TextureType::from_texture(texture),
                        method.name,
                        args.len(),
                        span,
                    ));
                }
            }
        }
        Ok(given)
    }

    /// Clamps a layer index to the last layer, where the sampler does not do that.
    fn clamp_layer(
        &mut self,
        index: u32,
        texture: &Texture,
        method: &TextureMethod,
        layer: &Value,
        span: Span,
    ) -> Eval<NodeId> {
        // Samplers clamp the layer themselves.
        let sampled = method
            .params
            .iter()
            .any(|p| matches!(p, Param::Filtering | Param::Comparing));
        if texture.is_counted() || sampled {
            return self.index_node(layer, span);
        }
        let layers = self.builder.add(Op::TextureLayers(index), Vec::new(), Type::I32);
        self.clamp_index(layer, layers, ["last_layer", "layer"], span)
    }

    /// Clamps a mip level to the smallest one; `None` for the finest.
    fn clamp_level(&mut self, texture: u32, level: &Value, span: Span) -> Eval<Option<NodeId>> {
        if self.known_int(level) == Some(0) {
            return Ok(None);
        }
        let levels = self.builder.add(Op::TextureLevels(texture), Vec::new(), Type::I32);
        self.clamp_index(level, levels, ["last_level", "level"], span).map(Some)
    }

    /// Clamps an index to the last of `count`. `names` are for the nodes of the last index and the clamped one.
    fn clamp_index(&mut self, index: &Value, count: NodeId, names: [&str; 2], span: Span) -> Eval<NodeId> {
        let inside = self.held_index(index, count, names[0], span)?;
        self.name_value(&Value::Node(inside), names[1], span);
        Ok(inside)
    }

    fn gather_component(&mut self, texture: &Texture, component: &Value, span: Span) -> Eval<u8> {
        match self.known_int(component) {
            Some(k) if (0..i64::from(texture.components)).contains(&k) => Ok(k as u8),
            _ => {
                let error = Diagnostic::error_at(
                    Code::RuntimeIndex,
                    span,
                    "the component to gather must be a compile-time constant, and one of the texture's",
                )
                .label("a runtime value, or out of range")
                .help(format!("use 0 to {}", texture.components - 1));
                Err(self.demand_of(&[component], error))
            }
        }
    }

    fn place_in(&mut self, texture: &Texture, place: &Value, span: Span) -> Eval<NodeId> {
        let id = self.value_node(place, span)?;
        let wanted = texture.kind.position_type();
        if self.ty(id) == wanted {
            return Ok(id);
        }
        let found = self.ty(id).in_rust();
        let help = match (texture.kind.is_cube(), wanted.component_count()) {
            (true, _) => "it is a direction, of any length but 0",
            (_, 2) => "(0, 0) is the upper left corner and (1, 1) the lower right: `(pixel.as_vec2() + 0.5) / size`",
            _ => "(0, 0, 0) and (1, 1, 1) are opposite corners: `(coord.as_vec3() + 0.5) / size`",
        };
        Err(Diagnostic::error_at(
            Code::TextureRead,
            span,
            format!("a place in `{}` is a {}, not {found}", texture.name, wanted.in_rust()),
        )
        .label("of this place")
        .help(help)
        .into())
    }

    /// Width and height of a texture or of one of its levels, and depth of a volume; the frame's size for a frame-sized
    /// texture.
    fn size_of(&mut self, texture: u32, level: Option<NodeId>) -> NodeId {
        let entry = &self.builder.graph().textures[texture as usize];
        let ty = entry.kind.coordinate_type();
        let op = match entry.framed {
            true => Op::FrameSize,
            false => Op::TextureSize(texture),
        };
        let size = self.builder.add(op, Vec::new(), ty);
        let Some(level) = level else { return size };
        // Computed instead of queried: some drivers use one pixel's level for its neighbours.
        let level = self.builder.add(Op::Splat, [level], ty);
        let halved = self.builder.add(Op::Binary(BinaryOp::Shr), [size, level], ty);
        let one = self.builder.constant(ty, one_bits(ty));
        self.builder.add(Op::Binary(BinaryOp::Max), [halved, one], ty)
    }

    /// Clamps a texel coordinate to the texture.
    fn clamp_coordinate(
        &mut self,
        index: u32,
        texture: &Texture,
        coord: &Value,
        level: Option<NodeId>,
        span: Span,
    ) -> Eval<NodeId> {
        let coord = self.value_node(coord, span)?;
        let ty = texture.kind.coordinate_type();
        if self.ty(coord) != ty {
            let message = format!(
                "a texel's coordinate is an {}, not {}",
                ty.in_rust(),
                self.ty(coord).in_rust()
            );
            return Err(Diagnostic::error_at(Code::TextureRead, span, message)
                .label("in this read")
                .help(format!("convert it with `.as_{}()`", ty.in_rust().to_lowercase()))
                .into());
        }
        let size = self.size_of(index, level);
        let one = self.builder.constant(ty, one_bits(ty));
        let zero = self.builder.constant(ty, [0; 4]);
        let last = self.builder.add(Op::Binary(BinaryOp::Sub), [size, one], ty);
        self.name_value(&Value::Node(last), "last", span);
        let inside = self.builder.add(Op::Clamp, [coord, zero, last], ty);
        self.name_value(&Value::Node(inside), "at", span);
        Ok(inside)
    }
}

fn one_bits(ty: Type) -> [u32; 4] {
    [0, 1, 2, 3].map(|k| u32::from(k < ty.component_count()))
}

fn texel_named(name: &str) -> Option<(Scalar, u8)> {
    match name {
        "f32" => Some((Scalar::F32, 1)),
        "i32" => Some((Scalar::I32, 1)),
        "u32" => Some((Scalar::U32, 1)),
        vector => vector_type(vector),
    }
}

fn no_texels(name: &str, of: &TextureType, args: &[SourceType], span: Span) -> Exit {
    let integer = matches!(args, [SourceType::Name(texel, _)] if texel_named(texel).is_some());
    if integer {
        let others: Vec<String> = TEXTURES
            .iter()
            .filter(|ty| ty.integers)
            .map(|ty| format!("`{}`", ty.name))
            .collect();
        let (last, first) = others.split_last().expect("some are of integers");
        return Diagnostic::error_at(
            Code::ResourceElement,
            span,
            format!("a `{}` has no texels of integers", of.name),
        )
        .label("of this type")
        .help(format!(
            "texels of `{}` are f32, Vec2, Vec3 or Vec4; integers are those of {} and {last}",
            of.name,
            first.join(", ")
        ))
        .into();
    }
    let help = match of.integers {
        true => "texels are f32, Vec2, Vec3 or Vec4, or their like of i32 or u32: u32, UVec2, IVec4",
        false => "texels are f32, Vec2, Vec3 or Vec4",
    };
    Diagnostic::error_at(
        Code::ResourceElement,
        span,
        format!("the texture `{name}` has no texels that a shader can read"),
    )
    .label("of this type")
    .help(help)
    .into()
}

fn filtered_integers(texture: &Texture, name: &str, span: Span) -> Exit {
    let ty = texture.texel_type().in_rust();
    Diagnostic::error_at(
        Code::TextureRead,
        span,
        format!(
            "`{name}` weighs texels, and those of `{}` are integers: {ty}",
            texture.name
        ),
    )
    .label("no sampler reads these")
    .help("read texels by `load`; numbers to be weighed belong into a texture of floats")
    .into()
}

fn wrong_sampler(method: &str, compares: bool, span: Span) -> Exit {
    match compares {
        true => Diagnostic::error_at(Code::TextureRead, span, "a `ComparisonSampler` does not filter colours")
            .help("take a `&Sampler`"),
        false => Diagnostic::error_at(
            Code::TextureRead,
            span,
            format!("`{method}` needs a `ComparisonSampler`"),
        )
        .help("take a `&ComparisonSampler`"),
    }
    .into()
}

fn no_such_method(texture: &Texture, of: &TextureType, name: &str, given: usize, span: Span) -> Exit {
    if let Some(method) = of.method_named(name)
        && method.params.len() != given
    {
        let arguments = |n: usize| format!("{n} argument{}", if n == 1 { "" } else { "s" });
        let message = format!(
            "this method takes {} but {} {} supplied",
            arguments(method.params.len()),
            arguments(given),
            if given == 1 { "was" } else { "were" }
        );
        return Diagnostic::error_at(Code::ArgumentCount, span, message)
            .label(format!("`{name}` of a `{}`", of.name))
            .help(format!("write {}", of.format_method(method)))
            .into();
    }
    let error = Diagnostic::error_at(
        Code::UnknownMethod,
        span,
        format!("there is no method `{name}` on a `{}`", of.name),
    )
    .label("not there");
    let others = TEXTURES.iter().filter(|ty| ty.method_named(name).is_some());
    let others: Vec<String> = others.map(|ty| format!("`{}`", ty.name)).collect();
    let error = match others.is_empty() {
        true => error,
        false => error.note(format!("it is a method of {}", others.join(", "))),
    };
    error
        .help(format!("it has {}", of.describe_methods(texture.scalar)))
        .into()
}

//! Verification of reads and writes.

use crate::ir::{Access, AtomicOp, Graph, Invocation, Memory, Node, Op, Scalar, Texture, TextureKind, Type};

/// Checks an operation on a texture or a buffer with arguments of `types`.
pub fn check_resource_op(graph: &Graph, node: &Node, types: &[Type]) -> Result<(), String> {
    let expect = |holds: bool, what: &str| super::expect_types(holds, what, types);
    let count = |n: usize| expect(types.len() == n, "wrong number of arguments");
    match &node.op {
        Op::TextureSize(texture) => {
            let entry = find_texture(graph, *texture)?;
            count(0)?;
            expect(node.ty == entry.kind.coordinate_type(), "a size is a vector of i32")
        }
        Op::TextureLevels(texture) => {
            let entry = find_texture(graph, *texture)?;
            count(0)?;
            let levels = entry.kind != TextureKind::Multisampled;
            expect(levels && node.ty == Type::I32, "a number of levels is an i32")
        }
        Op::TextureLayers(texture) => {
            let entry = find_texture(graph, *texture)?;
            count(0)?;
            let layers = entry.kind.has_layers();
            expect(layers && node.ty == Type::I32, "a number of layers is an i32")
        }
        Op::Load { texture, .. } => {
            let entry = find_texture(graph, *texture)?;
            let least = 1 + usize::from(entry.kind.is_indexed());
            let levels = usize::from(entry.kind != TextureKind::Multisampled);
            expect(
                (least..=least + levels).contains(&types.len()),
                "wrong number of arguments",
            )?;
            expect(
                types[0] == entry.kind.coordinate_type() && !entry.kind.is_cube(),
                &format!("a coordinate is a {}", entry.kind.coordinate_type()),
            )?;
            expect(
                types[1..].iter().all(|t| *t == Type::I32),
                "a layer and a level are an i32",
            )?;
            expect(node.ty == entry.texel_type(), "a texel of the texture's components")
        }
        Op::Sample { texture, sampler, .. } => {
            let entry = find_texture(graph, *texture)?;
            let through = graph.samplers.get(*sampler as usize).ok_or("no such sampler")?;
            expect(
                entry.kind.is_filtered() && entry.scalar == Scalar::F32 && !through.comparison,
                "a texture of floats and a filtering sampler",
            )?;
            let (place, layers) = (entry.kind.position_type(), usize::from(entry.kind.has_layers()));
            let least = 1 + layers;
            expect((least..=least + 2).contains(&types.len()), "wrong number of arguments")?;
            let placed = types[0] == place && types[1..least].iter().all(|t| *t == Type::I32);
            expect(
                placed && node.ty == entry.texel_type(),
                "a place to what the texture holds",
            )?;
            match types[least..] {
                [] => Ok(()),
                [level] => expect(level == Type::F32, "a level is an f32"),
                _ => expect(
                    types[least..].iter().all(|t| *t == place),
                    "steps are of the place's type",
                ),
            }
        }
        Op::Gather {
            texture,
            sampler,
            component,
            ..
        } => {
            let entry = find_texture(graph, *texture)?;
            let through = graph.samplers.get(*sampler as usize).ok_or("no such sampler")?;
            let layers = usize::from(entry.kind.has_layers());
            count(1 + layers)?;
            expect(
                matches!(entry.kind, TextureKind::Flat | TextureKind::Layers)
                    && entry.scalar == Scalar::F32
                    && !through.comparison,
                "a flat texture of floats, or layers of them, and a sampler that does not compare",
            )?;
            let placed = types[0] == entry.kind.position_type() && types[1..].iter().all(|t| *t == Type::I32);
            expect(
                placed && node.ty == Type::value(Scalar::F32, 4),
                "a vec2<f32> to a component of four texels",
            )?;
            expect(
                *component < entry.components,
                "a component that the texture does not have",
            )
        }
        Op::Compare { texture, sampler, .. } => {
            let entry = find_texture(graph, *texture)?;
            let through = graph.samplers.get(*sampler as usize).ok_or("no such sampler")?;
            let layers = usize::from(entry.kind.has_layers());
            count(2 + layers)?;
            expect(
                entry.kind.is_depth() && through.comparison,
                "a depth texture and a comparison sampler",
            )?;
            let placed = types[0] == entry.kind.position_type() && types[1..=layers].iter().all(|t| *t == Type::I32);
            expect(
                placed && types.last() == Some(&Type::F32) && node.ty == Type::F32,
                "a place and a reference, an f32, to an f32",
            )
        }
        Op::GatherCompare { texture, sampler, .. } => {
            let entry = find_texture(graph, *texture)?;
            let through = graph.samplers.get(*sampler as usize).ok_or("no such sampler")?;
            count(2)?;
            expect(
                entry.kind == TextureKind::Depth && through.comparison,
                "a depth texture and a comparison sampler",
            )?;
            let fits = types[0] == Type::value(Scalar::F32, 2)
                && types[1] == Type::F32
                && node.ty == Type::value(Scalar::F32, 4);
            expect(fits, "a vec2<f32> and an f32 to a vec4<f32>")
        }
        Op::BufferLen(buffer) => {
            count(0)?;
            expect((*buffer as usize) < graph.buffers.len(), "no such buffer")?;
            expect(node.ty == Type::I32, "a length is an i32")
        }
        Op::BufferLoad { buffer, field, .. } => {
            let entry = graph.buffers.get(*buffer as usize).ok_or("no such buffer")?;
            let part = entry.element.field_type(*field).ok_or("no such field")?;
            count(1 + usize::from(part.is_array()))?;
            expect(
                types.iter().all(|t| *t == Type::I32) && node.ty == part.element_type(),
                "an index to an element",
            )?;
            expect(entry.access == Access::Read, "a buffer that is only read")
        }
        Op::Atomic { memory, op } => {
            let (element, access) = memory_of(graph, *memory)?;
            count(if *op == AtomicOp::Load { 2 } else { 3 })?;
            expect(
                types[0] == Type::BOOL && types[1] == Type::I32 && types.get(2).is_none_or(|t| *t == node.ty),
                "a condition, an index and an element",
            )?;
            let integer = matches!(node.ty, Type::I32 | Type::U32);
            expect(
                integer && node.ty == element && access == Access::Atomic,
                "an integer of memory of atomics",
            )
        }
        Op::Store(memory) => {
            let (element, access) = memory_of(graph, *memory)?;
            count(3)?;
            let index = match memory {
                Memory::Image(_) => Type::value(Scalar::I32, 2),
                Memory::Buffer(_) | Memory::Shared(_) => Type::I32,
            };
            expect(
                types == [Type::BOOL, index, element],
                "a condition, an index and an element",
            )?;
            expect(
                access == Access::Write && node.ty == Type::Results,
                "memory that is written",
            )
        }
        Op::SharedLoad(shared) => {
            let (element, access) = memory_of(graph, Memory::Shared(*shared))?;
            count(2)?;
            expect(
                types == [Type::BOOL, Type::I32] && node.ty == element && access == Access::Write,
                "a condition and an index to an element that is no atomic one",
            )
        }
        Op::Barrier { .. } => {
            count(0)?;
            expect(
                matches!(graph.invocation, Invocation::Group(_)) && node.ty == Type::Results,
                "invocations of a workgroup",
            )
        }
        _ => Err("an operation without a rule".to_owned()),
    }
}

fn find_texture(graph: &Graph, index: u32) -> Result<&Texture, String> {
    let found = graph.textures.get(index as usize);
    found.ok_or_else(|| "no such texture".to_owned())
}

/// Returns the type of a memory's elements, and the accesses by effects.
fn memory_of(graph: &Graph, memory: Memory) -> Result<(Type, Access), String> {
    let group = matches!(graph.invocation, Invocation::Group(_));
    let found = match memory {
        Memory::Buffer(k) => graph
            .buffers
            .get(k as usize)
            .map(|buffer| (buffer.value_type(), buffer.access)),
        Memory::Shared(k) => graph.shared.get(k as usize).filter(|_| group).map(|shared| {
            let access = if shared.atomic { Access::Atomic } else { Access::Write };
            (shared.element, access)
        }),
        Memory::Image(k) => graph.images.get(k as usize).map(|image| (image.ty, Access::Write)),
    };
    found.ok_or_else(|| "no such memory".to_owned())
}

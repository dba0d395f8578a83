//! Kernels inside other kernels: a texel of a picture where another kernel needs it.

use crate::ir::{BinaryOp, Builder, Graph, Node, NodeId, Op, Scalar, Texture, Type};
use crate::limits;
use std::cell::RefCell;
use std::sync::Arc;
use straightline_manifest::chain::{BadRule, SizeOp, SizeRule, SizeTerm};

const PAIR: Type = Type::value(Scalar::I32, 2);

/// Indices of a kernel's tables in those of the kernel that contains it.
#[derive(Default)]
pub struct Maps {
    /// `None` for textures that the other kernel does not have.
    pub textures: Vec<Option<u32>>,
    samplers: Vec<u32>,
    buffers: Vec<u32>,
    uniforms: Vec<u32>,
    overrides: Vec<u32>,
    tallies: Vec<u32>,
    files: Vec<u32>,
}

impl Maps {
    /// Adds to `graph` what it lacks of the tables of `inner`, but for textures whose names `leave_out` holds for. Textures,
    /// samplers, buffers and uniforms are one where they have one name.
    pub fn merged(graph: &mut Graph, inner: &Graph, leave_out: &dyn Fn(&str) -> bool) -> Maps {
        let textures = inner.textures.iter().map(|of| {
            let is_kept = !leave_out(&of.name);
            is_kept.then(|| merge_one(&mut graph.textures, of, |a, b| a.name == b.name))
        });
        let maps = Maps {
            textures: textures.collect(),
            samplers: merge(&mut graph.samplers, &inner.samplers, |a, b| a.name == b.name),
            buffers: merge(&mut graph.buffers, &inner.buffers, |a, b| a.name == b.name),
            uniforms: merge(&mut graph.uniforms, &inner.uniforms, |a, b| a.name == b.name),
            overrides: merge(&mut graph.overrides, &inner.overrides, |a, b| a.id == b.id),
            tallies: merge(&mut graph.tallies, &inner.tallies, |a, b| a == b),
            files: merge(&mut graph.files, &inner.files, |a, b| a == b),
        };
        for (of, index) in inner.textures.iter().zip(&maps.textures) {
            if let Some(index) = index {
                let texture = &mut graph.textures[*index as usize];
                texture.components = texture.components.max(of.components);
            }
        }
        for (of, index) in inner.samplers.iter().zip(&maps.samplers) {
            graph.samplers[*index as usize].filters |= of.filters;
        }
        let mut purposes = graph.purposes.to_vec();
        purposes.extend(inner.purposes.iter().map(|purpose| {
            let mut purpose = purpose.clone();
            purpose.file = maps.files[purpose.file as usize];
            purpose
        }));
        purposes.sort();
        purposes.dedup();
        graph.purposes = Arc::from(purposes);
        maps
    }

    /// An operation of the inner kernel on the tables of the outer one.
    fn moved(&self, op: &Op) -> Op {
        let mut op = op.clone();
        let texture_of = |k: u32| self.textures[k as usize].expect("textures that are left out are replaced");
        match &mut op {
            Op::Load { texture, .. }
            | Op::TextureSize(texture)
            | Op::TextureLevels(texture)
            | Op::TextureLayers(texture) => *texture = texture_of(*texture),
            Op::Sample { texture, sampler, .. }
            | Op::Gather { texture, sampler, .. }
            | Op::Compare { texture, sampler, .. }
            | Op::GatherCompare { texture, sampler, .. } => {
                *texture = texture_of(*texture);
                *sampler = self.samplers[*sampler as usize];
            }
            Op::BufferLen(buffer) | Op::BufferLoad { buffer, .. } => *buffer = self.buffers[*buffer as usize],
            Op::Uniform(uniform) => *uniform = self.uniforms[*uniform as usize],
            Op::Override(of) => *of = self.overrides[*of as usize],
            Op::Tally(tally) => *tally = self.tallies[*tally as usize],
            _ => {}
        }
        op
    }
}

/// Pixel at which an inner kernel is computed.
pub struct Pixel<'a> {
    /// Its coordinate, inside the picture.
    pub coordinate: NodeId,
    /// Width and height of the picture.
    pub size: &'a dyn Fn(&mut Builder<'_>) -> NodeId,
}

/// Replacement of a node of an inner kernel, of arguments in the outer one.
pub type ReplaceRead<'a> = dyn FnMut(&mut Builder<'_>, &Node, &[NodeId]) -> Option<NodeId> + 'a;

/// Computes the texel of a kernel at a pixel. `None` if there are too many operations.
pub fn inline_texel(
    builder: &mut Builder<'_>,
    kernel: &Graph,
    maps: &Maps,
    pixel: &Pixel<'_>,
    replace_read: &mut ReplaceRead<'_>,
) -> Option<NodeId> {
    let mut made: Vec<NodeId> = Vec::with_capacity(kernel.nodes.len());
    for id in kernel.node_ids() {
        if limits::exceeded_limit(builder.graph().nodes.len()).is_some() {
            return None;
        }
        let node = kernel.node(id);
        let args: Vec<NodeId> = node.args.iter().map(|arg| made[arg.0 as usize]).collect();
        let replaced = node.op.texture().and_then(|_| replace_read(builder, node, &args));
        let copy = match (&node.op, replaced) {
            (_, Some(replaced)) => replaced,
            (Op::Pixel, _) => pixel.coordinate,
            (Op::FrameSize, _) => (pixel.size)(builder),
            (Op::Extract(0), _) if builder.graph().ty(args[0]) == node.ty => args[0],
            (op, _) => {
                let op = maps.moved(op);
                let ty = match (&op, op.texture()) {
                    (Op::Load { .. } | Op::Sample { .. }, Some(texture)) => {
                        builder.graph().textures[texture as usize].texel_type()
                    }
                    _ => node.ty,
                };
                match op {
                    Op::Const(_) => builder.intern(op, args, ty),
                    op => builder.add(op, args, ty),
                }
            }
        };
        let file = |of: u32| maps.files.get(of as usize).copied().unwrap_or(of);
        builder.place_nodes(|| {
            let mut place = kernel.place(id)?.clone();
            place.span.file = file(place.span.file);
            Some(place)
        });
        if let Some(origin) = kernel.origin(id) {
            let mut origin = origin.clone();
            origin.file = file(origin.file);
            if copy != pixel.coordinate {
                builder.set_origin(copy, &origin);
            }
        }
        made.push(copy);
    }
    Some(made[kernel.outputs()[0].0 as usize])
}

/// Adds the textures that a rule names, if they are among `sized`.
pub fn add_sized(graph: &mut Graph, rule: &SizeRule, sized: &[Texture]) {
    let is_named = |name: &str| {
        rule.0
            .iter()
            .any(|term| matches!(term, SizeTerm::Of(of) if *of == name))
    };
    for texture in sized.iter().filter(|texture| is_named(&texture.name)) {
        if graph.textures.iter().all(|known| known.name != texture.name) {
            let framed = false;
            graph.textures.push(Texture {
                framed,
                ..texture.clone()
            });
        }
    }
}

/// A size by its rule, in the sizes of textures that the graph has.
pub fn size_node(builder: &mut Builder<'_>, rule: &SizeRule) -> NodeId {
    let builder = RefCell::new(builder);
    let number = |[x, y]: [u32; 2]| builder.borrow_mut().constant(PAIR, [x, y, 0, 0]);
    let of = |name: &str| {
        let mut builder = builder.borrow_mut();
        let textures = &builder.graph().textures;
        let index = textures.iter().position(|texture| texture.name == name);
        let index = index.ok_or_else(|| BadRule(format!("no texture `{name}`")))?;
        let op = match textures[index].framed {
            true => Op::FrameSize,
            false => Op::TextureSize(index as u32),
        };
        Ok(builder.add(op, [], PAIR))
    };
    let apply = |op: SizeOp, a: NodeId, b: NodeId| {
        let op = match op {
            SizeOp::Add => BinaryOp::Add,
            SizeOp::Sub => BinaryOp::Sub,
            SizeOp::Mul => BinaryOp::Mul,
            SizeOp::Div => BinaryOp::Div,
            SizeOp::Max => BinaryOp::Max,
            SizeOp::Min => BinaryOp::Min,
        };
        builder.borrow_mut().add(Op::Binary(op), [a, b], PAIR)
    };
    let size = rule.fold(of, number, apply).expect("the textures were added before");
    let builder = builder.into_inner();
    let one = builder.constant(PAIR, [1, 1, 0, 0]);
    builder.add(Op::Binary(BinaryOp::Max), [size, one], PAIR)
}

/// A texel with as many components as `ty` has, of one with at least as many.
pub fn with_components(builder: &mut Builder<'_>, texel: NodeId, ty: Type) -> NodeId {
    if builder.graph().ty(texel) == ty {
        return texel;
    }
    let scalar = ty.scalar_kind().map_or(Type::F32, Type::scalar);
    let parts: Vec<NodeId> = (0..ty.component_count())
        .map(|k| builder.add(Op::Extract(k), [texel], scalar))
        .collect();
    match parts.as_slice() {
        [only] => *only,
        parts => builder.add(Op::Compose, parts, ty),
    }
}

/// Appends what a table lacks, and returns the indices of all of it.
fn merge<T: Clone>(table: &mut Vec<T>, other: &[T], same: impl Fn(&T, &T) -> bool) -> Vec<u32> {
    other.iter().map(|of| merge_one(table, of, &same)).collect()
}

/// Appends an entry that a table lacks, and returns its index.
fn merge_one<T: Clone>(table: &mut Vec<T>, of: &T, same: impl Fn(&T, &T) -> bool) -> u32 {
    let found = table.iter().position(|known| same(known, of));
    let index = found.unwrap_or_else(|| {
        table.push(of.clone());
        table.len() - 1
    });
    index as u32
}

//! Running a graph on the CPU, in the precision asked for.

mod bindings;
mod control;
mod cube;
mod divergence;
mod finite;
mod group;
mod memory;
mod sampling;

use crate::ir::arith::{self, Cells};
use crate::ir::{Counter, Graph, Invocation, Memory, NodeId, Op, Real, Scalar, TextureKind, Type};
use crate::passes::Schedule;
use memory::Memories;
use sampling::{Detail, Sampled};
use std::marker::PhantomData;

pub use bindings::{Address, Bindings, Comparison, Image, InputError, SamplerState, Texels};
pub use divergence::{Divergence, first_divergence};
pub use finite::NonFiniteOrigin;
pub use memory::Disorder;

/// A graph with its inputs, ready to compute any pixel. `R` is the precision of its floats.
pub struct Interpreter<'a, R: Real = f32> {
    graph: &'a Graph,
    schedule: &'a Schedule,
    frame: [u32; 2],
    /// Width and height of each image.
    image_sizes: Vec<[u32; 2]>,
    textures: Vec<Option<&'a dyn Texels>>,
    samplers: Vec<SamplerState>,
    buffers: Vec<Vec<Cells>>,
    uniforms: Vec<Cells>,
    overrides: Vec<Cells>,
    watches: bool,
    precision: PhantomData<R>,
}

/// Iterations of all loops of one invocation after which it is taken not to end.
pub const MOST_ITERATIONS: u64 = 1 << 24;

/// Room for the values of one pixel at a time: make one a thread and use it again.
#[derive(Clone)]
pub struct Scratch {
    values: Vec<Cells>,
    arrays: Vec<Vec<Cells>>,
    /// Counters of the structured loops around, outer ones first.
    loops: Vec<(NodeId, i64)>,
    /// Iterations of the last invocation, of all its loops.
    iterations: u64,
    non_finite_origin: Option<NonFiniteOrigin>,
    /// Values in the order of their computation, if they are traced.
    trace: Option<divergence::Trace>,
    /// Memory that the kernel writes.
    memory: Memories,
    /// Position of the invocation in its workgroup.
    local: [u32; 2],
    /// State of each invocation of a workgroup, row by row; empty for other kernels.
    threads: Vec<Scratch>,
}

impl Scratch {
    /// Returns the first operation of the last pixel that produced a NaN or an infinity, if the interpreter watches for them.
    pub fn non_finite_origin(&self) -> Option<&NonFiniteOrigin> {
        self.non_finite_origin.as_ref()
    }

    /// Returns whether the last invocation was ended because its loops had more than [`MOST_ITERATIONS`]: its result is meaningless.
    pub fn is_endless(&self) -> bool {
        let mut all = std::iter::once(self).chain(&self.threads);
        all.any(|scratch| scratch.iterations > MOST_ITERATIONS)
    }

    /// Returns the first undefined behaviour of the invocations of a workgroup.
    pub fn disorder(&self) -> Option<&Disorder> {
        self.memory.disorder()
    }
}

impl<'a> Interpreter<'a, f32> {
    /// Binds inputs, for arithmetic in `f32`, bit for bit that of the kernel as rustc compiles it.
    ///
    /// # Errors
    ///
    /// If something that the graph reads is not bound or does not fit.
    pub fn new(
        graph: &'a Graph,
        schedule: &'a Schedule,
        frame: [u32; 2],
        bindings: &Bindings<'a>,
    ) -> Result<Self, InputError> {
        Interpreter::in_precision(graph, schedule, frame, bindings)
    }
}

impl<'a, R: Real> Interpreter<'a, R> {
    /// Binds inputs, for arithmetic in `R`.
    ///
    /// # Errors
    ///
    /// If something that the graph reads is not bound or does not fit.
    pub fn in_precision(
        graph: &'a Graph,
        schedule: &'a Schedule,
        frame: [u32; 2],
        bindings: &Bindings<'a>,
    ) -> Result<Self, InputError> {
        if graph.invocation == Invocation::Lane {
            return Err(InputError::Lanes);
        }
        bindings::check_bindings(graph, schedule, frame, bindings)?;
        let cells = |ty, lanes: &[f64]| arith::host_cells::<R>(ty, &bindings::element_bits(ty, lanes));
        let textures = graph
            .textures
            .iter()
            .map(|t| bindings::find_entry(&bindings.textures, &t.name).copied());
        let samplers = graph.samplers.iter().map(|s| {
            bindings::find_entry(&bindings.samplers, &s.name)
                .copied()
                .unwrap_or_default()
        });
        let buffers = graph.buffers.iter().map(|buffer| {
            let elements = bindings::find_entry(&bindings.buffers, &buffer.name)
                .copied()
                .unwrap_or_default();
            let types = buffer.element.value_types();
            let types = types.iter().cycle();
            elements
                .iter()
                .zip(types)
                .map(|(lanes, ty)| cells(*ty, lanes))
                .collect()
        });
        let uniforms = graph.uniforms.iter().map(|uniform| {
            let given = bindings::find_entry(&bindings.uniforms, &uniform.name).map(Vec::as_slice);
            let default = [uniform.default.unwrap_or(0.0)];
            cells(uniform.ty, given.unwrap_or(&default))
        });
        let overrides = graph.overrides.iter().map(|of| {
            let given = bindings::find_entry(&bindings.uniforms, &of.name).map(Vec::as_slice);
            cells(of.ty, given.unwrap_or(&[of.default]))
        });
        Ok(Interpreter {
            graph,
            schedule,
            frame,
            image_sizes: vec![frame; graph.images.len()],
            textures: textures.collect(),
            samplers: samplers.collect(),
            buffers: buffers.collect(),
            uniforms: uniforms.collect(),
            overrides: overrides.collect(),
            watches: false,
            precision: PhantomData,
        })
    }

    /// Sets the sizes of images that have their own, in the order of [`Graph::images`]. Others have that of the frame.
    pub fn with_image_sizes(mut self, sizes: Vec<[u32; 2]>) -> Self {
        self.image_sizes = sizes;
        self
    }

    /// Notes for each pixel where it first had a NaN or an infinity, see [`Scratch::non_finite_origin`].
    pub fn track_non_finite(mut self) -> Self {
        self.watches = true;
        self
    }

    /// Room for this graph's values.
    pub fn new_scratch(&self) -> Scratch {
        let mut values = vec![[0; 4]; self.graph.nodes.len()];
        for id in self.graph.node_ids() {
            if let Some(bits) = self.graph.constant_bits(id) {
                values[id.0 as usize] = arith::constant_cells::<R>(self.graph.ty(id), &bits);
            }
        }
        let one = Scratch {
            values,
            arrays: vec![Vec::new(); self.graph.nodes.len()],
            loops: Vec::new(),
            iterations: 0,
            non_finite_origin: None,
            trace: None,
            memory: Memories::default(),
            local: [0, 0],
            threads: Vec::new(),
        };
        let threads = match self.graph.invocation {
            Invocation::Group([width, height]) => {
                let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
                places.map(|local| Scratch { local, ..one.clone() }).collect()
            }
            _ => Vec::new(),
        };
        Scratch {
            memory: Memories::new(self.graph, &self.buffers, &self.image_sizes),
            threads,
            ..one
        }
    }

    /// Returns the value of the first target of a pixel inside the frame: see [`Interpreter::run_invocation`].
    pub fn run_pixel(&self, x: u32, y: u32, scratch: &mut Scratch) -> [R; 4] {
        let [width, height] = self.graph.invocation.tile_size();
        let (left, upper) = (x % width, y % height);
        self.run_invocation(x - left, y - upper, scratch)[(upper * width + left) as usize]
    }

    /// Runs the invocation whose upper left pixel is given, or its whole workgroup, and returns the values of the first target of all its
    /// pixels, row by row; those outside of the frame are meaningless. Components that a value lacks are 0, and the fourth is 1.
    /// [`Interpreter::target_values`] returns the other targets.
    pub fn run_invocation(&self, x: u32, y: u32, scratch: &mut Scratch) -> Vec<[R; 4]> {
        scratch.non_finite_origin = None;
        scratch.iterations = 0;
        scratch.threads.iter_mut().for_each(|thread| thread.iterations = 0);
        match scratch.threads.is_empty() {
            true => self.run_block(&self.schedule.body, [x, y], scratch),
            false => self.run_workgroup([x, y], scratch),
        }
        self.target_cells(0, scratch)
            .map(|(ty, cells)| match ty.is_float() {
                true => {
                    let lane = |k: usize| match k < ty.component_count() as usize {
                        true => R::from_bits(cells[k]),
                        false => R::from_f64(f64::from(u8::from(k == 3))),
                    };
                    [lane(0), lane(1), lane(2), lane(3)]
                }
                false => to_texel::<R>(ty, cells).map(R::from_f64),
            })
            .collect()
    }

    /// Returns the values of a target, by its index in [`Graph::targets`], of all pixels of the last invocation, in the order of
    /// [`Interpreter::run_invocation`]: floats and integers as they are.
    pub fn target_values(&self, index: usize, scratch: &Scratch) -> Vec<[f64; 4]> {
        self.target_cells(index, scratch)
            .map(|(ty, cells)| to_texel::<R>(ty, cells))
            .collect()
    }

    /// Type and value of a target, pixel by pixel.
    fn target_cells<'s>(&'s self, target: usize, scratch: &'s Scratch) -> impl Iterator<Item = (Type, Cells)> + 's {
        let all = match scratch.threads.is_empty() {
            true => std::slice::from_ref(scratch),
            false => &scratch.threads,
        };
        all.iter().flat_map(move |scratch| {
            let ids = self.graph.outputs().iter().skip(target);
            let ids = ids.step_by(self.graph.targets.len().max(1));
            ids.map(|id| (self.graph.ty(*id), scratch.values[id.0 as usize]))
        })
    }

    /// Returns the present contents of a buffer that is written, by its index in [`Graph::buffers`]: each element in as many lanes as it
    /// has.
    pub fn buffer_contents(&self, index: usize, scratch: &Scratch) -> Vec<[f64; 4]> {
        let ty = self.graph.buffers[index].value_type();
        let lanes = ty.component_count() as usize;
        let elements = scratch.memory.buffer(index).iter().map(|cells| {
            let all = to_texel::<R>(ty, *cells);
            std::array::from_fn(|k| if k < lanes { all[k] } else { 0.0 })
        });
        elements.collect()
    }

    /// Returns the present contents of a picture that is written at any place, by its index in [`Graph::images`], row by row: 0 where
    /// nothing was stored.
    pub fn image_contents(&self, index: usize, scratch: &Scratch) -> Vec<[f64; 4]> {
        let ty = self.graph.images[index].ty;
        let texels = scratch.memory.image(index).iter();
        texels
            .map(|cells| cells.map_or([0.0; 4], |cells| to_texel::<R>(ty, cells)))
            .collect()
    }

    /// Does what an effect does, and gives what was there before.
    fn run_effect(&self, id: NodeId, s: &mut Scratch) -> Cells {
        let node = self.graph.node(id);
        let arg = |k: usize| s.values[node.args[k].0 as usize];
        let Some(memory) = node.op.memory() else { return [0; 4] };
        let at = arg(1).map(|cell| cell as u32 as usize);
        let index = match memory {
            Memory::Image(k) => at[1] * self.image_sizes[k as usize][0] as usize + at[0],
            Memory::Buffer(_) | Memory::Shared(_) => at[0],
        };
        let holds = arg(0)[0] != 0;
        let value = node.args.get(2).map_or([0; 4], |id| s.values[id.0 as usize]);
        if !holds {
            return [0; 4];
        }
        match node.op {
            Op::SharedLoad(_) => s.memory.load_shared(memory, index),
            Op::Atomic { op, .. } => {
                let change = |before: Cells| [arith::apply_atomic(op, node.ty, before[0], value[0]), 0, 0, 0];
                s.memory.change(memory, index, change)
            }
            _ => s.memory.store(memory, index, value),
        }
    }

    fn eval(&self, id: NodeId, pixel: [u32; 2], s: &mut Scratch) {
        let node = self.graph.node(id);
        let slot = id.0 as usize;
        match &node.op {
            Op::Const(_) => {}
            Op::Undef => s.values[slot] = [0; 4],
            Op::Pixel => s.values[slot] = [pixel[0].into(), pixel[1].into(), 0, 0],
            Op::Thread => s.values[slot] = [s.local[0].into(), s.local[1].into(), 0, 0],
            Op::GroupOrigin => {
                let [x, y] = [0, 1].map(|k| u64::from(pixel[k] - s.local[k]));
                s.values[slot] = [x, y, 0, 0];
            }
            Op::Inside => s.values[slot] = [(0..2).all(|k| pixel[k] < self.frame[k]).into(), 0, 0, 0],
            Op::FrameSize => s.values[slot] = [self.frame[0].into(), self.frame[1].into(), 0, 0],
            Op::Uniform(k) => s.values[slot] = self.uniforms[*k as usize],
            Op::Override(k) => s.values[slot] = self.overrides[*k as usize],
            op if op.is_effect() => s.values[slot] = self.run_effect(id, s),
            op if op.is_read() || op.texture().is_some() || op.buffer().is_some() => {
                s.values[slot] = self.eval_read(op, &node.args, s);
            }
            Op::MakeArray => {
                let values = &s.values;
                s.arrays[slot] = node.args.iter().map(|a| values[a.0 as usize]).collect();
            }
            Op::ArrayGet => {
                let array = &s.arrays[node.args[0].0 as usize];
                let index = s.values[node.args[1].0 as usize][0] as u32 as usize;
                s.values[slot] = array[index.min(array.len() - 1)];
            }
            Op::ArraySet => {
                let old = node.args[0];
                // Changed where it is, if nothing else looks at it: else a loop over it would take the square of its length.
                let mut array = if self.is_last_use(old, id) {
                    std::mem::take(&mut s.arrays[old.0 as usize])
                } else {
                    s.arrays[old.0 as usize].clone()
                };
                let index = s.values[node.args[1].0 as usize][0] as u32 as usize;
                let last = array.len() - 1;
                array[index.min(last)] = s.values[node.args[2].0 as usize];
                s.arrays[slot] = array;
            }
            Op::Result(k) => {
                let value = self.result_cells(node.args[0], *k as usize, s);
                store_cells(self.graph, s, id, value);
            }
            op => {
                let operand = node.args.last().map_or(node.ty, |a| match op {
                    Op::Select => self.graph.ty(*a),
                    _ => self.graph.ty(node.args[0]),
                });
                let mut args = [[0; 4]; 4];
                for (slot, arg) in args.iter_mut().zip(&node.args) {
                    *slot = s.values[arg.0 as usize];
                }
                s.values[slot] = arith::apply_op::<R>(op, operand, &args, node.ty).expect("a verified graph");
            }
        }
        if self.watches && s.non_finite_origin.is_none() && node.ty.is_float() && !node.ty.is_array() {
            self.note_non_finite(id, s);
        }
        if s.trace.is_some() {
            self.trace_value(id, s);
        }
    }

    /// Evaluates a read. Every resource that is read has been bound.
    fn eval_read(&self, op: &Op, args: &[NodeId], s: &Scratch) -> Cells {
        let word = |k: usize, lane: usize| args.get(k).map_or(0, |a| s.values[a.0 as usize][lane] as u32);
        let real = |k: usize, lane: usize| R::from_bits(s.values[args[k].0 as usize][lane]);
        // A sampler is other hardware, and reads and gives what it computes in.
        let outer = |k: usize, lane: usize| R::Sampled::from_f64(real(k, lane).to_f64());
        let inner = |x: R::Sampled| R::from_f64(x.to_f64()).to_bits();
        let vector = |k: usize| [0, 1, 2].map(|lane| outer(k, lane));
        if let Some(buffer) = op.buffer() {
            let (values, element) = (
                &self.buffers[buffer as usize],
                &self.graph.buffers[buffer as usize].element,
            );
            let each = element.value_types().len();
            return match op {
                Op::BufferLoad { field, .. } => {
                    let part = element.field_type(*field).map_or(1, Type::part_count);
                    let within = element.first_value(*field) + word(1, 0).min(part - 1) as usize;
                    values[(word(0, 0) as usize).min(values.len() / each - 1) * each + within]
                }
                _ => [(values.len() / each) as u64, 0, 0, 0],
            };
        }
        let Some(index) = op.texture() else { return [0; 4] };
        let (texture, Some(image)) = (&self.graph.textures[index as usize], self.textures[index as usize]) else {
            return [0; 4];
        };
        let state = op
            .sampler()
            .map_or_else(SamplerState::default, |k| self.samplers[k as usize]);
        let signed = |k: usize| i64::from(word(k, 0) as i32);
        let indexed = usize::from(texture.kind.is_indexed());
        let through = Sampled {
            image,
            kind: texture.kind,
            state,
            layer: signed(1).clamp(0, i64::from(image.extent(0)[2]) - 1) as u32 * indexed as u32,
        };
        match op {
            Op::TextureSize(_) => {
                let [width, height, depth] = image.extent(0).map(u64::from);
                let depth = if texture.kind == TextureKind::Volume { depth } else { 0 };
                [width, height, depth, 0]
            }
            Op::TextureLevels(_) => [image.levels().into(), 0, 0, 0],
            Op::TextureLayers(_) => [image.extent(0)[2].into(), 0, 0, 0],
            Op::Load { .. } => {
                let level = word(1 + indexed, 0).min(image.levels() - 1);
                let layer = if texture.kind == TextureKind::Volume {
                    word(0, 2)
                } else {
                    word(1, 0) * indexed as u32
                };
                let bits = image.texel(word(0, 0), word(0, 1), layer, level);
                match texture.scalar {
                    Scalar::F32 => bits.map(|v| R::from_f64(f32::from_bits(v).into()).to_bits()),
                    _ => bits.map(u64::from),
                }
            }
            Op::Gather { component, .. } => through.gather(*component, vector(0)).map(inner),
            Op::GatherCompare { .. } => through.gather_compare(vector(0), outer(1, 0)).map(inner),
            Op::Compare { .. } => [inner(through.compare(vector(0), outer(1 + indexed, 0))), 0, 0, 0],
            _ => {
                let detail = match args.len() - indexed {
                    1 => Detail::Finest,
                    2 => Detail::Level(outer(1 + indexed, 0)),
                    _ => Detail::Steps([vector(1 + indexed), vector(2 + indexed)]),
                };
                through.sample(vector(0), &detail).map(inner)
            }
        }
    }

    /// Notes a number that is not finite and comes of finite ones.
    fn note_non_finite(&self, id: NodeId, s: &mut Scratch) {
        let finite = |id: NodeId| {
            let ty = self.graph.ty(id);
            let lanes = &s.values[id.0 as usize][..ty.component_count() as usize];
            ty.scalar_kind() != Some(Scalar::F32)
                || ty.is_array()
                || lanes.iter().all(|c| R::from_bits(*c).to_f64().is_finite())
        };
        if finite(id) || !self.graph.node(id).args.iter().all(|a| finite(*a)) {
            return;
        }
        let lanes = &s.values[id.0 as usize][..self.graph.ty(id).component_count() as usize];
        let kept = s.loops.iter().map(|(param, value)| Counter {
            name: self.graph.origin(*param).map_or("k", |o| &*o.name).into(),
            value: *value,
        });
        let unrolled = self
            .graph
            .origin(id)
            .into_iter()
            .flat_map(|o| o.counters.iter().cloned());
        s.non_finite_origin = Some(NonFiniteOrigin {
            node: id,
            value: lanes.iter().map(|c| R::from_bits(*c).to_f64()).collect(),
            counters: kept.chain(unrolled).collect(),
        });
    }

    /// Result `k` of a loop or branch, cut from the values that all its results were left in.
    fn result_cells(&self, owner: NodeId, k: usize, s: &Scratch) -> Vec<Cells> {
        let region = self.graph.region(self.graph.regions_of(owner)[0]);
        let sizes: Vec<usize> = region.results.iter().map(|r| cell_count(self.graph.ty(*r))).collect();
        let from: usize = sizes[..k].iter().sum();
        s.arrays[owner.0 as usize][from..from + sizes[k]].to_vec()
    }
}

/// A value as a texel holds it.
fn to_texel<R: Real>(ty: Type, cells: Cells) -> [f64; 4] {
    std::array::from_fn(|k| match ty.scalar_kind() {
        _ if k >= ty.component_count() as usize => f64::from(u8::from(k == 3)),
        Some(Scalar::F32) => R::from_bits(cells[k]).to_f64(),
        Some(Scalar::I32) => f64::from(cells[k] as u32 as i32),
        _ => f64::from(cells[k] as u32),
    })
}

fn cell_count(ty: Type) -> usize {
    match ty {
        Type::Array { len, .. } => len as usize,
        _ => 1,
    }
}

fn load_cells(graph: &Graph, s: &Scratch, id: NodeId) -> Vec<Cells> {
    if graph.ty(id).is_array() {
        s.arrays[id.0 as usize].clone()
    } else {
        vec![s.values[id.0 as usize]]
    }
}

fn store_cells(graph: &Graph, s: &mut Scratch, id: NodeId, value: Vec<Cells>) {
    if graph.ty(id).is_array() {
        s.arrays[id.0 as usize] = value;
    } else {
        s.values[id.0 as usize] = value[0];
    }
}

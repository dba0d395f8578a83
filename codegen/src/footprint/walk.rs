//! Evaluates a schedule on probes, and records each read with its place.
//!
//! Loops left in the shader run as often as their bounds say. Where a bound is unknown, the body runs once with an unknown
//! counter.

use super::facts::{Causes, MemoryReads, Messages, Method};
use super::place::{Place, Probe, assumed_varying, find_place, level_size, probe_positions};
use super::record::{FoundTap, Record};
use super::value::{PROBES, Part, Value, apply_values, merge_values};
use straightline_evaluator::ir::arith::Cells;
use straightline_evaluator::ir::{Axis, Graph, Invocation, NodeId, Op, RegionId, Type};
use straightline_evaluator::passes::{Block, Schedule, Step};

/// Maximum number of values computed in loops. A loop beyond it runs once, with an unknown counter.
const MOST_WORK: u64 = 200_000;

/// Maximum number of taps of loops.
const MOST_TAPS: usize = 16_384;

/// Everything found in a schedule.
pub struct Found {
    /// Reads; sums refer to them by index.
    pub taps: Vec<FoundTap>,
    /// By pixel, row by row: value of the first target.
    pub results: Vec<Value>,
    pub messages: Vec<Messages>,
    pub memories: Vec<MemoryReads>,
}

/// Evaluates a schedule.
pub fn find_reads(graph: &Graph, schedule: &Schedule) -> Found {
    let lanes = if graph.invocation == Invocation::Lane { 4 } else { 1 };
    let mut walk = Walk {
        graph,
        lanes,
        probes: probe_positions(graph),
        values: vec![Vec::new(); graph.nodes.len()],
        record: Record::default(),
        conditions: 0,
        work: 0,
    };
    walk.run_block(&schedule.body);
    let targets = graph.targets.len().max(1);
    let results = match lanes {
        1 => graph
            .outputs()
            .iter()
            .step_by(targets)
            .map(|id| walk.value(*id, 0))
            .collect(),
        _ => {
            let output = graph.outputs().first();
            output.map_or(Vec::new(), |id| (0..lanes).map(|lane| walk.value(*id, lane)).collect())
        }
    };
    let Record {
        taps,
        messages,
        memories,
        ..
    } = walk.record;
    let messages = messages.into_iter().map(|(direction, (messages, values))| Messages {
        direction,
        messages,
        values,
    });
    let memories = memories
        .into_iter()
        .map(|((name, workgroup), reads)| MemoryReads { name, workgroup, reads });
    Found {
        taps,
        results,
        messages: messages.collect(),
        memories: memories.collect(),
    }
}

struct Walk<'g> {
    graph: &'g Graph,
    lanes: usize,
    probes: [Probe; PROBES],
    /// By node and lane.
    values: Vec<Vec<Value>>,
    record: Record,
    /// Number of runtime conditions around.
    conditions: u32,
    work: u64,
}

impl Walk<'_> {
    fn value(&self, id: NodeId, lane: usize) -> Value {
        let found = self.values[id.0 as usize].get(lane).cloned();
        found.unwrap_or_else(|| Value::unknown(self.graph.ty(id), Causes::default()))
    }

    fn run_block(&mut self, block: &Block) {
        for step in &block.steps {
            match step {
                Step::Eval(id) => self.eval_node(*id),
                Step::Loop { node, body } => self.run_loop(*node, body),
                Step::If { node, then, otherwise } => self.run_branch(*node, then, otherwise),
            }
        }
    }

    fn run_branch(&mut self, node: NodeId, then: &Block, otherwise: &Block) {
        let condition = self.value(self.graph.node(node).args[0], 0);
        let regions = self.graph.regions_of(node);
        let values = match condition.constant_cell() {
            Some(cell) => {
                let (block, region) = if cell != 0 {
                    (then, regions[0])
                } else {
                    (otherwise, regions[1])
                };
                self.run_block(block);
                self.region_results(region)
            }
            None => {
                self.conditions += 1;
                self.run_block(then);
                let yes = self.region_results(regions[0]);
                self.run_block(otherwise);
                let no = self.region_results(regions[1]);
                self.conditions -= 1;
                let causes = condition.causes();
                yes.iter()
                    .zip(&no)
                    .map(|(yes, no)| merge_values(yes, no, causes))
                    .collect()
            }
        };
        self.values[node.0 as usize] = values;
    }

    /// Results of a region by lane, each as a list.
    fn region_results(&self, region: RegionId) -> Vec<Value> {
        let results = &self.graph.region(region).results;
        let of_lane = |lane| Value::List(results.iter().map(|id| self.value(*id, lane)).collect());
        (0..self.lanes).map(of_lane).collect()
    }

    fn run_loop(&mut self, node: NodeId, body: &Block) {
        let region = self.graph.regions_of(node)[0];
        let args = &self.graph.node(node).args;
        let bound = |k: usize| Some(self.value(args[k], 0).constant_cell()? as u32 as i32);
        let carried = |lane| Value::List(args[2..].iter().map(|id| self.value(*id, lane)).collect());
        let first: Vec<Value> = (0..self.lanes).map(carried).collect();
        let bounds = bound(0).zip(bound(1));
        let before = (self.record.clone(), self.conditions);
        let found = bounds.and_then(|(start, end)| self.run_iterations(region, body, start..end, first));
        self.values[node.0 as usize] = found.unwrap_or_else(|| {
            (self.record, self.conditions) = before;
            self.run_once(region, body)
        });
    }

    /// Runs a loop iteration by iteration. Returns the carried values by lane; `None` if there is too much work.
    fn run_iterations(
        &mut self,
        region: RegionId,
        body: &Block,
        range: std::ops::Range<i32>,
        mut carried: Vec<Value>,
    ) -> Option<Vec<Value>> {
        let conditions = self.conditions;
        let mut unknown_stop = None;
        for k in range {
            if self.work > MOST_WORK || self.record.taps.len() > MOST_TAPS {
                return None;
            }
            let counter = Value::from_cells(1, [[u64::from(k as u32), 0, 0, 0]; PROBES]);
            self.set_params(region, |_| counter.clone(), &carried);
            self.run_block(body);
            carried = self.region_results(region);
            let Some(stop) = self.graph.region(region).stop else {
                continue;
            };
            let stop = self.value(stop, 0);
            match stop.constant_cell() {
                Some(0) => {}
                Some(_) => break,
                None if unknown_stop.is_none() => {
                    unknown_stop = Some(stop.causes());
                    self.conditions += 1;
                }
                None => {}
            }
        }
        self.conditions = conditions;
        if let Some(causes) = unknown_stop {
            let unknown = |value: Value| forget_value(value, causes);
            carried = carried.into_iter().map(unknown).collect();
        }
        Some(carried)
    }

    /// Runs a loop's body once, for any iteration.
    fn run_once(&mut self, region: RegionId, body: &Block) -> Vec<Value> {
        let params = self.graph.region(region).params.clone();
        let unknown = |id: &NodeId| Value::unknown(self.graph.ty(*id), Causes::LOOPS);
        let carried = Value::List(params.iter().skip(1).map(unknown).collect());
        let carried = vec![carried; self.lanes];
        self.conditions += 1;
        self.set_params(region, |ty| Value::unknown(ty, Causes::LOOPS), &carried);
        self.run_block(body);
        self.conditions -= 1;
        let results = self.region_results(region);
        results
            .into_iter()
            .map(|value| forget_value(value, Causes::LOOPS))
            .collect()
    }

    fn set_params(&mut self, region: RegionId, counter: impl Fn(Type) -> Value, carried: &[Value]) {
        for (k, param) in self.graph.region(region).params.iter().enumerate() {
            let ty = self.graph.ty(*param);
            let of_lane = |lane: usize| match k {
                0 => counter(ty),
                _ => carried[lane].element(k - 1, ty),
            };
            self.values[param.0 as usize] = (0..self.lanes).map(of_lane).collect();
        }
    }

    fn eval_node(&mut self, id: NodeId) {
        self.work += self.lanes as u64;
        let node = self.graph.node(id);
        if let Op::QuadSwap(direction) = node.op {
            self.record.count_message(direction.axis_bits(), node.ty);
        } else if let Op::Derivative(axis) = node.op {
            self.record
                .count_message(if axis == Axis::X { [1, 0] } else { [0, 1] }, node.ty);
        }
        let values = (0..self.lanes).map(|lane| self.eval_lane(id, lane)).collect();
        self.values[id.0 as usize] = values;
    }

    /// Evaluates a node in a lane.
    fn eval_lane(&mut self, id: NodeId, lane: usize) -> Value {
        let node = self.graph.node(id);
        let position = [lane as u32 % 2, lane as u32 / 2];
        let pair = |of: &dyn Fn(&Probe) -> [u32; 2]| {
            let cells: [Cells; PROBES] = self.probes.each_ref().map(|probe| {
                let [x, y] = of(probe);
                [u64::from(x), u64::from(y), 0, 0]
            });
            Value::from_cells(2, cells)
        };
        let other = |bits: [u32; 2]| {
            let [x, y] = [position[0] ^ bits[0], position[1] ^ bits[1]];
            (y * 2 + x) as usize
        };
        match &node.op {
            Op::Pixel => pair(&|probe| [probe.base[0] + position[0], probe.base[1] + position[1]]),
            Op::FrameSize => pair(&|probe| probe.frame),
            Op::GroupOrigin => pair(&|probe| probe.group),
            Op::Thread => pair(&|probe| probe.thread),
            Op::Lane => pair(&|_| position),
            Op::Inside => Value::from_cells(1, [[1, 0, 0, 0]; PROBES]),
            Op::TextureSize(texture) => {
                let framed = self.graph.textures[*texture as usize].framed;
                let cells = self.probes.each_ref().map(|probe| {
                    let [x, y, z] = match framed {
                        true => [probe.frame[0], probe.frame[1], 1],
                        false => probe.own_size,
                    };
                    [u64::from(x), u64::from(y), u64::from(z), 0]
                });
                Value::from_cells(usize::from(node.ty.component_count()), cells)
            }
            Op::QuadSwap(direction) => self.value(node.args[0], other(direction.axis_bits())),
            Op::Derivative(axis) => {
                let bits = if *axis == Axis::X { [1, 0] } else { [0, 1] };
                let (low, high) = (lane.min(other(bits)), lane.max(other(bits)));
                let (low, high) = (self.value(node.args[0], low), self.value(node.args[0], high));
                let sub = Op::Binary(straightline_evaluator::ir::BinaryOp::Sub);
                apply_values(&sub, node.ty, &[&high, &low], node.ty)
            }
            Op::Uniform(_) | Op::Override(_) => Value::unknown(node.ty, Causes::UNIFORMS),
            Op::Varying(_) => {
                let cells = std::array::from_fn(|probe| {
                    std::array::from_fn(|component| assumed_varying(probe, lane, component).to_bits())
                });
                Value::assumed(usize::from(node.ty.component_count()), cells, Causes::VARYINGS)
            }
            Op::TextureLevels(_) | Op::TextureLayers(_) | Op::BufferLen(_) => Value::unknown(node.ty, Causes::READS),
            Op::Result(k) => self.value(node.args[0], lane).element(*k as usize, node.ty),
            Op::SharedLoad(_) | Op::Store(_) | Op::Atomic { .. } | Op::Barrier { .. } => {
                if let Op::SharedLoad(k) = &node.op {
                    self.record.count_memory(&self.graph.shared[*k as usize].name, true);
                }
                Value::unknown(node.ty, Causes::WORKGROUP)
            }
            Op::BufferLoad { buffer, .. } => {
                self.record
                    .count_memory(&self.graph.buffers[*buffer as usize].name, false);
                Value::unknown(node.ty, Causes::READS)
            }
            op if op.is_read() => self.read_texture(id, lane),
            Op::Undef | Op::Param(..) => Value::unknown(node.ty, Causes::LOOPS),
            op => {
                let operand = node.args.first().map_or(node.ty, |id| self.graph.ty(*id));
                // The condition of a selection is of another type than its values.
                let args: Vec<Value> = node.args.iter().map(|id| self.value(*id, lane)).collect();
                apply_values(op, operand, &args.iter().collect::<Vec<_>>(), node.ty)
            }
        }
    }

    /// Records a read of a texture. Returns a sum of the tap for floats.
    fn read_texture(&mut self, id: NodeId, lane: usize) -> Value {
        let node = self.graph.node(id);
        let index = node.op.texture().unwrap_or_default();
        let texture = &self.graph.textures[index as usize];
        let method = match node.op {
            Op::Load { .. } => Method::Load,
            Op::Gather { .. } => Method::Gather,
            Op::Compare { .. } => Method::Compare,
            Op::GatherCompare { .. } => Method::GatherCompare,
            _ => Method::Sample,
        };
        let args: Vec<Value> = node.args.iter().map(|id| self.value(*id, lane)).collect();
        let indexed = usize::from(texture.kind.is_indexed());
        let layer = match indexed {
            1 => args.get(1).and_then(Value::constant_cell).map(|cell| cell as u32),
            _ => None,
        };
        let level = match (method, args.get(1 + indexed)) {
            (Method::Load, Some(level)) => level.constant_cell().map_or(0, |cell| cell as u32),
            (Method::Sample, Some(level)) if args.len() == 2 + indexed => {
                level.constant_cell().map_or(0, |cell| f64::from_bits(cell) as u32)
            }
            _ => 0,
        };
        let sizes = self
            .probes
            .each_ref()
            .map(|probe| level_size(probe, texture.framed, level));
        let mut place = find_place(
            &self.probes,
            texture.kind,
            sizes,
            args[0].parts(),
            method != Method::Load,
        );
        // A layer that is not constant is no place.
        if let (1, Some(value), None) = (indexed, args.get(1), layer) {
            place = Place::Elsewhere(value.causes());
        }
        let found = FoundTap {
            texture: index,
            method,
            layer,
            level,
            lane: lane as u32,
            place,
            reads: 1,
            conditional: self.conditions > 0,
        };
        let tap = self.record.add_tap(found);
        let count = node.ty.component_count();
        match node.ty.is_float() {
            true => Value::Vector((0..count).map(|component| Part::tap(tap, component)).collect()),
            false => Value::unknown(node.ty, Causes::READS),
        }
    }
}

/// Makes every part of a value unknown.
fn forget_value(value: Value, causes: Causes) -> Value {
    match value {
        Value::Vector(parts) => Value::Vector(
            parts
                .iter()
                .map(|part| Part::Unknown(causes.with(part.causes())))
                .collect(),
        ),
        Value::List(all) => Value::List(all.into_iter().map(|value| forget_value(value, causes)).collect()),
    }
}

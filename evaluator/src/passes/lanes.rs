//! Alternatives to quad operations for the lanes of a quad: four pixels in one invocation, and swaps by derivatives.

use super::fold::Exact;
use crate::ir::{
    Axis, BinaryOp, Builder, Counter, Event, Graph, Invocation, NodeId, Op, Origin, QuadDirection, Rebuild, RegionId,
    Rules, Scalar, Texture, TextureKind, Type, copy_tables, rebuild_graph,
};

const PAIR: Type = Type::value(Scalar::I32, 2);

/// Makes one invocation compute a block of pixels, or one or more quads of a quad kernel. The lanes run in step, and a swap
/// is the other lane's value itself. Values common to the lanes, above all reads, are computed once.
///
/// # Errors
///
/// The reason why the kernel's pixels cannot run in step: a structured loop or branch that may differ between them.
pub fn expand_lanes(graph: &Graph, size: [u32; 2]) -> Result<Graph, String> {
    if graph.has_effects() {
        return Err("it writes to buffers, and pixels that lie outside of the frame would too".to_owned());
    }
    let lanes = (size[0] * size[1]) as usize;
    let mut builder = Builder::new(&Exact);
    copy_tables(graph, builder.graph_mut());
    let tables = builder.graph_mut();
    tables.invocation = Invocation::Block(size);
    // Interpolated values are read from images of the same names.
    let first_varying = tables.textures.len() as u32;
    for varying in std::mem::take(&mut tables.varyings) {
        tables.textures.push(Texture {
            name: varying.name,
            kind: TextureKind::Flat,
            scalar: Scalar::F32,
            components: varying.ty.component_count(),
            declared: varying.ty.component_count(),
            framed: true,
        });
    }
    let mut expansion = Expansion {
        old: graph,
        builder,
        size,
        lanes,
        first_varying,
        ids: vec![Vec::new(); graph.nodes.len()],
        regions: vec![None; graph.regions.len()],
    };
    expansion.regions[0] = Some(Graph::BODY);
    let mut events = graph.events.iter().peekable();
    for id in graph.node_ids() {
        while let Some((_, event)) = events.next_if(|(at, _)| *at <= id.0) {
            expansion.event(*event);
        }
        if expansion.ids[id.0 as usize].is_empty() {
            expansion.node(id)?;
        }
    }
    for (_, event) in events {
        if *event != Event::Close(Graph::BODY) {
            expansion.event(*event);
        }
    }
    let of_lane = |lane: usize| graph.outputs().iter().map(move |output| (output, lane));
    let outputs = (0..lanes).flat_map(of_lane);
    let outputs = outputs
        .map(|(output, lane)| expansion.ids[output.0 as usize][lane])
        .collect();
    Ok(expansion.builder.finish(outputs))
}

struct Expansion<'g> {
    old: &'g Graph,
    builder: Builder<'g>,
    size: [u32; 2],
    lanes: usize,
    first_varying: u32,
    /// By old node, its new one in each lane.
    ids: Vec<Vec<NodeId>>,
    regions: Vec<Option<RegionId>>,
}

impl Expansion<'_> {
    fn event(&mut self, event: Event) {
        match event {
            Event::Open(region) => self.open(region),
            // Results of a region may be newer than its end: they are set when the loop or branch is built.
            Event::Close(_) => self.builder.close_region(Vec::new()),
        }
    }

    /// Opens a region with a parameter for each lane; the counter of a loop is shared.
    fn open(&mut self, region: RegionId) {
        let params = self.old.region(region).params.clone();
        let mut types = Vec::new();
        for (k, param) in params.iter().enumerate() {
            let times = if k == 0 { 1 } else { self.lanes };
            types.extend(std::iter::repeat_n(self.old.ty(*param), times));
        }
        let new = self.builder.open_region(&types);
        self.regions[region.0 as usize] = Some(new);
        let mut made = self.builder.graph().region(new).params.clone().into_iter();
        for (k, param) in params.iter().enumerate() {
            let times = if k == 0 { 1 } else { self.lanes };
            let mut ids: Vec<NodeId> = made.by_ref().take(times).collect();
            ids.resize(self.lanes, ids[0]);
            self.record_lanes(*param, ids);
        }
    }

    fn node(&mut self, id: NodeId) -> Result<(), String> {
        let node = self.old.node(id).clone();
        let new: Vec<NodeId> = match &node.op {
            Op::Loop(body) => {
                for bound in &node.args[..2] {
                    self.require_uniform(*bound, "a loop whose trip count may differ from pixel to pixel")?;
                }
                if let Some(stop) = self.old.region(*body).stop {
                    self.require_uniform(stop, "a loop that each pixel may leave in another round")?;
                }
                let mut args = vec![
                    self.ids[node.args[0].0 as usize][0],
                    self.ids[node.args[1].0 as usize][0],
                ];
                args.extend(node.args[2..].iter().flat_map(|a| self.ids[a.0 as usize].clone()));
                self.set_results(*body);
                let op = Op::Loop(self.new_region(*body));
                vec![self.builder.add(op, args, node.ty); self.lanes]
            }
            Op::If(then, otherwise) => {
                self.require_uniform(node.args[0], "a branch of which each pixel may take another side")?;
                self.set_results(*then);
                self.set_results(*otherwise);
                let op = Op::If(self.new_region(*then), self.new_region(*otherwise));
                let condition = self.ids[node.args[0].0 as usize][0];
                vec![self.builder.add(op, [condition], node.ty); self.lanes]
            }
            _ => (0..self.lanes).map(|lane| self.in_lane(id, lane)).collect(),
        };
        self.record_lanes(id, new);
        self.builder.place_nodes(|| self.old.place(id).cloned());
        Ok(())
    }

    fn new_region(&self, old: RegionId) -> RegionId {
        self.regions[old.0 as usize].expect("regions are opened before their owner is built")
    }

    fn set_results(&mut self, region: RegionId) {
        let results = self.old.region(region).results.iter();
        let results = results.flat_map(|r| self.ids[r.0 as usize].clone()).collect();
        let new = self.new_region(region);
        self.builder.graph_mut().regions[new.0 as usize].results = results;
        if let Some(stop) = self.old.region(region).stop {
            let stop = self.ids[stop.0 as usize][0];
            self.builder.set_stop(new, stop);
        }
    }

    /// Rejects a value that differs between lanes.
    fn require_uniform(&self, id: NodeId, what: &str) -> Result<(), String> {
        let lanes = &self.ids[id.0 as usize];
        if lanes.iter().all(|lane| *lane == lanes[0]) {
            return Ok(());
        }
        Err(what.to_owned())
    }

    fn in_lane(&mut self, id: NodeId, lane: usize) -> NodeId {
        let node = self.old.node(id).clone();
        let arg = |k: usize, lane: usize| self.ids[node.args[k].0 as usize][lane];
        match &node.op {
            Op::Const(bits) => self.builder.constant(node.ty, *bits),
            Op::Pixel => self.lane_pixel(lane),
            Op::Lane => {
                let [x, y] = self.position(lane);
                self.builder.constant(PAIR, [x % 2, y % 2, 0, 0])
            }
            Op::QuadSwap(direction) => {
                let [x, y] = self.position(lane);
                let [right, below] = direction.axis_bits();
                arg(0, self.lane([x ^ right, y ^ below]))
            }
            Op::Derivative(axis) => {
                let [x, y] = self.position(lane);
                let [right, below] = if *axis == Axis::X { [1, 0] } else { [0, 1] };
                let (from, to) = ([x & !right, y & !below], [x | right, y | below]);
                let (from, to) = (arg(0, self.lane(from)), arg(0, self.lane(to)));
                self.builder.add(Op::Binary(BinaryOp::Sub), [to, from], node.ty)
            }
            Op::Varying(k) => {
                let inside = self.clamped_pixel(lane);
                let texture = self.first_varying + k;
                self.builder.add(Op::Load { texture, site: 0 }, [inside], node.ty)
            }
            Op::Result(k) => {
                let owner = arg(0, 0);
                let k = k * self.lanes as u32 + lane as u32;
                self.builder.add(Op::Result(k), [owner], node.ty)
            }
            op => {
                let args: Vec<NodeId> = (0..node.args.len()).map(|k| arg(k, lane)).collect();
                self.builder.add(op.clone(), args, node.ty)
            }
        }
    }

    fn position(&self, lane: usize) -> [u32; 2] {
        [lane as u32 % self.size[0], lane as u32 / self.size[0]]
    }

    fn lane(&self, [x, y]: [u32; 2]) -> usize {
        (y * self.size[0] + x) as usize
    }

    fn lane_pixel(&mut self, lane: usize) -> NodeId {
        let [x, y] = self.position(lane);
        let corner = self.builder.add(Op::Pixel, Vec::new(), PAIR);
        let offset = self.builder.constant(PAIR, [x, y, 0, 0]);
        self.builder.add(Op::Binary(BinaryOp::Add), [corner, offset], PAIR)
    }

    /// Pixel of the lane, or the nearest one in the frame.
    fn clamped_pixel(&mut self, lane: usize) -> NodeId {
        let pixel = self.lane_pixel(lane);
        let frame = self.builder.add(Op::FrameSize, Vec::new(), PAIR);
        let one = self.builder.constant(PAIR, [1, 1, 0, 0]);
        let zero = self.builder.constant(PAIR, [0; 4]);
        let last = self.builder.add(Op::Binary(BinaryOp::Sub), [frame, one], PAIR);
        self.builder.add(Op::Clamp, [pixel, zero, last], PAIR)
    }

    /// Records the new nodes of an old one, and gives them its name, with the lane where they differ.
    fn record_lanes(&mut self, old: NodeId, new: Vec<NodeId>) {
        let alike = new.iter().all(|id| *id == new[0]);
        if let Some(origin) = self.old.origin(old) {
            for (lane, id) in new.iter().enumerate() {
                let op = &self.builder.graph().node(*id).op;
                let fixed = matches!(
                    op,
                    Op::Const(_) | Op::Pixel | Op::FrameSize | Op::Uniform(_) | Op::Override(_)
                );
                if fixed && *op != self.old.node(old).op {
                    continue;
                }
                let mut origin = origin.clone();
                if !alike {
                    let own = Counter {
                        name: "lane".into(),
                        value: lane as i64,
                    };
                    origin.counters = origin.counters.iter().cloned().chain([own]).collect();
                }
                self.builder.set_origin(*id, &origin);
            }
        }
        self.ids[old.0 as usize] = new;
    }
}

/// Implements swaps with fine derivatives, as in the chapter that `docs/quads.md` describes: a value plus or minus its
/// difference from the other lane's. Exact only where that difference and the sum with it are exact. A diagonal swap takes
/// two steps.
///
/// # Errors
///
/// Fails for a swap of integers or booleans, because derivatives exist only for floats.
pub fn by_derivatives(graph: &Graph) -> Result<Graph, String> {
    let unfit = graph
        .nodes
        .iter()
        .find(|n| matches!(n.op, Op::QuadSwap(_)) && !n.ty.is_float());
    if let Some(node) = unfit {
        return Err(format!(
            "a message of {}, and derivatives are of floats alone",
            node.ty.in_rust()
        ));
    }
    let pass = Rebuild {
        rules: &Derivatives,
        share_loads: false,
    };
    Ok(rebuild_graph(graph, &pass))
}

struct Derivatives;

impl Rules for Derivatives {
    fn simplify(&self, b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
        match op {
            Op::QuadSwap(QuadDirection::Horizontal) => Some(neighbour_value(b, Axis::X, args[0], ty)),
            Op::QuadSwap(QuadDirection::Vertical) => Some(neighbour_value(b, Axis::Y, args[0], ty)),
            Op::QuadSwap(QuadDirection::Diagonal) => {
                let vertical = neighbour_value(b, Axis::Y, args[0], ty);
                Some(neighbour_value(b, Axis::X, vertical, ty))
            }
            _ => Exact.simplify(b, op, args, ty),
        }
    }
}

/// value + derivative, or value - derivative in the lane from which the difference is subtracted.
fn neighbour_value(b: &mut Builder<'_>, axis: Axis, value: NodeId, ty: Type) -> NodeId {
    let pair = Type::value(Scalar::F32, 2);
    let lane = b.add(Op::Lane, Vec::new(), PAIR);
    let lane = b.add(Op::Convert, [lane], pair);
    let [one, two] = [1.0f32, 2.0].map(|x| b.constant(pair, [x.to_bits(), x.to_bits(), 0, 0]));
    let twice = b.add(Op::Binary(BinaryOp::Mul), [lane, two], pair);
    let towards = b.add(Op::Binary(BinaryOp::Sub), [one, twice], pair);
    let origin = b.graph().origin(value).cloned();
    let named = |name: String| {
        origin.clone().map(|origin| Origin {
            name: name.into(),
            ..origin
        })
    };
    if let Some(origin) = named("towards".to_owned()) {
        b.set_origin(towards, &origin);
    }
    let mut sign = b.add(Op::Extract(axis as u8), [towards], Type::F32);
    if ty.component_count() > 1 {
        sign = b.add(Op::Splat, [sign], ty);
    }
    let slope = b.add(Op::Derivative(axis), [value], ty);
    let step = b.add(Op::Binary(BinaryOp::Mul), [sign, slope], ty);
    let message = b.add(Op::Binary(BinaryOp::Add), [value, step], ty);
    let from = if axis == Axis::X { "beside" } else { "below" };
    let whose = origin.as_ref().map_or("", |o| &*o.name);
    if let Some(origin) = named(format!("{whose}_{from}")) {
        b.set_origin(message, &origin);
    }
    message
}

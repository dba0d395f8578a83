//! The graph as text, for people and for tests; [`super::parse`] reads it back.
//!
//! Tables first, then one node a line, indented by region, and the kernel's results last. A kernel without a `target`
//! returns one colour:
//!
//! ```text
//! file kernels/src/glow.rs
//! texture color: flat 4 frame
//! uniform tau: f32 = 500
//! %0: f32 = const 1.0
//! %1: f32 = uniform tau
//! %2: f32 = binary Add %0 %1    // sum @0:31 sample=2
//! ...
//! output %7
//! ```

use super::{Access, Element, Event, Field, Graph, Invocation, NodeId, Op, OutputTarget, Scalar, Type};
use std::fmt::Write;

/// Prints the whole graph.
pub fn print(graph: &Graph) -> String {
    let mut text = print_tables(graph);
    let mut depth = 0usize;
    let mut events = graph.events.iter().peekable();
    for id in graph.node_ids() {
        while let Some((_, event)) = events.next_if(|(at, _)| *at <= id.0) {
            depth = print_event(&mut text, depth, event);
        }
        let _ = writeln!(text, "{}{}", "  ".repeat(depth), print_node(graph, id));
    }
    for (_, event) in events {
        depth = print_event(&mut text, depth, event);
    }
    let outputs: String = graph.outputs().iter().map(|id| format!(" %{}", id.0)).collect();
    let _ = writeln!(text, "output{outputs}");
    text
}

fn print_tables(graph: &Graph) -> String {
    let mut text = String::new();
    for file in &graph.files {
        let _ = writeln!(text, "file {file}");
    }
    for t in &graph.textures {
        let size = if t.framed { "frame" } else { "own" };
        let number = match t.scalar {
            Scalar::F32 => String::new(),
            integer => format!(" {integer}"),
        };
        let _ = writeln!(
            text,
            "texture {}: {} {} {size}{number}",
            t.name,
            t.kind.ir_name(),
            t.components
        );
    }
    for b in &graph.buffers {
        let element = match &b.element {
            Element::Value(ty) => ty.to_string(),
            Element::Struct(structure) => {
                let field = |f: &Field| format!("{}: {}", f.name, f.ty);
                let fields: Vec<String> = structure.fields.iter().map(field).collect();
                format!("struct {} {{ {} }}", structure.name, fields.join("; "))
            }
        };
        let access = match b.access {
            Access::Read => "",
            Access::Write => " write",
            Access::Atomic => " atomic",
        };
        let _ = writeln!(text, "buffer {}: {}{access}", b.name, element);
    }
    for image in &graph.images {
        let tile = image.tile.map(|[width, height]| format!(" tile {width} {height}"));
        let _ = writeln!(text, "image {}: {}{}", image.name, image.ty, tile.unwrap_or_default());
    }
    for s in &graph.shared {
        let how = match (s.atomic, s.filled) {
            (true, _) => " atomic",
            (_, true) => " filled",
            _ => "",
        };
        let _ = writeln!(text, "shared {}: {} {}{how}", s.name, s.element, s.len);
    }
    for s in &graph.samplers {
        let kind = match (s.comparison, s.filters) {
            (true, _) => "comparison",
            (false, true) => "filtering",
            (false, false) => "nearest",
        };
        let _ = writeln!(text, "sampler {}: {kind}", s.name);
    }
    for u in &graph.uniforms {
        let default = u.default.map_or(String::new(), |d| format!(" = {d}"));
        let part = u.part.as_ref().map_or(String::new(), |part| {
            let what = if part.columns { "column" } else { "element" };
            format!(" of {} {what} {} {}", part.of, part.index, part.count)
        });
        let _ = writeln!(text, "uniform {}: {}{part}{default}", u.name, u.ty);
    }
    for o in &graph.overrides {
        let range = o
            .range
            .map_or(String::new(), |[low, high]| format!(" from {low} to {high}"));
        let _ = writeln!(text, "override {}: {} {} = {}{range}", o.name, o.ty, o.id, o.default);
    }
    for v in &graph.varyings {
        let _ = writeln!(text, "varying {}: {}", v.name, v.ty);
    }
    if graph.targets.is_empty() {
        text += "target none\n";
    } else if graph.targets != [OutputTarget::default_color()] {
        for t in &graph.targets {
            let _ = writeln!(text, "target {}: {}", t.name, t.ty);
        }
    }
    match graph.invocation {
        Invocation::Pixel => {}
        Invocation::MayBeOutside => text += "invocation may-be-outside\n",
        Invocation::Lane => text += "invocation lane\n",
        Invocation::Group([width, height]) => {
            let _ = writeln!(text, "invocation group {width} {height}");
        }
        Invocation::Block([width, height]) => {
            let _ = writeln!(text, "invocation block {width} {height}");
        }
    }
    for name in &graph.tallies {
        let _ = writeln!(text, "tally {name}");
    }
    text
}

fn print_event(text: &mut String, depth: usize, event: &Event) -> usize {
    match event {
        Event::Open(region) => {
            let _ = writeln!(text, "{}region {} {{", "  ".repeat(depth), region.0);
            depth + 1
        }
        Event::Close(Graph::BODY) => depth,
        Event::Close(_) => {
            let _ = writeln!(text, "{}}}", "  ".repeat(depth.saturating_sub(1)));
            depth.saturating_sub(1)
        }
    }
}

fn print_node(graph: &Graph, id: NodeId) -> String {
    let node = graph.node(id);
    let mut line = format!("%{}: {} = {}", id.0, node.ty, print_op(graph, &node.op, node.ty));
    for arg in &node.args {
        let _ = write!(line, " %{}", arg.0);
    }
    for region in graph.regions_of(id) {
        let _ = write!(line, " yields {}:", region.0);
        for result in &graph.region(region).results {
            let _ = write!(line, " %{}", result.0);
        }
        if let Some(stop) = graph.region(region).stop {
            let _ = write!(line, " stops %{}", stop.0);
        }
    }
    if let Some(origin) = graph.origin(id) {
        let _ = write!(line, "    // {} @{}:{}", origin.name, origin.file, origin.line);
        for counter in &*origin.counters {
            let _ = write!(line, " {}={}", counter.name, counter.value);
        }
    }
    line
}

fn print_op(graph: &Graph, op: &Op, ty: Type) -> String {
    let texture = |k: &u32| graph.textures[*k as usize].name.as_str();
    let sampler = |k: &u32| graph.samplers[*k as usize].name.as_str();
    let buffer = |k: &u32| graph.buffers[*k as usize].name.as_str();
    let at = match op.site() {
        None | Some(0) => String::new(),
        Some(site) => format!(" site={site}"),
    };
    match op {
        Op::Const(bits) => {
            let lanes = bits[..ty.component_count() as usize]
                .iter()
                .map(|b| print_component(ty, *b));
            format!("const {}", lanes.collect::<Vec<_>>().join(" "))
        }
        Op::Uniform(k) => format!("uniform {}", graph.uniforms[*k as usize].name),
        Op::Override(k) => format!("override {}", graph.overrides[*k as usize].name),
        Op::Unary(op) => format!("unary {op:?}"),
        Op::Binary(op) => format!("binary {op:?}"),
        Op::Extract(lane) => format!("extract {lane}"),
        Op::TextureSize(k) => format!("texturesize {}", texture(k)),
        Op::TextureLevels(k) => format!("texturelevels {}", texture(k)),
        Op::TextureLayers(k) => format!("texturelayers {}", texture(k)),
        Op::Load { texture: t, .. } => format!("load {}{at}", texture(t)),
        Op::Sample {
            texture: t, sampler: s, ..
        } => format!("sample {} {}{at}", texture(t), sampler(s)),
        Op::Gather {
            texture: t,
            sampler: s,
            component,
            ..
        } => format!("gather {} {} {component}{at}", texture(t), sampler(s)),
        Op::Compare {
            texture: t, sampler: s, ..
        } => format!("compare {} {}{at}", texture(t), sampler(s)),
        Op::GatherCompare {
            texture: t, sampler: s, ..
        } => format!("gathercompare {} {}{at}", texture(t), sampler(s)),
        Op::QuadSwap(direction) => format!("quad_swap {direction:?}"),
        Op::Derivative(axis) => format!("derivative {axis:?}"),
        Op::Varying(k) => format!("varying {}", graph.varyings[*k as usize].name),
        Op::BufferLen(k) => format!("bufferlen {}", buffer(k)),
        Op::Atomic { memory, op } => format!("atomic {op:?} {}", graph.memory(*memory).1),
        Op::Store(memory) => format!("store {}", graph.memory(*memory).1),
        Op::SharedLoad(k) => format!("sharedload {}", graph.shared[*k as usize].name),
        Op::Barrier { buffers: true } => "barrier buffers".to_owned(),
        Op::Barrier { buffers: false } => "barrier".to_owned(),
        Op::BufferLoad { buffer: b, field, .. } => match &graph.buffers[*b as usize].element {
            Element::Value(_) => format!("bufferload {}{at}", buffer(b)),
            Element::Struct(of) => {
                let field = of.fields.get(*field as usize).map_or("", |f| f.name.as_str());
                format!("bufferload {}.{field}{at}", buffer(b))
            }
        },
        Op::Tally(name) => format!("tally {}", graph.tallies[*name as usize]),
        Op::Loop(region) => format!("loop region={}", region.0),
        Op::If(then, otherwise) => format!("if region={} region={}", then.0, otherwise.0),
        Op::Result(k) => format!("result {k}"),
        Op::Param(region, k) => format!("param {k} region={}", region.0),
        plain => format!("{plain:?}").to_lowercase(),
    }
}

/// Prints a component such that it parses to the same bits.
fn print_component(ty: Type, bits: u32) -> String {
    match ty.scalar_kind() {
        Some(Scalar::F32) if f32::from_bits(bits).is_nan() => format!("bits:{bits:08x}"),
        Some(Scalar::F32) => format!("{:?}", f32::from_bits(bits)),
        Some(Scalar::I32) => format!("{}", bits as i32),
        _ => format!("{bits}"),
    }
}

//! Invariants of every graph.
//!
//! 1. Arguments, and a region's results and parameters, precede their users.
//! 2. Every operation has the number and types of arguments that it requires, and returns the type that it declares.
//!    Vectors have 2 to 4 components, arrays at least one element; a boolean constant is 0 or 1.
//! 3. Indices of textures, buffers, samplers, uniforms, interpolated values, tallies and regions exist. Every region except
//!    the body belongs to one loop or branch. Its parent was opened before it, and its parameters name it as their region.
//!    The regions of a branch have the same result types; a loop's carried values match its results in number and type.
//!    Only a loop may have a stop, a boolean.
//! 4. A parameter is only used inside its region.
//! 5. The kernel has a result for each target of each pixel of its invocation, of the target's type: a float, an integer or
//!    a vector of them. Names of targets are unique.
//! 6. Lane positions, quad swaps, derivatives and interpolated values occur only in kernels whose invocations are lanes of
//!    quads.
//! 7. Workgroup operations occur only in kernels whose invocations form workgroups. Shared memory consists of arrays with
//!    at least one number or vector; atomics are integers.
//! 8. Every effect that a result depends on belongs to exactly one region, whose evaluation performs it. Each loop or
//!    branch with effects belongs to the region that contains it. A region lists them in order of creation, and their
//!    values are used only inside it. No buffer is both written and read. A kernel whose invocations are blocks or lanes
//!    has no effects.
//!
//! File tests: `evaluator/tests/filetests/verify`.

mod resources;

use super::{BinaryOp, Graph, Invocation, NodeId, Op, RegionId, Scalar, Type, UnaryOp};
use std::collections::HashMap;

/// Checks a graph. The message names the node that breaks a rule.
pub fn verify_graph(graph: &Graph) -> Result<(), String> {
    check_results(graph)?;
    check_regions(graph)?;
    check_shared(graph)?;
    check_effects(graph)?;
    let mut types = Vec::new();
    for id in graph.node_ids() {
        let node = graph.node(id);
        if node.args.iter().any(|arg| *arg >= id) {
            return Err(format!("%{}: an argument is made after its user", id.0));
        }
        check_node(graph, id, &mut types).map_err(|why| format!("%{} ({:?} -> {}): {why}", id.0, node.op, node.ty))?;
    }
    check_scopes(graph)
}

/// Checks rule 5.
fn check_results(graph: &Graph) -> Result<(), String> {
    let outputs = &graph.regions.first().ok_or("no body")?.results;
    let [width, height] = graph.invocation.block_size();
    for (k, target) in graph.written_targets().enumerate() {
        let numbers = matches!(target.ty, Type::Value { scalar, components: lanes } if scalar != Scalar::Bool && (1..=4).contains(&lanes));
        if !numbers || graph.written_targets().take(k).any(|other| other.name == target.name) {
            return Err(format!(
                "the target {} is of no numbers, or there are two of it",
                target.name
            ));
        }
    }
    let known = |id: &NodeId| (id.0 as usize) < graph.nodes.len();
    let wanted = graph.targets.iter().map(|target| target.ty).cycle();
    if outputs.len() != (width * height) as usize * graph.targets.len()
        || !outputs.iter().all(known)
        || outputs.iter().zip(wanted).any(|(id, ty)| graph.ty(*id) != ty)
    {
        let targets: Vec<String> = graph.targets.iter().map(|t| t.ty.to_string()).collect();
        return Err(format!(
            "the body must have results for each pixel: {}",
            targets.join(", ")
        ));
    }
    Ok(())
}

/// Checks rule 7, except for operations.
fn check_shared(graph: &Graph) -> Result<(), String> {
    let wrong = graph.shared.iter().find(|shared| {
        let numbers = matches!(shared.element, Type::Value { scalar, .. } if scalar != Scalar::Bool);
        let atomic = matches!(shared.element, Type::I32 | Type::U32);
        shared.len == 0 || !numbers || (shared.atomic && !atomic)
    });
    match wrong {
        None => Ok(()),
        Some(shared) => Err(format!("{} is shared, but is no array of numbers", shared.name)),
    }
}

/// Checks rule 8, except for the uses of values.
fn check_effects(graph: &Graph) -> Result<(), String> {
    let mut of: Vec<Option<RegionId>> = vec![None; graph.nodes.len()];
    for (k, region) in graph.regions.iter().enumerate() {
        let known = region.effects.iter().all(|id| (id.0 as usize) < graph.nodes.len());
        if !known || !region.effects.is_sorted_by(|a, b| a < b) {
            return Err(format!("region {k} has effects that are out of order"));
        }
        for id in &region.effects {
            if of[id.0 as usize].replace(RegionId(k as u32)).is_some() {
                return Err(format!("%{} is an effect of two regions", id.0));
            }
        }
    }
    let alone = matches!(graph.invocation, Invocation::Pixel | Invocation::Group(_));
    let live = live_nodes(graph);
    for id in graph.node_ids() {
        let op = &graph.node(id).op;
        let within = graph.regions_of(id);
        let has = |region: &RegionId| !graph.region(*region).effects.is_empty();
        let wanted = match within.first() {
            Some(region) if within.iter().any(has) => graph.region(*region).parent,
            None if op.is_effect() => of[id.0 as usize],
            _ => None,
        };
        // An effect that was rolled back belongs to no region, and nothing uses it.
        let missing = of[id.0 as usize].is_none() && (op.is_effect() || wanted.is_some());
        if (missing && live[id.0 as usize]) || (!missing && of[id.0 as usize] != wanted) {
            return Err(format!("%{} is no effect of the region that it happens in", id.0));
        }
        if op.is_effect() && !alone {
            return Err(format!("%{}: an effect of an invocation that has several pixels", id.0));
        }
        if within
            .iter()
            .any(|region| graph.region(*region).effects.last().is_some_and(|last| *last >= id))
        {
            return Err(format!("%{}: an effect is made after its user", id.0));
        }
    }
    Ok(())
}

/// By node, whether results or effects depend on it.
fn live_nodes(graph: &Graph) -> Vec<bool> {
    let mut live = vec![false; graph.nodes.len()];
    let mut pending: Vec<NodeId> = [graph.outputs(), &graph.regions[0].effects].concat();
    while let Some(id) = pending.pop() {
        if !std::mem::replace(&mut live[id.0 as usize], true) {
            pending.extend(&graph.node(id).args);
            for region in graph.regions_of(id) {
                pending.extend(graph.region(region).yielded_values());
                pending.extend(&graph.region(region).effects);
            }
        }
    }
    live
}

/// Checks rules 1 and 3, as far as they concern regions.
fn check_regions(graph: &Graph) -> Result<(), String> {
    let mut owners = vec![0; graph.regions.len()];
    for id in graph.node_ids() {
        for region in graph.regions_of(id) {
            let Some(owned) = owners.get_mut(region.0 as usize) else {
                return Err(format!("%{}: no such region", id.0));
            };
            *owned += 1;
            let region = graph.region(region);
            if region
                .params
                .iter()
                .copied()
                .chain(region.yielded_values())
                .any(|inner| inner >= id)
            {
                return Err(format!("%{}: a parameter or result is made after its user", id.0));
            }
        }
    }
    for (k, region) in graph.regions.iter().enumerate() {
        let opened = region.parent.is_some_and(|parent| (parent.0 as usize) < k);
        if (k == 0 && (region.parent.is_some() || owners[k] > 0)) || (k > 0 && !opened) {
            return Err(format!("region {k} is not in a region that was opened before it"));
        }
        if owners[k] > 1 {
            return Err(format!("region {k} belongs to {} loops or branches", owners[k]));
        }
        for (index, param) in region.params.iter().enumerate() {
            let own = Op::Param(RegionId(k as u32), index as u32);
            if graph.nodes.get(param.0 as usize).is_none_or(|node| node.op != own) {
                return Err(format!("region {k} has a parameter that is not its own"));
            }
        }
    }
    Ok(())
}

fn expect_types(holds: bool, what: &str, types: &[Type]) -> Result<(), String> {
    match holds {
        true => Ok(()),
        false => Err(format!("{what}, got {types:?}")),
    }
}

/// Checks one node. `types` is a reused buffer for the types of the arguments.
fn check_node(graph: &Graph, id: NodeId, types: &mut Vec<Type>) -> Result<(), String> {
    let node = graph.node(id);
    types.clear();
    types.extend(node.args.iter().map(|a| graph.ty(*a)));
    let types = types.as_slice();
    let expect = |holds: bool, what: &str| expect_types(holds, what, types);
    let count = |n: usize| expect(types.len() == n, "wrong number of arguments");
    let shaped = match node.ty {
        Type::Value { components: lanes, .. } => (1..=4).contains(&lanes),
        Type::Array {
            components: lanes, len, ..
        } => (1..=4).contains(&lanes) && len >= 1,
        Type::Results => matches!(node.op, Op::Loop(_) | Op::If(..) | Op::Store(_) | Op::Barrier { .. }),
    };
    expect(shaped, "a type that no value has")?;
    let value = !node.ty.is_array() && node.ty != Type::Results;
    match &node.op {
        Op::Const(bits) => {
            count(0)?;
            expect(value, "a constant is a scalar or a vector")?;
            let boolean = node.ty.scalar_kind() == Some(Scalar::Bool);
            expect(!boolean || bits.iter().all(|bit| *bit <= 1), "a boolean is 0 or 1")
        }
        Op::Param(region, k) => {
            count(0)?;
            let own = graph
                .regions
                .get(region.0 as usize)
                .and_then(|r| r.params.get(*k as usize));
            expect(own == Some(&id), "no such parameter")?;
            expect(
                *k > 0 || matches!(node.ty, Type::I32 | Type::U32),
                "a counter is an i32 or a u32",
            )
        }
        Op::Undef => {
            count(0)?;
            expect(value, "a scalar or a vector")
        }
        Op::Pixel | Op::FrameSize => {
            count(0)?;
            expect(node.ty == Type::value(Scalar::I32, 2), "a coordinate is a vec2<i32>")
        }
        Op::Lane => {
            count(0)?;
            expect(graph.invocation == Invocation::Lane, "the invocation is no lane")?;
            expect(node.ty == Type::value(Scalar::I32, 2), "a position is a vec2<i32>")
        }
        Op::Thread | Op::GroupOrigin | Op::Inside => {
            count(0)?;
            expect(
                matches!(graph.invocation, Invocation::Group(_)),
                "the invocation is of no workgroup",
            )?;
            let wanted = match node.op {
                Op::Inside => Type::BOOL,
                _ => Type::value(Scalar::I32, 2),
            };
            expect(
                node.ty == wanted,
                "a position is a vec2<i32>, and whether it is inside a boolean",
            )
        }
        Op::Varying(k) => {
            let varying = graph.varyings.get(*k as usize).ok_or("no such varying")?;
            count(0)?;
            expect(graph.invocation == Invocation::Lane, "the invocation is no lane")?;
            expect(
                node.ty == varying.ty && node.ty.is_float(),
                "floats of the varying's type",
            )
        }
        Op::QuadSwap(_) | Op::Derivative(_) => {
            count(1)?;
            expect(graph.invocation == Invocation::Lane, "the invocation is no lane")?;
            let floats = matches!(node.op, Op::QuadSwap(_)) || node.ty.is_float();
            expect(
                types[0] == node.ty && !node.ty.is_array() && floats,
                "a scalar or vector, of floats for a derivative",
            )
        }
        Op::Uniform(k) => {
            let uniform = graph.uniforms.get(*k as usize).ok_or("no such uniform")?;
            count(0)?;
            expect(node.ty == uniform.ty, "of the uniform's type")
        }
        Op::Override(k) => {
            let of = graph.overrides.get(*k as usize).ok_or("no such override")?;
            count(0)?;
            let kinds = [Type::F32, Type::I32, Type::U32, Type::BOOL];
            expect(kinds.contains(&of.ty), "a number or boolean")?;
            expect(node.ty == of.ty, "of the override's type")
        }
        Op::Tally(k) => {
            count(1)?;
            expect((*k as usize) < graph.tallies.len(), "no such tally")?;
            expect(types[0] == node.ty, "type of argument and result differ")
        }
        Op::Exact | Op::Half => {
            count(1)?;
            expect(types[0] == node.ty, "type of argument and result differ")?;
            expect(value && node.ty.is_float(), "floats, which alone are rounded")
        }
        Op::Unary(op) => {
            count(1)?;
            expect(types[0] == node.ty, "type of argument and result differ")?;
            expect(
                value && node.ty.scalar_kind().is_some_and(|kind| is_defined_for(*op, kind)),
                "an operation that the type does not have",
            )
        }
        Op::Binary(op) => {
            count(2)?;
            expect(types[0] == types[1], "both sides must have one type")?;
            let ty = if op.is_comparison() {
                types[0].with_scalar(Scalar::Bool)
            } else {
                types[0]
            };
            expect(node.ty == ty, "wrong result type")?;
            let bits = matches!(
                op,
                BinaryOp::Shl | BinaryOp::Shr | BinaryOp::And | BinaryOp::Or | BinaryOp::Xor
            );
            expect(!(bits && types[0].is_float()), "a bit operation on floats")?;
            let floats = matches!(op, BinaryOp::Pow | BinaryOp::Atan2);
            expect(!floats || types[0].is_float(), "a power or an angle of integers")?;
            let logic = matches!(
                op,
                BinaryOp::And | BinaryOp::Or | BinaryOp::Xor | BinaryOp::Eq | BinaryOp::Ne
            );
            expect(
                logic || types[0].scalar_kind() != Some(Scalar::Bool),
                "arithmetic on booleans",
            )?;
            expect(value, "arithmetic on arrays")
        }
        Op::Dot => {
            count(2)?;
            expect(
                types[0] == types[1] && types[0].is_float() && node.ty == Type::F32,
                "two float vectors to a float",
            )
        }
        Op::Cross => {
            count(2)?;
            let vec3 = Type::value(Scalar::F32, 3);
            expect(
                types[0] == vec3 && types[1] == vec3 && node.ty == vec3,
                "three vec3<f32>",
            )
        }
        Op::Clamp => {
            count(3)?;
            expect(types.iter().all(|t| *t == node.ty), "all of one type")?;
            expect(value && node.ty.scalar_kind() != Some(Scalar::Bool), "numbers")
        }
        Op::Select => {
            count(3)?;
            expect(
                types[0] == Type::BOOL && types[1] == node.ty && types[2] == node.ty && !node.ty.is_array(),
                "a boolean and two alike that are no arrays",
            )
        }
        Op::Splat => {
            count(1)?;
            expect(
                types[0].is_scalar()
                    && types[0].scalar_kind() == node.ty.scalar_kind()
                    && value
                    && !node.ty.is_scalar(),
                "a scalar of the vector's kind",
            )
        }
        Op::Compose => {
            count(node.ty.component_count() as usize)?;
            expect(value && !node.ty.is_scalar(), "a vector")?;
            expect(
                types
                    .iter()
                    .all(|t| t.is_scalar() && t.scalar_kind() == node.ty.scalar_kind()),
                "a scalar for each lane",
            )
        }
        Op::Extract(lane) => {
            count(1)?;
            expect(
                *lane < types[0].component_count()
                    && !types[0].is_array()
                    && !types[0].is_scalar()
                    && node.ty.is_scalar()
                    && node.ty.scalar_kind() == types[0].scalar_kind(),
                "a lane of a vector",
            )
        }
        Op::Convert => {
            count(1)?;
            let alike = types[0].component_count() == node.ty.component_count() && !types[0].is_array() && value;
            expect(alike, "as many lanes as before")
        }
        Op::Bitcast => {
            count(1)?;
            let number = |t: Type| t.scalar_kind() != Some(Scalar::Bool);
            let alike = types[0].component_count() == node.ty.component_count() && number(types[0]) && number(node.ty);
            expect(alike && !types[0].is_array() && value, "numbers of as many lanes")
        }

        Op::MakeArray => {
            let Type::Array { len, .. } = node.ty else {
                return Err("not an array".to_owned());
            };
            count(len as usize)?;
            expect(
                types.iter().all(|t| *t == node.ty.element_type()),
                "elements of one type",
            )
        }
        Op::ArrayGet => {
            count(2)?;
            expect(
                types[0].is_array() && types[1] == Type::I32 && node.ty == types[0].element_type(),
                "an array and an index",
            )
        }
        Op::ArraySet => {
            count(3)?;
            let fits = types[0].is_array() && types[1] == Type::I32 && types[2] == types[0].element_type();
            expect(fits && node.ty == types[0], "an array, an index and an element")
        }
        Op::Loop(body) => {
            let body = find_region(graph, *body)?;
            expect(
                node.ty == Type::Results && !body.params.is_empty(),
                "results, of a region with a counter",
            )?;
            expect(
                types.len() >= 2 && types[0] == types[1] && matches!(types[0], Type::I32 | Type::U32),
                "bounds are two i32 or two u32",
            )?;
            let counter = body.params.first().map(|p| graph.ty(*p));
            expect(counter == Some(types[0]), "the counter has the type of the bounds")?;
            let params: Vec<Type> = body.params.iter().skip(1).map(|p| graph.ty(*p)).collect();
            let results: Vec<Type> = body.results.iter().map(|r| graph.ty(*r)).collect();
            expect(
                params == types[2..] && results == types[2..],
                "carried values, parameters and results agree",
            )?;
            let stops = body.stop.is_none_or(|stop| graph.ty(stop) == Type::BOOL);
            expect(stops, "a loop is stopped by a boolean")
        }
        Op::If(then, otherwise) => {
            count(1)?;
            let sides = [find_region(graph, *then)?, find_region(graph, *otherwise)?];
            let bare = sides.iter().all(|side| side.params.is_empty() && side.stop.is_none());
            expect(
                node.ty == Type::Results && bare,
                "results, of regions without parameters",
            )?;
            let [a, b] = sides.map(|r| r.results.iter().map(|id| graph.ty(*id)).collect::<Vec<_>>());
            expect(
                types[0] == Type::BOOL && a == b,
                "a boolean, and two sides with results alike",
            )
        }
        Op::Result(k) => {
            count(1)?;
            let first = *graph
                .regions_of(node.args[0])
                .first()
                .ok_or("not the result of a loop or branch")?;
            let result = graph.region(first).results.get(*k as usize).ok_or("no such result")?;
            expect(graph.ty(*result) == node.ty, "wrong type")
        }
        Op::TextureSize(_)
        | Op::TextureLevels(_)
        | Op::TextureLayers(_)
        | Op::Load { .. }
        | Op::Sample { .. }
        | Op::Gather { .. }
        | Op::Compare { .. }
        | Op::GatherCompare { .. }
        | Op::BufferLen(_)
        | Op::BufferLoad { .. }
        | Op::Atomic { .. }
        | Op::Store(_)
        | Op::SharedLoad(_)
        | Op::Barrier { .. } => resources::check_resource_op(graph, node, types),
    }
}

/// Returns whether an operation exists for a kind of numbers.
fn is_defined_for(op: UnaryOp, kind: Scalar) -> bool {
    use UnaryOp::*;
    match op {
        Not => kind == Scalar::Bool,
        BitNot | CountOneBits | ReverseBits | LeadingZeros | TrailingZeros => matches!(kind, Scalar::I32 | Scalar::U32),
        Neg | Sign => matches!(kind, Scalar::F32 | Scalar::I32),
        Abs => kind != Scalar::Bool,
        _ => kind == Scalar::F32,
    }
}

fn find_region(graph: &Graph, id: RegionId) -> Result<&super::Region, String> {
    graph
        .regions
        .get(id.0 as usize)
        .ok_or_else(|| "no such region".to_owned())
}

/// Checks rule 4: a node that depends on a parameter is used only where the parameter is in scope.
fn check_scopes(graph: &Graph) -> Result<(), String> {
    let inside = |mut at: RegionId, outer: RegionId| loop {
        if at == outer {
            return true;
        }
        match graph.region(at).parent {
            Some(parent) => at = parent,
            None => return false,
        }
    };
    let mut happens = HashMap::new();
    for (k, region) in graph.regions.iter().enumerate() {
        let effects = region.effects.iter().filter(|id| graph.node(**id).op.is_effect());
        happens.extend(effects.map(|id| (*id, RegionId(k as u32))));
    }
    let mut needs: Vec<RegionId> = Vec::with_capacity(graph.nodes.len());
    for id in graph.node_ids() {
        let node = graph.node(id);
        let mut need = match node.op {
            Op::Param(region, _) => region,
            _ => happens.get(&id).copied().unwrap_or(Graph::BODY),
        };
        for arg in &node.args {
            let other = needs[arg.0 as usize];
            if inside(other, need) {
                need = other;
            } else if !inside(need, other) {
                return Err(format!(
                    "%{}: uses parameters of two regions of which neither is in the other",
                    id.0
                ));
            }
        }
        for region in graph.regions_of(id) {
            let parent = graph.region(region).parent.unwrap_or(Graph::BODY);
            for result in graph.region(region).yielded_values() {
                if !inside(region, needs[result.0 as usize]) {
                    return Err(format!("%{}: a result depends on a region outside", id.0));
                }
            }
            if !inside(parent, need) {
                return Err(format!("%{}: depends on a region that it is not in", id.0));
            }
            need = parent;
        }
        needs.push(need);
    }
    if graph.outputs().iter().any(|id| needs[id.0 as usize] != Graph::BODY) {
        return Err("the output depends on a region's parameter".to_owned());
    }
    Ok(())
}

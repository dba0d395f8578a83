//! Every rule of the verifier is broken by one change of a graph that keeps all of them.

use straightline_evaluator::ir::{
    Access, AtomicOp, BinaryOp, Buffer, Builder, Element, Graph, Invocation, Memory, Node, NodeId, Op, OutputTarget,
    Override, QuadDirection, RegionId, Rules, Sampler, Scalar, SharedArray, Texture, TextureKind, Type, UnaryOp,
    Uniform, verify::verify_graph,
};

struct Nothing;

impl Rules for Nothing {
    fn simplify(&self, _: &mut Builder<'_>, _: &Op, _: &[NodeId], _: Type) -> Option<NodeId> {
        None
    }
}

const VEC2: Type = Type::value(Scalar::F32, 2);
const VEC4: Type = Type::value(Scalar::F32, 4);
const PAIR: Type = Type::value(Scalar::I32, 2);

/// A graph with a loop, a branch, an array and reads: the nodes are numbered as they are made.
fn whole() -> Graph {
    let mut b = Builder::new(&Nothing);
    let texture = |name: &str, kind, components| Texture {
        name: name.to_owned(),
        kind,
        scalar: Scalar::F32,
        components,
        declared: components,
        framed: true,
    };
    let sampler = |name: &str, comparison| Sampler {
        name: name.to_owned(),
        comparison,
        filters: !comparison,
    };
    let graph = b.graph_mut();
    graph.textures = vec![texture("a", TextureKind::Flat, 2), texture("d", TextureKind::Depth, 1)];
    graph.samplers = vec![sampler("s", false), sampler("c", true)];
    graph.buffers = vec![Buffer {
        name: "b".to_owned(),
        element: Element::Value(Type::F32),
        access: Access::Read,
    }];
    graph.uniforms = vec![Uniform {
        name: "u".to_owned(),
        ty: Type::F32,
        default: None,
        part: None,
    }];
    graph.tallies = vec!["t".to_owned()];
    let add = |b: &mut Builder<'_>, op: Op, args: &[u32], ty: Type| {
        b.intern(op, args.iter().map(|k| NodeId(*k)).collect::<Vec<_>>(), ty).0
    };
    let pixel = add(&mut b, Op::Pixel, &[], PAIR); // 0
    let texel = add(&mut b, Op::Load { texture: 0, site: 0 }, &[pixel], VEC2); // 1
    let x = add(&mut b, Op::Extract(0), &[texel], Type::F32); // 2
    let uniform = add(&mut b, Op::Uniform(0), &[], Type::F32); // 3
    let tally = add(&mut b, Op::Tally(0), &[x], Type::F32); // 4
    let less = add(&mut b, Op::Binary(BinaryOp::Lt), &[tally, uniform], Type::BOOL); // 5
    let zero = b.i32(0).0; // 6
    let four = b.i32(4).0; // 7
    let body = b.open_region(&[Type::I32, Type::F32]);
    let carried = b.graph().region(body).params[1].0; // 8, 9
    let next = add(&mut b, Op::Binary(BinaryOp::Add), &[carried, x], Type::F32); // 10
    b.close_region(vec![NodeId(next)]);
    let kept = add(&mut b, Op::Loop(body), &[zero, four, uniform], Type::Results); // 11
    let sum = add(&mut b, Op::Result(0), &[kept], Type::F32); // 12
    let then = b.open_region(&[]);
    b.close_region(vec![NodeId(sum)]);
    let otherwise = b.open_region(&[]);
    b.close_region(vec![NodeId(x)]);
    let branch = add(&mut b, Op::If(then, otherwise), &[less], Type::Results); // 13
    let chosen = add(&mut b, Op::Result(0), &[branch], Type::F32); // 14
    let array = Type::Array {
        scalar: Scalar::F32,
        components: 1,
        len: 2,
    };
    let table = add(&mut b, Op::MakeArray, &[chosen, sum], array); // 15
    let set = add(&mut b, Op::ArraySet, &[table, zero, x], array); // 16
    let element = add(&mut b, Op::ArrayGet, &[set, zero], Type::F32); // 17
    let gathered = add(
        &mut b,
        Op::Gather {
            texture: 0,
            sampler: 0,
            component: 1,
            site: 0,
        },
        &[texel],
        VEC4,
    ); // 18
    let compared = add(
        &mut b,
        Op::Compare {
            texture: 1,
            sampler: 1,
            site: 0,
        },
        &[texel, element],
        Type::F32,
    ); // 19
    let read = add(
        &mut b,
        Op::BufferLoad {
            buffer: 0,
            field: 0,
            site: 0,
        },
        &[zero],
        Type::F32,
    ); // 20
    let vector = add(&mut b, Op::Compose, &[compared, read, element, x], VEC4); // 21
    let clamped = add(&mut b, Op::Clamp, &[vector, gathered, vector], VEC4); // 22
    let whole = add(&mut b, Op::Convert, &[clamped], Type::value(Scalar::I32, 4)); // 23
    let bits = add(&mut b, Op::Bitcast, &[whole], VEC4); // 24
    let out = add(&mut b, Op::Unary(UnaryOp::Sqrt), &[bits], VEC4); // 25
    let _ = add(&mut b, Op::Select, &[less, x, uniform], Type::F32); // 26
    b.finish(vec![NodeId(out)])
}

fn node(graph: &mut Graph, k: usize) -> &mut Node {
    &mut graph.nodes[k]
}

fn an_override(ty: Type) -> Override {
    Override {
        name: "o".to_owned(),
        id: 0,
        ty,
        default: 1.0,
        range: None,
    }
}

#[test]
fn a_whole_graph_is_verified() {
    assert_eq!(verify_graph(&whole()), Ok(()));
}

#[test]
fn every_rule_is_checked() {
    type Break = fn(&mut Graph);
    let cases: &[(&str, Break)] = &[
        // 1: made before used.
        ("made after its user", |g| node(g, 2).args[0] = NodeId(20)),
        ("made after its user", |g| g.regions[1].results[0] = NodeId(25)),
        // 2: arguments and types.
        ("wrong number", |g| node(g, 25).args.clear()),
        ("wrong number", |g| node(g, 3).args.push(NodeId(2))),
        ("wrong number", |g| node(g, 21).args.truncate(3)),
        ("a coordinate", |g| node(g, 0).ty = Type::I32),
        ("of the uniform's type", |g| node(g, 3).ty = Type::I32),
        ("differ", |g| node(g, 4).ty = Type::I32),
        ("does not have", |g| node(g, 25).op = Op::Unary(UnaryOp::Not)),
        ("one type", |g| node(g, 10).args[0] = NodeId(6)),
        ("wrong result type", |g| node(g, 5).ty = Type::F32),
        ("a bit operation", |g| node(g, 10).op = Op::Binary(BinaryOp::And)),
        ("all of one type", |g| node(g, 22).ty = Type::value(Scalar::F32, 3)),
        ("a boolean and two", |g| node(g, 26).args[0] = NodeId(2)),
        ("a scalar for each", |g| node(g, 21).args[0] = NodeId(0)),
        ("a lane of a vector", |g| node(g, 2).op = Op::Extract(2)),
        ("a lane of a vector", |g| node(g, 2).args[0] = NodeId(0)),
        ("as many lanes", |g| node(g, 23).ty = PAIR),
        ("numbers of as many", |g| node(g, 24).ty = Type::value(Scalar::Bool, 4)),
        ("an array and an index", |g| node(g, 17).args[0] = NodeId(2)),
        ("an array, an index", |g| node(g, 16).args[1] = NodeId(2)),
        ("elements of one type", |g| node(g, 15).args[0] = NodeId(6)),
        ("a type that no value has", |g| {
            node(g, 24).ty = Type::value(Scalar::F32, 5)
        }),
        ("a type that no value has", |g| node(g, 12).ty = Type::Results),
        ("a boolean is 0 or 1", |g| {
            node(g, 6).ty = Type::BOOL;
            node(g, 6).op = Op::Const([2, 0, 0, 0]);
        }),
        ("a vec2<f32>", |g| node(g, 18).args[0] = NodeId(2)),
        ("a place and a reference", |g| node(g, 19).args[1] = NodeId(6)),
        ("a coordinate is a vec3<i32>", |g| {
            g.textures[0].kind = TextureKind::Volume
        }),
        ("a coordinate", |g| g.textures[0].kind = TextureKind::Cube),
        ("wrong number", |g| g.textures[0].kind = TextureKind::Layers),
        ("a texel of the texture's", |g| g.textures[0].scalar = Scalar::U32),
        ("a layer and a level", |g| node(g, 1).args.push(NodeId(0))),
        ("a number of layers", |g| node(g, 6).op = Op::TextureLayers(0)),
        ("a number of levels", |g| {
            node(g, 6).op = Op::TextureLevels(0);
            node(g, 6).ty = Type::U32;
        }),
        ("a texture of floats", |g| {
            node(g, 18).op = Op::Sample {
                texture: 1,
                sampler: 0,
                site: 0,
            };
        }),
        ("a component that", |g| {
            node(g, 18).op = Op::Gather {
                texture: 0,
                sampler: 0,
                component: 2,
                site: 0,
            };
        }),
        ("a flat texture", |g| {
            node(g, 18).op = Op::Gather {
                texture: 1,
                sampler: 0,
                component: 0,
                site: 0,
            }
        }),
        ("a depth texture", |g| {
            node(g, 19).op = Op::Compare {
                texture: 1,
                sampler: 0,
                site: 0,
            }
        }),
        ("an index to an element", |g| node(g, 20).args[0] = NodeId(2)),
        // 3: what exists.
        ("no such texture", |g| node(g, 1).op = Op::Load { texture: 9, site: 0 }),
        ("no such sampler", |g| {
            node(g, 18).op = Op::Gather {
                texture: 0,
                sampler: 9,
                component: 0,
                site: 0,
            }
        }),
        ("no such buffer", |g| {
            node(g, 20).op = Op::BufferLoad {
                buffer: 9,
                field: 0,
                site: 0,
            }
        }),
        ("no such uniform", |g| node(g, 3).op = Op::Uniform(9)),
        ("no such override", |g| node(g, 3).op = Op::Override(9)),
        ("of the override's type", |g| {
            g.overrides = vec![an_override(Type::I32)];
            node(g, 3).op = Op::Override(0);
        }),
        ("a number or boolean", |g| {
            g.overrides = vec![an_override(VEC2)];
            node(g, 3).op = Op::Override(0);
        }),
        ("no such varying", |g| node(g, 3).op = Op::Varying(0)),
        ("no such tally", |g| node(g, 4).op = Op::Tally(9)),
        ("no such region", |g| node(g, 11).op = Op::Loop(RegionId(9))),
        ("no such result", |g| node(g, 12).op = Op::Result(1)),
        ("not the result of", |g| node(g, 12).args[0] = NodeId(2)),
        ("belongs to 2", |g| node(g, 13).op = Op::If(RegionId(2), RegionId(2))),
        ("opened before", |g| g.regions[2].parent = Some(RegionId(3))),
        ("not its own", |g| g.regions[1].params[1] = NodeId(3)),
        ("carried values", |g| node(g, 11).args[2] = NodeId(6)),
        ("results alike", |g| g.regions[3].results[0] = NodeId(6)),
        // 4: parameters inside their regions.
        ("depends on a region", |g| node(g, 21).args[3] = NodeId(9)),
        // 5: results.
        ("results for each pixel", |g| g.regions[0].results.clear()),
        ("results for each pixel", |g| g.regions[0].results[0] = NodeId(2)),
        ("results for each pixel: vec4<f32>, i32", |g| {
            g.targets.push(OutputTarget {
                name: "k".to_owned(),
                ty: Type::I32,
                tile: None,
            })
        }),
        ("the target k is of no numbers", |g| {
            g.targets[0] = OutputTarget {
                name: "k".to_owned(),
                ty: Type::BOOL,
                tile: None,
            }
        }),
        ("the target destination is of no numbers, or there are two of it", |g| {
            g.targets.push(OutputTarget::default_color())
        }),
        // 6: lanes.
        ("no lane", |g| {
            node(g, 25).op = Op::QuadSwap(QuadDirection::Vertical);
            g.invocation = Invocation::Pixel;
        }),
    ];
    let mut wrong = Vec::new();
    for (k, (expected, change)) in cases.iter().enumerate() {
        let mut graph = whole();
        change(&mut graph);
        let said = std::panic::catch_unwind(|| verify_graph(&graph));
        match said {
            Ok(Err(why)) if why.contains(expected) => {}
            other => wrong.push(format!("case {k}, `{expected}`: {other:?}")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A branch in which a buffer of atomics is added to: nodes 0 to 5, the effect in region 1 of the branch, node 5.
fn writing() -> Graph {
    let mut b = Builder::new(&Nothing);
    b.graph_mut().targets.clear();
    b.graph_mut().buffers = vec![Buffer {
        name: "bins".to_owned(),
        element: Element::Value(Type::U32),
        access: Access::Atomic,
    }];
    let holds = b.intern(Op::Const([1, 0, 0, 0]), Vec::new(), Type::BOOL);
    let (index, value) = (b.i32(3), b.constant(Type::U32, [1, 0, 0, 0]));
    let first = b.open_region(&[]);
    let op = AtomicOp::Add;
    let memory = Memory::Buffer(0);
    b.add_effect(Op::Atomic { memory, op }, vec![holds, index, value], Type::U32);
    b.close_region(Vec::new());
    let second = b.open_region(&[]);
    b.close_region(Vec::new());
    b.intern(Op::If(first, second), [holds], Type::Results);
    b.finish(Vec::new())
}

#[test]
fn rules_of_effects_are_checked() {
    verify_graph(&writing()).unwrap_or_else(|why| panic!("{why}"));
    type Change = fn(&mut Graph);
    let cases: [(&str, Change); 9] = [
        ("no effect of the region", |g| g.regions[1].effects.clear()),
        ("an effect of two regions", |g| {
            g.regions[2].effects = g.regions[1].effects.clone()
        }),
        ("out of order", |g| g.regions[1].effects.push(NodeId(0))),
        ("several pixels", |g| g.invocation = Invocation::Lane),
        ("a condition, an index and an element", |g| {
            node(g, 3).args[0] = NodeId(1)
        }),
        ("wrong number of arguments", |g| {
            node(g, 3).op = Op::Atomic {
                memory: Memory::Buffer(0),
                op: AtomicOp::Load,
            }
        }),
        ("an integer of memory of atomics", |g| {
            g.buffers[0].access = Access::Write
        }),
        ("no such memory", |g| {
            node(g, 3).op = Op::Store(Memory::Shared(0));
            node(g, 3).ty = Type::Results;
        }),
        ("memory that is written", |g| {
            node(g, 3).op = Op::Store(Memory::Buffer(0));
            node(g, 3).ty = Type::Results;
        }),
    ];
    for (expected, change) in cases {
        let mut graph = writing();
        change(&mut graph);
        let said = match verify_graph(&graph) {
            Err(said) => said,
            Ok(()) => panic!("`{expected}` is not refused"),
        };
        assert!(said.contains(expected), "`{expected}`: {said}");
    }
}

/// A pass keeps every effect, in order, and drops what never happens.
#[test]
fn passes_keep_effects() {
    let mut graph = writing();
    graph.regions[0].effects.clear();
    let passes = straightline_evaluator::passes::clean_graph;
    assert_eq!(passes(&graph).nodes.len(), 0, "what happens nowhere is dropped");
    let kept = passes(&writing());
    assert_eq!(kept.nodes.iter().filter(|n| n.op.is_effect()).count(), 1);
    verify_graph(&kept).unwrap_or_else(|why| panic!("{why}"));
    let mut never = writing();
    node(&mut never, 0).op = Op::Const([0; 4]);
    assert!(!passes(&passes(&never)).has_effects());
}

/// Two threads that change what they share: nodes 0 to 5.
fn sharing() -> Graph {
    let mut b = Builder::new(&Nothing);
    b.graph_mut().targets.clear();
    b.graph_mut().invocation = Invocation::Group([2, 1]);
    b.graph_mut().shared = vec![SharedArray {
        name: "sums".to_owned(),
        element: Type::F32,
        len: 2,
        atomic: false,
        filled: false,
    }];
    let (holds, index, value) = (b.bool(true), b.i32(1), b.f32(0.5));
    let memory = Memory::Shared(0);
    b.add_effect(Op::Store(memory), vec![holds, index, value], Type::Results);
    b.add_effect(Op::Barrier { buffers: false }, Vec::new(), Type::Results);
    b.add_effect(Op::SharedLoad(0), vec![holds, index], Type::F32);
    b.finish(Vec::new())
}

#[test]
fn rules_of_workgroups_are_checked() {
    verify_graph(&sharing()).unwrap_or_else(|why| panic!("{why}"));
    type Change = fn(&mut Graph);
    let cases: [(&str, Change); 7] = [
        ("no such memory", |g| g.invocation = Invocation::Pixel),
        ("no array of numbers", |g| g.shared[0].len = 0),
        ("no array of numbers", |g| g.shared[0].atomic = true),
        ("no array of numbers", |g| g.shared[0].element = Type::BOOL),
        ("a condition, an index and an element", |g| {
            g.shared[0].element = Type::I32
        }),
        ("invocations of a workgroup", |g| node(g, 4).ty = Type::F32),
        ("a condition and an index", |g| node(g, 5).args[0] = NodeId(1)),
    ];
    for (expected, change) in cases {
        let mut graph = sharing();
        change(&mut graph);
        let said = match verify_graph(&graph) {
            Err(said) => said,
            Ok(()) => panic!("`{expected}` is not refused"),
        };
        assert!(said.contains(expected), "`{expected}`: {said}");
    }
    // A read of workgroup memory whose value is unused is removed.
    let clean = straightline_evaluator::passes::clean_graph(&sharing());
    assert!(!clean.nodes.iter().any(|n| n.op == Op::SharedLoad(0)));
    assert!(clean.nodes.iter().any(|n| n.op == Op::Barrier { buffers: false }));
}

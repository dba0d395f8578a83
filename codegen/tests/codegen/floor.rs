//! The floor of a kernel: its reads, without its arithmetic.

use std::collections::HashSet;
use straightline_codegen::ir::{BinaryOp, Graph, NodeId, Op, Scalar, Type};
use straightline_codegen::{Kernel, Settings};

fn of(text: &str) -> (Graph, Graph) {
    let settings = Settings::default();
    let compiled = Kernel::from_text("k.rs", text, "k")
        .compile(&settings)
        .unwrap_or_else(|e| panic!("{e}"));
    let floor = compiled.floor().unwrap_or_else(|e| panic!("{e}"));
    (compiled.graph, floor.graph)
}

fn reads(graph: &Graph) -> Vec<Op> {
    graph
        .nodes
        .iter()
        .filter(|n| n.op.is_read())
        .map(|n| n.op.clone())
        .collect()
}

/// Returns the nodes that these values depend on, including the values.
fn needed(graph: &Graph, values: &[NodeId]) -> HashSet<NodeId> {
    let mut found = HashSet::new();
    let mut left = values.to_vec();
    while let Some(id) = left.pop() {
        if found.insert(id) {
            left.extend(&graph.node(id).args);
        }
    }
    found
}

#[test]
fn arithmetic_goes_and_reads_stay() {
    let (full, floor) = of(
        "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let mut sum = Vec4::ZERO;\n    for x in -2..=2 {\n        sum += color.load(pixel + ivec2(x, 0)).exp() * x as f32;\n    }\n    sum + color.load(pixel).sqrt()\n}\n",
    );
    assert_eq!(reads(&full).len(), 5);
    assert_eq!(reads(&floor), reads(&full));
    let is_dear = |op: &Op| matches!(op, Op::Unary(op) if op.is_transcendental());
    assert!(full.nodes.iter().any(|n| is_dear(&n.op)) && !floor.nodes.iter().any(|n| is_dear(&n.op)));
    let colour = Type::value(Scalar::F32, 4);
    let adds = floor
        .nodes
        .iter()
        .filter(|n| n.op == Op::Binary(BinaryOp::Add) && n.ty == colour);
    assert_eq!(adds.count(), 4);
}

#[test]
fn reads_that_wait_for_others_still_wait() {
    let (full, floor) = of(
        "pub fn k(color: &Frame<Vec4>, far: &Texture<Vec2>, table: &Buffer<u32>, pixel: IVec2) -> Vec4 {\n    let here = color.load(pixel);\n    let there = far.load(here.truncate().truncate().as_ivec2());\n    let on = far.load(there.as_ivec2());\n    let entry = table.load(on.x as usize) as f32;\n    here * there.x + on.y * entry\n}\n",
    );
    assert_eq!(reads(&full).len(), 4);
    assert_eq!(reads(&floor).len(), 4);
    // Each of the three depends on the one before.
    for (id, node) in floor.node_ids().zip(&floor.nodes) {
        if node.op.is_read() {
            let needed = needed(&floor, &node.args);
            let awaited = floor.node_ids().filter(|k| *k != id && needed.contains(k));
            let awaited = awaited.filter(|k| floor.node(*k).op.is_read()).count();
            let place = floor.node_ids().take_while(|k| *k != id);
            assert_eq!(awaited, place.filter(|k| floor.node(*k).op.is_read()).count());
        }
    }
}

#[test]
fn what_keeps_a_loop_has_no_floor() {
    let text = "pub fn k(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {\n    let mut sum = Vec4::ZERO;\n    for x in 0..taps {\n        sum += color.load(pixel + ivec2(x, 0));\n    }\n    sum\n}\n";
    let compiled = Kernel::from_text("k.rs", text, "k").compile(&Settings::default());
    let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
    let why = compiled.floor().expect_err("a loop is left").to_string();
    assert!(why.contains("a loop or branch is left"), "{why}");
}

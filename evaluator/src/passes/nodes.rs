//! Nodes that passes add.

use crate::ir::{BinaryOp, Builder, Naming, NodeId, Op, Origin, Type};

/// An operation on two values of one type, with a result of that type.
pub fn add(b: &mut Builder<'_>, op: BinaryOp, x: NodeId, y: NodeId) -> NodeId {
    let ty = b.graph().ty(x);
    b.add(Op::Binary(op), [x, y], ty)
}

/// Names a value that has no place in the source.
pub fn name_node(b: &mut Builder<'_>, id: NodeId, name: &str) {
    let fixed = matches!(
        b.graph().node(id).op,
        Op::Const(_) | Op::GroupOrigin | Op::Thread | Op::Pixel
    );
    if fixed || b.graph().origin(id).is_some() {
        return;
    }
    let origin = Origin {
        name: name.into(),
        naming: Naming::Let,
        file: 0,
        line: Origin::NOWHERE,
        counters: [].into(),
    };
    b.set_origin(id, &origin);
}

/// Lets the threads of a workgroup do `each` for every one of `texels`, by number: one after another, `index` being the thread's
/// first. `None` once `each` gives up.
pub fn take_turns(
    b: &mut Builder<'_>,
    index: NodeId,
    (threads, texels): (u32, u32),
    each: &mut dyn FnMut(&mut Builder<'_>, NodeId) -> Option<()>,
) -> Option<()> {
    for turn in 0..texels.div_ceil(threads) {
        let mut texel = index;
        if turn > 0 {
            let behind = b.i32((turn * threads) as i32);
            texel = add(b, BinaryOp::Add, index, behind);
            name_node(b, texel, "index");
        }
        if (turn + 1) * threads <= texels {
            each(b, texel)?;
            continue;
        }
        let end = b.i32(texels as i32);
        let is_one = b.add(Op::Binary(BinaryOp::Lt), [texel, end], Type::BOOL);
        let then = b.open_region(&[]);
        each(b, texel)?;
        b.close_region(Vec::new());
        let otherwise = b.open_region(&[]);
        b.close_region(Vec::new());
        b.intern(Op::If(then, otherwise), [is_one], Type::Results);
    }
    Some(())
}

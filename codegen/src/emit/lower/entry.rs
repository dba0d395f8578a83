//! The entry point around a kernel's statements: which pixel it is, where it may write, what it stores.

use crate::emit::ast::{Block, Builtin, Expr, Module, Op, Stmt, StmtKind, VarId, Variable};
use crate::emit::resources::Resources;
use crate::ir::{self, BinaryOp, Scalar, Type, UnaryOp};
use straightline_manifest::Stage;

const IVEC2: Type = Type::value(Scalar::I32, 2);

/// A module with the variables that entry points declare.
pub fn module<'g>() -> Module<'g> {
    let variables = ["pixel", "frame", "within", "place"].map(|name| Variable {
        name: name.to_owned(),
        ty: IVEC2.into(),
    });
    Module {
        variables: variables.into(),
        ..Module::default()
    }
}

/// Puts the statements of an entry point around those of the kernel, the last of which are its outputs.
pub fn entry(module: &mut Module<'_>, resources: &Resources) {
    let compute = resources.options.stage == Stage::Compute;
    let mut body = match compute {
        true => begin_compute(resources),
        false => begin_fragment(resources),
    };
    let (outputs, mut kernel): (Vec<_>, Vec<_>) = std::mem::take(&mut module.body)
        .into_iter()
        .partition(|stmt| matches!(stmt.kind, StmtKind::Output(_)));
    body.append(&mut kernel);
    match compute {
        true => stores(&mut body, outputs, resources),
        false => body.extend(outputs),
    }
    module.body = body;
}

fn builtin(builtin: Builtin) -> Expr {
    let scalar = if builtin == Builtin::Position {
        Scalar::F32
    } else {
        Scalar::I32
    };
    Expr::new(Op::Builtin(builtin), Vec::new(), Type::value(scalar, 2))
}

fn local(var: VarId) -> Expr {
    Expr::var(var, IVEC2)
}

fn is(var: VarId, value: Expr) -> Stmt<'static> {
    StmtKind::Let(var, value).into()
}

fn begin_compute(resources: &Resources) -> Block<'static> {
    let mut invocation = builtin(Builtin::Invocation);
    if resources.block != [1, 1] {
        let [width, height] = resources.block.map(|side| side as i32);
        invocation = invocation.binary(BinaryOp::Mul, Expr::ivec2(width, height));
    }
    let outside = |place: VarId, size: Expr| {
        let outside = local(place).binary(BinaryOp::Ge, size);
        StmtKind::If {
            condition: Expr::new(Op::Any, vec![outside], Type::BOOL),
            then: vec![StmtKind::Return(None).into()],
            otherwise: Vec::new(),
        }
        .into()
    };
    if resources.options.region {
        vec![
            is(VarId::WITHIN, invocation),
            outside(VarId::WITHIN, builtin(Builtin::RegionSize)),
            is(VarId::FRAME, frame(resources)),
            is(
                VarId::PIXEL,
                builtin(Builtin::RegionFirst).binary(BinaryOp::Add, local(VarId::WITHIN)),
            ),
            is(
                VarId::PLACE,
                builtin(Builtin::RegionPlace).binary(BinaryOp::Add, local(VarId::WITHIN)),
            ),
        ]
    } else {
        vec![
            is(VarId::FRAME, builtin(Builtin::OutputSize)),
            is(VarId::PIXEL, invocation),
            outside(VarId::PIXEL, local(VarId::FRAME)),
        ]
    }
}

/// The frame's size: that of a texture which has it, or else of the output.
fn frame(resources: &Resources) -> Expr {
    match resources.framed() {
        Some(texture) => Expr::new(Op::Ir(ir::Op::TextureSize(texture)), Vec::new(), IVEC2),
        None => builtin(Builtin::OutputSize),
    }
}

fn begin_fragment(resources: &Resources) -> Block<'static> {
    let position = builtin(Builtin::Position);
    let ty = position.ty;
    let floor = Expr::new(Op::Ir(ir::Op::Unary(UnaryOp::Floor)), vec![position], ty);
    let mut pixel = floor.to(IVEC2);
    if resources.options.region {
        pixel = pixel.binary(BinaryOp::Sub, builtin(Builtin::RegionPlace));
        pixel = pixel.binary(BinaryOp::Add, builtin(Builtin::RegionFirst));
    }
    let mut body = vec![is(VarId::PIXEL, pixel)];
    if resources.needs_frame {
        body.push(is(VarId::FRAME, frame(resources)));
    }
    body
}

/// Stores the colours of a block's pixels; all but the first may lie outside.
fn stores(body: &mut Block<'_>, outputs: Block<'_>, resources: &Resources) {
    let (within, place, bound) = match resources.options.region {
        true => (VarId::WITHIN, VarId::PLACE, builtin(Builtin::RegionSize)),
        false => (VarId::PIXEL, VarId::PIXEL, local(VarId::FRAME)),
    };
    let width = resources.block[0] as usize;
    let colours = outputs.into_iter().filter_map(|stmt| match stmt.kind {
        StmtKind::Output(colour) => Some(colour),
        _ => None,
    });
    for (k, colour) in colours.enumerate() {
        if k == 0 {
            body.push(StmtKind::Store(local(place), colour).into());
            continue;
        }
        let offset = Expr::ivec2((k % width) as i32, (k / width) as i32);
        let inside = local(within)
            .binary(BinaryOp::Add, offset.clone())
            .binary(BinaryOp::Lt, bound.clone());
        let there = local(place).binary(BinaryOp::Add, offset);
        body.push(
            StmtKind::If {
                condition: Expr::new(Op::All, vec![inside], Type::BOOL),
                then: vec![StmtKind::Store(there, colour).into()],
                otherwise: Vec::new(),
            }
            .into(),
        );
    }
}

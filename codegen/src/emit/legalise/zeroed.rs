//! Zero-initialisation of workgroup memory. WGSL initialises it to 0; in GLSL and HLSL it is undefined, so their shaders
//! write the zeros.

use crate::emit::ast::{Block, Builtin, Effect, Expr, Module, Op, Stmt, StmtKind};
use crate::emit::resources::Resources;
use straightline_evaluator::ir::{BinaryOp, Memory, SharedArray, Type};

/// Emits writes of zeros before the kernel's first statement.
pub fn zero_workgroup_memory(module: &mut Module<'_>, resources: &Resources) {
    let Some([width, height]) = resources.group else { return };
    if !resources.is_zeroed() {
        return;
    }
    let threads = width * height;
    let index = module.new_variable("index", Type::I32);
    let position = Expr::new(Op::Builtin(Builtin::LocalIndex), Vec::new(), Type::I32);
    let comment = "What the workgroup shares is 0 at first.".to_owned();
    let mut stmts: Block<'_> = vec![StmtKind::Comment(comment).into(), StmtKind::Let(index, position).into()];
    for (k, shared) in resources.used_shared.iter().zip(resources.shared_memory()) {
        if shared.filled {
            continue;
        }
        // Threads take turns: each writes every n-th element, for n threads.
        let turns = shared.len.div_ceil(threads);
        let at = Expr::var(index, Type::I32);
        match turns {
            1 => stmts.push(guarded_zero_write(*k, shared, at, threads)),
            _ => {
                let turn = module.new_variable("turn", Type::I32);
                let step = Expr::splat(Type::I32, threads);
                let at = Expr::var(turn, Type::I32)
                    .binary(BinaryOp::Mul, step)
                    .binary(BinaryOp::Add, at);
                let element = module.new_variable("element", Type::I32);
                let mut body: Block<'_> = vec![StmtKind::Let(element, at).into()];
                body.push(guarded_zero_write(
                    *k,
                    shared,
                    Expr::var(element, Type::I32),
                    turns * threads,
                ));
                stmts.push(
                    StmtKind::For {
                        counter: turn,
                        start: Expr::splat(Type::I32, 0),
                        end: Expr::splat(Type::I32, turns),
                        body,
                    }
                    .into(),
                );
            }
        }
    }
    stmts.push(StmtKind::Barrier { buffers: false }.into());
    module.body.splice(0..0, stmts);
}

/// Writes an element if it exists, among the `reached` indices.
fn guarded_zero_write<'g>(k: u32, shared: &SharedArray, at: Expr, reached: u32) -> Stmt<'g> {
    let zero = Expr::splat(shared.element, 0);
    let write: Stmt<'g> = StmtKind::Effect(Effect {
        memory: Memory::Shared(k),
        op: None,
        args: vec![at.clone(), zero],
        before: None,
    })
    .into();
    if shared.len >= reached {
        return write;
    }
    let condition = at.binary(BinaryOp::Lt, Expr::splat(Type::I32, shared.len));
    StmtKind::If {
        condition,
        then: vec![write],
        otherwise: Vec::new(),
    }
    .into()
}

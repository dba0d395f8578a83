//! Prologue and epilogue of the entry point: the invocation's pixel, the bounds check, and the stores.

use crate::emit::ast::{Block, Builtin, Expr, Module, Op, Stmt, StmtKind, VarId, Variable};
use crate::emit::outputs::whole_texel;
use crate::emit::resources::Resources;
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type, UnaryOp};
use straightline_manifest::Stage;

const IVEC2: Type = Type::value(Scalar::I32, 2);

/// Purpose of the first statements of a shader whose workgroups share texels.
const TILES: &str = "Texels of the workgroup's pixels and of those around: each thread reads some of them.";

/// Purpose of the first statements of a shader whose workgroups compute several pictures.
const PICTURES: &str = "Each thread computes texels of a picture, which the others read for the next one.";

/// Creates a module with the entry point's variables.
pub fn entry_module<'g>() -> Module<'g> {
    let pairs = ["pixel", "frame", "within", "place", "origin"].map(|name| (name, IVEC2));
    let variables = pairs.into_iter().chain([("inside", Type::BOOL), ("local", IVEC2)]);
    let variables = variables.map(|(name, ty)| Variable {
        name: name.to_owned(),
        ty: ty.into(),
        precise: false,
    });
    Module {
        variables: variables.collect(),
        ..Module::default()
    }
}

/// Puts the entry point's statements around those of the kernel, which end with its outputs.
pub fn wrap_entry_point(module: &mut Module<'_>, resources: &Resources) {
    let compute = resources.options.stage == Stage::Compute;
    let mut body = match compute {
        true => begin_compute(resources),
        false => begin_fragment(resources),
    };
    let (mut outputs, mut kernel): (Vec<_>, Vec<_>) = std::mem::take(&mut module.body)
        .into_iter()
        .partition(|stmt| matches!(stmt.kind, StmtKind::Output(_)));
    let begun = body.len();
    if resources.shared_memory().any(|shared| shared.filled) {
        let has_pictures = resources.outputs.iter().any(|output| output.tile.is_some());
        let purpose = if has_pictures { PICTURES } else { TILES };
        body.push(StmtKind::Comment(purpose.to_owned()).into());
    }
    if resources.options.counts_from_below() {
        stored_from_below(&mut kernel);
    }
    body.append(&mut kernel);
    if !resources.options.is_function() {
        for value in outputs.iter_mut().flat_map(Stmt::own_mut) {
            *value = whole_texel(value.clone());
        }
    }
    match compute {
        true => store_outputs(&mut body, outputs, resources),
        false => body.extend(outputs),
    }
    if resources.group.is_some() {
        // A workgroup's entry point declares every variable that a kernel may use; unused ones are removed, last to first.
        for k in (0..begun).rev() {
            if let StmtKind::Let(var, _) = body[k].kind
                && !body[k + 1..].iter().any(|stmt| stmt.mentions(var))
            {
                body.remove(k);
            }
        }
    }
    module.body = body;
}

fn builtin_expr(builtin: Builtin) -> Expr {
    let scalar = if builtin == Builtin::Position {
        Scalar::F32
    } else {
        Scalar::I32
    };
    Expr::new(Op::Builtin(builtin), Vec::new(), Type::value(scalar, 2))
}

fn local_variable(var: VarId) -> Expr {
    Expr::var(var, IVEC2)
}

fn let_statement(var: VarId, value: Expr) -> Stmt<'static> {
    StmtKind::Let(var, value).into()
}

/// Returns a component of a pair.
fn pair_component(pair: Expr, component: u8) -> Expr {
    Expr::new(Op::Swizzle(vec![component]), vec![pair], Type::I32)
}

fn make_pair(x: Expr, y: Expr) -> Expr {
    Expr::new(Op::Construct, vec![x, y], IVEC2)
}

/// Returns `height - 1 - row`: the row counted from the other end.
fn flip_row(height: Expr, row: Expr) -> Expr {
    let one = Expr::splat(Type::I32, 1);
    height.binary(BinaryOp::Sub, one).binary(BinaryOp::Sub, row)
}

fn begin_compute(resources: &Resources) -> Block<'static> {
    let mut invocation = builtin_expr(Builtin::Invocation);
    if resources.block != [1, 1] {
        let [width, height] = resources.block.map(|side| side as i32);
        invocation = invocation.binary(BinaryOp::Mul, Expr::ivec2(width, height));
    }
    let size = match resources.outputs.is_empty() {
        true => frame_size(resources),
        false => builtin_expr(Builtin::OutputSize),
    };
    // Invocations outside return early, except in a workgroup, all of whose invocations must reach the barriers.
    let outside = |place: VarId, size: Expr| -> Stmt<'static> {
        if resources.group.is_some() {
            let inside = Expr::new(
                Op::All,
                vec![local_variable(place).binary(BinaryOp::Lt, size)],
                Type::BOOL,
            );
            return let_statement(VarId::INSIDE, inside);
        }
        let outside = local_variable(place).binary(BinaryOp::Ge, size);
        StmtKind::If {
            condition: Expr::new(Op::Any, vec![outside], Type::BOOL),
            then: vec![StmtKind::Return(None).into()],
            otherwise: Vec::new(),
        }
        .into()
    };
    // For a workgroup: the pixel of its first invocation, and the position of this one in it.
    let of_group = |pixel: &dyn Fn(Expr) -> Expr| -> Block<'static> {
        let Some(size) = resources.group else { return Vec::new() };
        let [width, height] = size.map(|side| side as i32);
        let first = builtin_expr(Builtin::Group).binary(BinaryOp::Mul, Expr::ivec2(width, height));
        vec![
            let_statement(VarId::ORIGIN, pixel(first)),
            let_statement(VarId::LOCAL, builtin_expr(Builtin::Local)),
        ]
    };
    match (resources.options.region, resources.options.counts_from_below()) {
        (false, from_below) => {
            let mut body = vec![
                let_statement(VarId::FRAME, size),
                let_statement(VarId::PIXEL, invocation),
                outside(VarId::PIXEL, local_variable(VarId::FRAME)),
            ];
            body.extend(of_group(&|first| first));
            if from_below && !resources.outputs.is_empty() {
                let row = flip_row(
                    pair_component(local_variable(VarId::FRAME), 1),
                    pair_component(local_variable(VarId::PIXEL), 1),
                );
                body.push(let_statement(
                    VarId::PLACE,
                    make_pair(pair_component(local_variable(VarId::PIXEL), 0), row),
                ));
            }
            body
        }
        (true, from_below) => {
            let height = || pair_component(builtin_expr(Builtin::RegionSize), 1);
            let corner = |of: Builtin, k: u8| pair_component(builtin_expr(of), k);
            // The pixel at a position within the region.
            let pixel = |within: Expr| match from_below {
                false => builtin_expr(Builtin::RegionFirst).binary(BinaryOp::Add, within),
                true => {
                    // `within` counts from the region's upper row, which is the last of the host's rows.
                    let [column, row] = [0, 1].map(|k| pair_component(within.clone(), k));
                    let above = pair_component(local_variable(VarId::FRAME), 1)
                        .binary(BinaryOp::Sub, corner(Builtin::RegionFirst, 1))
                        .binary(BinaryOp::Sub, height());
                    make_pair(
                        corner(Builtin::RegionFirst, 0).binary(BinaryOp::Add, column),
                        above.binary(BinaryOp::Add, row),
                    )
                }
            };
            let mut place = builtin_expr(Builtin::RegionPlace).binary(BinaryOp::Add, local_variable(VarId::WITHIN));
            if from_below {
                let [column, row] = [0, 1].map(|k| pair_component(local_variable(VarId::WITHIN), k));
                place = make_pair(
                    corner(Builtin::RegionPlace, 0).binary(BinaryOp::Add, column),
                    corner(Builtin::RegionPlace, 1).binary(BinaryOp::Add, flip_row(height(), row)),
                );
            }
            let mut body = vec![
                let_statement(VarId::WITHIN, invocation),
                outside(VarId::WITHIN, builtin_expr(Builtin::RegionSize)),
            ];
            // Without a texture, an output or a uniform of the frame's size, that size is unused.
            let has_size = resources.frame_texture().is_some() || resources.size_uniform.is_some();
            if has_size || !resources.outputs.is_empty() {
                body.push(let_statement(VarId::FRAME, frame_size(resources)));
            }
            body.push(let_statement(VarId::PIXEL, pixel(local_variable(VarId::WITHIN))));
            body.extend(of_group(&pixel));
            if !resources.outputs.is_empty() {
                body.push(let_statement(VarId::PLACE, place));
            }
            body
        }
    }
}

/// Returns the frame's size: that of a texture with that size, or else of the output, or else the host's value.
fn frame_size(resources: &Resources) -> Expr {
    match (resources.frame_texture(), resources.size_uniform) {
        (Some(texture), _) => Expr::new(Op::Ir(ir::Op::TextureSize(texture)), Vec::new(), IVEC2),
        (None, Some(uniform)) => {
            let size = Expr::new(
                Op::Ir(ir::Op::Uniform(uniform)),
                Vec::new(),
                Type::value(Scalar::U32, 2),
            );
            size.convert_to(IVEC2)
        }
        (None, None) => builtin_expr(Builtin::OutputSize),
    }
}

fn begin_fragment(resources: &Resources) -> Block<'static> {
    let position = builtin_expr(Builtin::Position);
    let ty = position.ty;
    let floor = Expr::new(Op::Ir(ir::Op::Unary(UnaryOp::Floor)), vec![position], ty);
    let mut pixel = floor.convert_to(IVEC2);
    if resources.options.region {
        pixel = pixel.binary(BinaryOp::Sub, builtin_expr(Builtin::RegionPlace));
        pixel = pixel.binary(BinaryOp::Add, builtin_expr(Builtin::RegionFirst));
    }
    let mut body = Vec::new();
    if resources.options.counts_from_below() {
        // Rows of the fragment and of the inputs count from below, those of the kernel from above.
        body.push(let_statement(VarId::FRAME, frame_size(resources)));
        body.push(let_statement(VarId::PLACE, pixel));
        let row = flip_row(
            pair_component(local_variable(VarId::FRAME), 1),
            pair_component(local_variable(VarId::PLACE), 1),
        );
        body.push(let_statement(
            VarId::PIXEL,
            make_pair(pair_component(local_variable(VarId::PLACE), 0), row),
        ));
        return body;
    }
    body.push(let_statement(VarId::PIXEL, pixel));
    if resources.needs_frame {
        body.push(let_statement(VarId::FRAME, frame_size(resources)));
    }
    body
}

/// Flips the rows of a kernel's stores at arbitrary places, if rows count from below.
fn stored_from_below(block: &mut Block<'_>) {
    for stmt in block {
        if let StmtKind::Store(_, place, _) = &mut stmt.kind {
            let row = flip_row(
                pair_component(local_variable(VarId::FRAME), 1),
                pair_component(place.clone(), 1),
            );
            *place = make_pair(pair_component(place.clone(), 0), row);
        }
        stmt.blocks_mut().into_iter().for_each(stored_from_below);
    }
}

/// Stores the outputs of a block's pixels; all but the first may lie outside.
fn store_outputs<'g>(body: &mut Block<'g>, outputs: Block<'g>, resources: &Resources) {
    let (within, bound) = match resources.options.region {
        true => (VarId::WITHIN, builtin_expr(Builtin::RegionSize)),
        false => (VarId::PIXEL, local_variable(VarId::FRAME)),
    };
    let place = match resources.options.has_place() {
        true => VarId::PLACE,
        false => VarId::PIXEL,
    };
    let down = if resources.options.counts_from_below() { -1 } else { 1 };
    let width = resources.block[0] as usize;
    let pixels = outputs.into_iter().filter_map(|stmt| match stmt.kind {
        StmtKind::Output(values) => Some((values, stmt.source)),
        _ => None,
    });
    for (k, (values, source)) in pixels.enumerate() {
        let stored = |there: &Expr| -> Block<'g> {
            let stores = values.iter().enumerate();
            stores
                .map(|(output, value)| Stmt {
                    kind: StmtKind::Store(output, there.clone(), value.clone()),
                    source,
                })
                .collect()
        };
        if resources.group.is_some() {
            let stored = stored(&local_variable(place));
            body.push(
                StmtKind::If {
                    condition: Expr::var(VarId::INSIDE, Type::BOOL),
                    then: stored,
                    otherwise: Vec::new(),
                }
                .into(),
            );
            continue;
        }
        if k == 0 {
            body.extend(stored(&local_variable(place)));
            continue;
        }
        let (x, y) = ((k % width) as i32, (k / width) as i32);
        let inside = local_variable(within)
            .binary(BinaryOp::Add, Expr::ivec2(x, y))
            .binary(BinaryOp::Lt, bound.clone());
        let there = local_variable(place).binary(BinaryOp::Add, Expr::ivec2(x, down * y));
        body.push(
            StmtKind::If {
                condition: Expr::new(Op::All, vec![inside], Type::BOOL),
                then: stored(&there),
                otherwise: Vec::new(),
            }
            .into(),
        );
    }
}

//! Proof that every loop of a shader ends, from its text alone.
//!
//! wgpu puts a bound on the iterations of every loop, because a compiler may take one that never ends for unreachable
//! code and draw conclusions. Where it is shown here that all loops end, that bound can go.

use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, LocalVariable, Module,
    Scalar, Statement, TypeInner,
};

/// Checks that each loop of `module` counts up by one, from an `i32` that nothing else in it writes, to a limit that
/// does not change in it. Such a loop ends: the counter meets every limit that an `i32` can hold before it could wrap.
/// Emitted shaders have such loops, but for a `while` whose trip count is a runtime value, which is refused here.
///
/// # Errors
///
/// The first loop of another form, and how it differs.
pub fn check_loops(module: &Module) -> Result<(), String> {
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    for function in entries.chain(module.functions.iter().map(|(_, function)| function)) {
        check_block(module, function, &function.body)?;
    }
    Ok(())
}

fn check_block(module: &Module, function: &Function, block: &Block) -> Result<(), String> {
    for statement in block {
        if let Statement::Loop {
            body,
            continuing,
            break_if,
        } = statement
        {
            if break_if.is_some() {
                return Err("a `loop` with `break if`".to_owned());
            }
            check_counter(module, function, body, continuing)?;
        }
        for inner in blocks_of(statement) {
            check_block(module, function, inner)?;
        }
    }
    Ok(())
}

fn blocks_of(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        Statement::Loop { body, continuing, .. } => vec![body, continuing],
        _ => Vec::new(),
    }
}

/// Checks one loop against the form `for (...; counter < limit; counter++)`.
fn check_counter(module: &Module, function: &Function, body: &Block, continuing: &Block) -> Result<(), String> {
    let shape = || "a loop that does not begin with `counter < limit`".to_owned();
    let test = body
        .iter()
        .find(|s| !matches!(s, Statement::Emit(_)))
        .ok_or_else(shape)?;
    let Statement::If { condition, reject, .. } = test else {
        return Err(shape());
    };
    if !matches!(reject.first(), Some(Statement::Break)) {
        return Err(shape());
    }
    let Expression::Binary {
        op: BinaryOperator::Less,
        left,
        right,
    } = function.expressions[*condition]
    else {
        return Err(shape());
    };
    let counter = loaded_variable(function, left).ok_or_else(shape)?;
    let variable = &function.local_variables[counter];
    let name = variable.name.as_deref().unwrap_or("counter");
    if module.types[variable.ty].inner != TypeInner::Scalar(Scalar::I32) {
        return Err(format!("`{name}` does not count in `i32`"));
    }
    let mut written = Vec::new();
    collect_writes(function, body, &mut written);
    if written.contains(&Some(counter)) || written.contains(&None) {
        return Err(format!("`{name}` may be written in the loop that it counts"));
    }
    let steps: Vec<&Statement> = continuing.iter().filter(|s| !matches!(s, Statement::Emit(_))).collect();
    let [Statement::Store { pointer, value }] = steps[..] else {
        return Err(format!("`{name}` is not all that changes between two rounds"));
    };
    let is_step = root_variable(function, *pointer) == Some(counter)
        && matches!(function.expressions[*value],
            Expression::Binary { op: BinaryOperator::Add, left, right }
            if loaded_variable(function, left) == Some(counter) && is_one(function, right));
    if !is_step {
        return Err(format!("`{name}` does not count up by one"));
    }
    let mut inside = Vec::new();
    collect_evaluated(body, &mut inside);
    if !is_invariant(module, function, right, &inside, &written) {
        return Err(format!("the limit of `{name}` may change in the loop"));
    }
    Ok(())
}

/// The local variable that an expression is the value of.
fn loaded_variable(function: &Function, expression: Handle<Expression>) -> Option<Handle<LocalVariable>> {
    match function.expressions[expression] {
        Expression::Load { pointer } => match function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            _ => None,
        },
        _ => None,
    }
}

fn is_one(function: &Function, expression: Handle<Expression>) -> bool {
    matches!(function.expressions[expression], Expression::Literal(Literal::I32(1)))
}

/// Returns the local variable that a pointer points into; `None` for all other memory, or if it is unknown.
fn root_variable(function: &Function, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
    match function.expressions[pointer] {
        Expression::LocalVariable(variable) => Some(variable),
        Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => root_variable(function, base),
        _ => None,
    }
}

/// Collects the local variables that statements write; `None` stands for unknown memory.
fn collect_writes(function: &Function, block: &Block, written: &mut Vec<Option<Handle<LocalVariable>>>) {
    for statement in block {
        match statement {
            Statement::Store { pointer, .. } => written.push(root_variable(function, *pointer)),
            // A function may write through its pointer arguments.
            Statement::Call { arguments, .. } => written.extend(
                arguments
                    .iter()
                    .map(|argument| root_variable(function, *argument))
                    .filter(Option::is_some),
            ),
            _ => {}
        }
        for inner in blocks_of(statement) {
            collect_writes(function, inner, written);
        }
    }
}

/// Expressions that are evaluated in a block.
fn collect_evaluated(block: &Block, inside: &mut Vec<Handle<Expression>>) {
    for statement in block {
        if let Statement::Emit(range) = statement {
            inside.extend(range.clone());
        }
        for inner in blocks_of(statement) {
            collect_evaluated(inner, inside);
        }
    }
}

/// Returns whether an expression has one value in all iterations of a loop in which those `inside` are evaluated.
fn is_invariant(
    module: &Module,
    function: &Function,
    expression: Handle<Expression>,
    inside: &[Handle<Expression>],
    written: &[Option<Handle<LocalVariable>>],
) -> bool {
    let stays = |other: Handle<Expression>| is_invariant(module, function, other, inside, written);
    match function.expressions[expression] {
        Expression::Literal(_) | Expression::Constant(_) | Expression::FunctionArgument(_) => true,
        _ if !inside.contains(&expression) => true,
        Expression::Load { pointer } => match root_variable(function, pointer) {
            Some(variable) => !written.contains(&Some(variable)),
            None => is_constant_memory(module, function, pointer),
        },
        Expression::Binary { left, right, .. } => stays(left) && stays(right),
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => stays(expr),
        Expression::AccessIndex { base, .. } => stays(base),
        _ => false,
    }
}

/// Returns whether a pointer leads to a fixed place in a uniform buffer, which nothing in a shader writes, or to a
/// private variable that no statement writes.
fn is_constant_memory(module: &Module, function: &Function, pointer: Handle<Expression>) -> bool {
    match function.expressions[pointer] {
        Expression::GlobalVariable(global) => match module.global_variables[global].space {
            AddressSpace::Uniform => true,
            AddressSpace::Private => !is_written(module, global),
            _ => false,
        },
        Expression::AccessIndex { base, .. } => is_constant_memory(module, function, base),
        _ => false,
    }
}

/// Returns whether a statement of a module may write a variable as a whole or pass a pointer to it on.
fn is_written(module: &Module, global: Handle<GlobalVariable>) -> bool {
    fn in_block(function: &Function, block: &Block, global: Handle<GlobalVariable>) -> bool {
        let is_it = |expression: &Handle<Expression>| root_global(function, *expression) == Some(global);
        block.iter().any(|statement| {
            let writes = match statement {
                Statement::Store { pointer, .. } => is_it(pointer),
                Statement::Call { arguments, .. } => arguments.iter().any(is_it),
                _ => false,
            };
            writes
                || blocks_of(statement)
                    .into_iter()
                    .any(|inner| in_block(function, inner, global))
        })
    }
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    let mut all = entries.chain(module.functions.iter().map(|(_, function)| function));
    all.any(|function| in_block(function, &function.body, global))
}

/// Returns the module's variable that a pointer points into.
fn root_global(function: &Function, pointer: Handle<Expression>) -> Option<Handle<GlobalVariable>> {
    match function.expressions[pointer] {
        Expression::GlobalVariable(global) => Some(global),
        Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => root_global(function, base),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::check_loops;

    fn check_body(body: &str) -> Result<(), String> {
        let text = format!(
            "struct U {{ n: i32, m: i32 }}\n@group(0) @binding(0) var<uniform> u: U;\n@group(0) @binding(1) var<storage, read_write> s: U;\noverride n: i32 = 4;\nvar<private> constant: i32 = n;\nvar<private> changed: i32 = 4;\nfn change(p: ptr<function, i32>) {{ *p = 0; changed = 9; }}\n@compute @workgroup_size(1)\nfn main(@builtin(global_invocation_id) id: vec3u) {{\n{body}\n}}"
        );
        check_loops(&naga::front::wgsl::parse_str(&text).expect("WGSL"))
    }

    #[test]
    fn loops_that_count_end() {
        let kept = [
            "for (var k = 0; k < 9; k++) { }",
            "let n = i32(id.x); for (var k = n - 4; k < n; k++) { for (var j = k; j < 2 * n + 1; j++) { } }",
            "var n = 4; for (var k = 0; k < n; k++) { var a = array<i32, 4>(); a[k] = k; }",
            "var sum = 0; for (var k = 0; k < 3; k++) { if id.x > 4u { continue; } sum = sum + k; }",
            "for (var k = 0; k < u.m; k++) { }",
            "for (var k = 0; k < constant; k++) { }",
            // The outer counter is the inner limit.
            "for (var k = 0; k < 9; k++) { for (var j = 0; j < k; j++) { } }",
        ];
        for body in kept {
            assert_eq!(check_body(body), Ok(()), "{body}");
        }
    }

    #[test]
    fn loops_that_may_not_end_are_told() {
        let refused = [
            ("loop { if id.x > 4u { break; } }", "does not begin"),
            ("while id.x > 4u { }", "does not begin"),
            (
                "var k = 0; loop { if k < 4 { } else { break; } continuing { k++; break if k == 9; } }",
                "break if",
            ),
            ("for (var k = 0; k < 9; k++) { k = 0; }", "may be written"),
            ("for (var k = 0; k < 9; k++) { change(&k); }", "may be written"),
            ("for (var k = 0; k < 9; k--) { }", "does not count up"),
            ("for (var k = 0; k < 9; k += 0) { }", "does not count up"),
            ("for (var k = 0u; k < id.x; k++) { }", "does not count in `i32`"),
            ("for (var k = 0.0; k < 9.0; k += 1.0) { }", "does not count in `i32`"),
            ("for (var k = 0; k <= 9; k++) { }", "does not begin"),
            ("for (var k = 0; k < changed; k++) { }", "may change"),
            ("var n = 4; for (var k = 0; k < n; k++) { n = n + 1; }", "may change"),
            ("var n = 4; for (var k = 0; k < n; k++) { change(&n); }", "may change"),
            (
                "for (var j = 0; j < 9; j++) { for (var k = 0; k < 9; k++) { j = 0; } }",
                "may be written",
            ),
        ];
        for (body, says) in refused {
            let why = check_body(body).expect_err(body);
            assert!(why.contains(says), "{body}: {why}");
        }
    }
}

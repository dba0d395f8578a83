//! Names of values, derived from the kernel's variables and the counters of the surrounding loops.

use super::ast::{Expr, Module, Stmt, StmtKind, VarId, Variable};
use super::own_words::is_own;
use super::refusal::Refusal;
use super::resources::Resources;
use super::words::{Reserved, Words, free_name, numbered_name, to_identifier};
use crate::spec::Target;
use std::collections::{BTreeSet, HashMap, HashSet};
use straightline_evaluator::ir::{BinaryOp, Counter, Element, Graph, NodeId, Op, Origin, Scalar, Type, UnaryOp};

/// Preferred names of values, derived from the variables of the kernel's source and the counters of the surrounding loops.
pub struct Wanted {
    /// Short forms of the counters' names.
    short: HashMap<String, String>,
}

impl Wanted {
    /// Collects the names for the values of a graph.
    pub fn new(graph: &Graph) -> Wanted {
        let origins = graph.origins.iter().flatten();
        let counters: BTreeSet<&str> = origins.flat_map(|o| &*o.counters).map(|c| &*c.name).collect();
        let initial = |name: &str| name.chars().next().unwrap_or('k');
        let short = |name: &&str| {
            let alone = counters.iter().filter(|other| initial(other) == initial(name)).count() == 1;
            match alone {
                true => initial(name).to_string(),
                false => (*name).to_owned(),
            }
        };
        Wanted {
            short: counters.iter().map(|name| ((*name).to_owned(), short(name))).collect(),
        }
    }

    /// Returns the preferred name of a node.
    pub fn preferred_name(&self, graph: &Graph, id: NodeId, origin: Option<&Origin>) -> String {
        match origin {
            Some(origin) if !origin.name.is_empty() => {
                let mut name = origin.name.to_string();
                for (k, counter) in origin.counters.iter().enumerate() {
                    // Several counters are written without separators.
                    if k == 0 || origin.counters.len() <= 2 {
                        name.push('_');
                    }
                    self.push_counter(counter, &mut name);
                }
                name
            }
            _ => value_name(graph, id),
        }
    }

    /// Appends a counter, such as `s2`, or `jn1` for -1.
    fn push_counter(&self, counter: &Counter, name: &mut String) {
        name.push_str(self.short.get(&*counter.name).map_or(&*counter.name, String::as_str));
        if counter.value < 0 {
            name.push('n');
        }
        name.push_str(&counter.value.unsigned_abs().to_string());
    }
}

/// Gives each variable of a module a name that is unique in its scope and not reserved in the language. `resources` are
/// spelled for the target.
///
/// # Errors
///
/// If a million variants of a name are taken.
pub fn assign_names(module: &mut Module<'_>, resources: &Resources, target: Target) -> Result<(), Refusal> {
    let mut taken: HashSet<String> = resources.taken_names(target).into_iter().collect();
    rename_functions(module, &resources.kernel, &taken)?;
    taken.extend(module.functions.iter().map(|f| f.name.clone()));
    let mut scopes = Scopes {
        kernel: &resources.kernel,
        variables: &mut module.variables,
        language: Words::from_target(target),
        reserved: Reserved::new(target, &resources.options),
        taken,
        numbers: HashMap::new(),
    };
    // Tables are visible everywhere; the declarations of a function only inside it.
    for (var, _) in &module.tables {
        scopes.name_variable(*var)?;
    }
    for function in &module.functions {
        let declared: Result<Vec<String>, Refusal> = function
            .params
            .iter()
            .map(|param| scopes.name_variable(*param))
            .collect();
        scopes.name_block(&function.body)?;
        scopes.leave_scope(declared?);
    }
    scopes.name_block(&module.body)
}

/// Renames functions other than the entry point if the kernel uses their names.
fn rename_functions(module: &mut Module<'_>, kernel: &str, taken: &HashSet<String>) -> Result<(), Refusal> {
    let mut renamed: HashMap<String, String> = HashMap::new();
    for function in &module.functions {
        if taken.contains(&function.name) && !renamed.contains_key(&function.name) {
            let is_taken = |name: &str| {
                taken.contains(name)
                    || module.functions.iter().any(|other| other.name == name)
                    || renamed.values().any(|other| other == name)
            };
            let other = free_name(kernel, &function.name, is_taken)?;
            renamed.insert(function.name.clone(), other);
        }
    }
    if renamed.is_empty() {
        return Ok(());
    }
    let mut functions = std::mem::take(&mut module.functions);
    let mut rule = |mut expr: Expr| {
        if let super::ast::Op::Function(name) = &mut expr.op
            && let Some(other) = renamed.get(name)
        {
            name.clone_from(other);
        }
        expr
    };
    for function in &mut functions {
        if let Some(other) = renamed.get(&function.name) {
            function.name.clone_from(other);
        }
        function.body.iter_mut().for_each(|stmt| stmt.rewrite(&mut rule));
    }
    module.rewrite(&mut |_, expr| rule(expr));
    module.functions = functions;
    Ok(())
}

/// Names by scope: a name declared in a block is free again after it.
struct Scopes<'m> {
    kernel: &'m str,
    variables: &'m mut [Variable],
    language: Words,
    reserved: Reserved,
    taken: HashSet<String>,
    /// By name, the number below which all suffixes are taken.
    numbers: HashMap<String, u32>,
}

impl Scopes<'_> {
    fn name_block(&mut self, block: &[Stmt<'_>]) -> Result<(), Refusal> {
        let mut declared = Vec::new();
        for stmt in block {
            match stmt.kind {
                StmtKind::Let(var, _) | StmtKind::Var(var, _) => declared.push(self.name_variable(var)?),
                StmtKind::For { counter, .. } => {
                    let name = self.name_variable(counter)?;
                    for inner in stmt.blocks() {
                        self.name_block(inner)?;
                    }
                    match self.language {
                        // In HLSL a loop's counter lives until the end of the block around the loop.
                        Words::Hlsl => declared.push(name),
                        Words::Wgsl | Words::Glsl => self.leave_scope(vec![name]),
                    }
                }
                _ => {
                    for inner in stmt.blocks() {
                        self.name_block(inner)?;
                    }
                }
            }
        }
        self.leave_scope(declared);
        Ok(())
    }

    /// Names a variable. The entry point's own variables keep their names.
    fn name_variable(&mut self, var: VarId) -> Result<String, Refusal> {
        let variable = &mut self.variables[var.0 as usize];
        if var <= VarId::PLACE {
            return Ok(variable.name.clone());
        }
        // naga reserves digits at the end of a name for its own suffixes.
        let base = to_identifier(&variable.name);
        let mut name = match self.reserved.has(&base) {
            true => format!("{base}_value"),
            false => base.clone(),
        };
        let is_taken = |name: &str| self.taken.contains(name) || self.reserved.has(name);
        if is_taken(&name) {
            let from = self.numbers.get(&base).copied().unwrap_or(2);
            // An engine may reserve all words with the name's prefix.
            let stem = match self.reserved.has(&format!("{base}_{from}")) {
                true => format!("v_{base}"),
                false => base.clone(),
            };
            let (numbered, next) = numbered_name(self.kernel, &stem, from, is_taken)?;
            self.numbers.insert(base, next);
            name = numbered;
        }
        self.taken.insert(name.clone());
        self.variables[var.0 as usize].name.clone_from(&name);
        Ok(name)
    }

    fn leave_scope(&mut self, declared: Vec<String>) {
        if !declared.is_empty() {
            self.numbers.clear();
        }
        for name in declared {
            if !is_own(&name) {
                self.taken.remove(&name);
            }
        }
    }
}

/// Returns the name of a value without a variable.
fn value_name(graph: &Graph, id: NodeId) -> String {
    let node = graph.node(id);
    match &node.op {
        Op::Load { texture, .. } | Op::Sample { texture, .. } => graph.textures[*texture as usize].name.clone(),
        Op::Gather { texture, .. } => format!("{}_around", graph.textures[*texture as usize].name),
        Op::Compare { texture, .. } | Op::GatherCompare { texture, .. } => {
            format!("{}_passes", graph.textures[*texture as usize].name)
        }
        Op::BufferLoad { buffer, field, .. } => match &graph.buffers[*buffer as usize].element {
            Element::Value(_) => graph.buffers[*buffer as usize].name.clone() + "_element",
            Element::Struct(of) => of
                .fields
                .get(*field as usize)
                .map_or_else(String::new, |f| f.name.clone()),
        },
        // A shared texel is named as if it had been read from the texture.
        Op::SharedLoad(shared) if graph.shared[*shared as usize].filled => {
            graph.shared[*shared as usize].name.trim_end_matches("_tile").to_owned()
        }
        Op::SharedLoad(shared) => graph.shared[*shared as usize].name.clone() + "_element",
        Op::TextureSize(texture) => graph.textures[*texture as usize].name.clone() + "_size",
        Op::TextureLevels(texture) => graph.textures[*texture as usize].name.clone() + "_levels",
        Op::TextureLayers(texture) => graph.textures[*texture as usize].name.clone() + "_layers",
        Op::BufferLen(buffer) => graph.buffers[*buffer as usize].name.clone() + "_len",
        Op::Unary(op) => unary_name(*op).to_owned(),
        Op::Binary(op) => binary_name(*op, node.ty).to_owned(),
        Op::Lane => "lane".to_owned(),
        Op::QuadSwap(_) => "swapped".to_owned(),
        Op::Derivative(_) => "slope".to_owned(),
        Op::Dot => "dotted".to_owned(),
        Op::Cross => "crossed".to_owned(),
        Op::Clamp => "clamped".to_owned(),
        Op::Select | Op::Result(_) if node.ty.is_scalar() => "selected".to_owned(),
        Op::Select | Op::Result(_) => "selection".to_owned(),
        Op::MakeArray => "table".to_owned(),
        Op::ArrayGet => "element".to_owned(),
        Op::ArraySet => "array".to_owned(),
        Op::Convert => match node.ty.scalar_kind() {
            Some(Scalar::F32) => "as_float".to_owned(),
            _ => "as_integer".to_owned(),
        },
        Op::Bitcast => "bits".to_owned(),
        Op::Exact | Op::Half => value_name(graph, node.args[0]),
        Op::Param(_, 0) => "k".to_owned(),
        Op::Param(..) => "carried".to_owned(),
        _ => "vector".to_owned(),
    }
}

/// Returns a name for the result of an operation.
fn unary_name(op: UnaryOp) -> &'static str {
    use UnaryOp::*;
    match op {
        Neg => "negated",
        Not | BitNot => "inverted",
        Abs => "magnitude",
        Sign => "sign_of",
        Floor | Ceil | Round | Trunc => "rounded",
        Fract => "fraction",
        Saturate => "saturated",
        Sqrt => "root",
        InverseSqrt => "inverse_root",
        Cbrt => "cube_root",
        Exp | Exp2 => "exponential",
        Log | Log2 => "logarithm",
        Sin | Sinh => "sine",
        Cos | Cosh => "cosine",
        Tan | Tanh => "tangent",
        Asin | Acos | Atan => "angle",
        CountOneBits | LeadingZeros | TrailingZeros => "bit_count",
        ReverseBits => "reversed",
    }
}

/// Returns a name for the result of an operation.
fn binary_name(op: BinaryOp, ty: Type) -> &'static str {
    use BinaryOp::*;
    match op {
        Add => "sum",
        Sub => "difference",
        Mul => "product",
        Div => "quotient",
        Rem => "remainder",
        Min => "smaller",
        Max => "larger",
        Pow => "power",
        Atan2 => "angle",
        And if ty.scalar_kind() == Some(Scalar::Bool) => "both",
        Or if ty.scalar_kind() == Some(Scalar::Bool) => "either",
        And | Or | Xor => "masked",
        Shl | Shr => "shifted",
        Eq => "is_equal",
        Ne => "differs",
        Lt | Le => "is_less",
        Gt | Ge => "is_greater",
    }
}

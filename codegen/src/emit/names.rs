//! Names of values: from the kernel's own variables and the counters of the loops that they were made in.

use super::ast::{self, Expr, Module, Stmt, StmtKind, VarId, Variable};
use super::resources::{OUTPUT, Resources, SAMPLER, UNIFORMS};
use std::collections::{BTreeSet, HashMap, HashSet};
use straightline_evaluator::ir::{BinaryOp, Counter, Element, Graph, NodeId, Op, Origin, Scalar, Type, UnaryOp};
use straightline_manifest::REGION;

/// Names that the text around a kernel's body has uses for.
const OWN: [&str; 11] = [
    UNIFORMS,
    SAMPLER,
    OUTPUT,
    REGION,
    "Parameters",
    "Region",
    "main",
    "frame",
    "pixel",
    "id",
    "position",
];

/// Whether the text around a kernel has a use for a name.
pub fn is_own(name: &str) -> bool {
    OWN.contains(&name) || OF_REGIONS.contains(&name) || OF_GROUPS.contains(&name)
}

/// Names that it has uses for where the shader filters a rectangle, or writes another row than that of its pixel.
const OF_REGIONS: [&str; 2] = ["within", "place"];

/// Names that it has uses for where invocations are those of a workgroup.
const OF_GROUPS: [&str; 3] = ["local_id", "group_id", "local_index"];

/// Longer names are cut, or refused where hosts use them.
pub const LONGEST: usize = 255;

/// A language whose words names stay clear of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Words {
    /// WGSL, and what naga makes of it.
    Wgsl,
    /// GLSL of every version.
    Glsl,
    /// HLSL.
    Hlsl,
}

impl Words {
    /// Whether a word has a meaning of its own in the language, or in what is written there beside the kernel.
    pub fn reserve(self, word: &str) -> bool {
        use naga::keywords::wgsl;
        let own =
            ["whole_quotient", "whole_remainder"].contains(&word) || word.starts_with("cube_root") || converts(word);
        own || word.starts_with("__")
            || match self {
                Words::Wgsl => wgsl::RESERVED.contains(&word) || wgsl::BUILTIN_IDENTIFIER_SET.contains(word),
                Words::Glsl => super::words::GLSL.contains(&word) || is_glsl_type(word) || word.starts_with("gl_"),
                Words::Hlsl => super::words::HLSL.contains(&word) || is_hlsl_type(word),
            }
    }
}

/// Whether a word is like the names of functions that convert: `to_vec2i`, `to_uint`.
fn converts(word: &str) -> bool {
    word.strip_prefix("to_").is_some_and(|ty| {
        ["i32", "u32", "int", "uint"].contains(&ty)
            || ["vec", "ivec", "uvec"].iter().any(|vector| ty.starts_with(vector))
    })
}

/// Whether a word has a meaning of its own in a language that the shader is always written in.
fn is_reserved(word: &str) -> bool {
    Words::Wgsl.reserve(word) || Words::Glsl.reserve(word)
}

/// Types of HLSL that come in families: `float4x3`, `uint2`, `min16float`.
fn is_hlsl_type(word: &str) -> bool {
    let bare = word.trim_end_matches(|c: char| c.is_ascii_digit() || c == 'x');
    let scalar = [
        "float",
        "int",
        "uint",
        "bool",
        "half",
        "double",
        "dword",
        "min16float",
        "min16int",
        "min12int",
    ];
    let opaque = ["sampler", "texture", "Texture", "RWTexture", "SamplerState"];
    let dimension = |rest: &str| rest.starts_with(|c: char| c.is_ascii_digit()) || rest.starts_with("CUBE");
    scalar.contains(&bare) || opaque.iter().any(|o| word.strip_prefix(o).is_some_and(dimension))
}

/// Types of GLSL that come in families: `mat4x3`, `ivec2`, `usampler2DArray`, `image3D`, ...
fn is_glsl_type(word: &str) -> bool {
    let is_type = |bare: &str| {
        let numbered = |prefix: &str| {
            bare.strip_prefix(prefix)
                .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
        };
        let opaque = ["sampler", "image", "texture", "subpassInput"];
        let is_opaque = |prefix: &&str| {
            let rest = bare.strip_prefix(prefix);
            let kinds = ["1D", "2D", "3D", "Cube", "Buffer", "Shadow", "MS"];
            let whole = *prefix != "image";
            rest.is_some_and(|rest| (whole && rest.is_empty()) || kinds.iter().any(|kind| rest.starts_with(kind)))
        };
        numbered("vec") || numbered("mat") || opaque.iter().any(is_opaque)
    };
    is_type(word) || word.strip_prefix(['i', 'u', 'b', 'd']).is_some_and(is_type)
}

/// Why a name that hosts use, of an input or a uniform, can be none in every language; names are not changed behind a host's
/// back. Uniforms are fields, and have only the name of the struct that holds them to stay clear of.
pub fn refused(name: &str, entry: &str, is_field: bool, has_place: bool, in_group: bool) -> Option<&'static str> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let own = OWN.contains(&name)
        || name == entry
        || (has_place && OF_REGIONS.contains(&name))
        || (in_group && OF_GROUPS.contains(&name));
    if is_reserved(name) {
        Some("is a word of WGSL or GLSL")
    } else if name == UNIFORMS || (own && !is_field) {
        Some("is a name that the shader itself has a use for")
    } else if name.len() > LONGEST {
        Some("is longer than the 255 letters that every compiler takes")
    } else if !name.chars().all(plain) || name.starts_with(|c: char| c.is_ascii_digit()) {
        Some("has other letters than those of ASCII, which GLSL does not take")
    } else if name.contains("__") || name == "_" {
        Some("has two underscores in a row, which GLSL keeps for itself")
    } else {
        None
    }
}

/// The entry point of a kernel: its name, changed where shading languages would not take it.
pub fn entry_point(kernel: &str) -> String {
    let name = identifier(kernel.strip_prefix("r#").unwrap_or(kernel));
    if is_reserved(&name) || Words::Hlsl.reserve(&name) || OWN.contains(&name.as_str()) {
        format!("{name}_kernel")
    } else {
        name
    }
}

/// A name as an identifier of every language: `é` becomes `ue9`, and what is very long is cut.
fn identifier(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() || c == '_' {
            out.push(c);
        } else if !c.is_ascii() {
            out += &format!("u{:x}", u32::from(c));
        } else {
            out.push('_');
        }
    }
    while out.contains("__") {
        // GLSL keeps two underscores in a row for itself.
        out = out.replace("__", "_");
    }
    out.truncate(LONGEST / 2);
    let out = out.trim_start_matches('_');
    if out.is_empty() || out.starts_with(|c: char| c.is_ascii_digit()) || out.starts_with("gl_") {
        format!("v_{out}")
    } else {
        out.to_owned()
    }
}

/// What values are to be called: by the variables of the kernel's source and the counters of the loops that they were made in.
pub struct Wanted {
    /// Short forms of counters' names.
    short: HashMap<String, String>,
}

impl Wanted {
    /// For the values of a graph.
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

    /// What a node is to be called.
    pub fn of(&self, graph: &Graph, id: NodeId, origin: Option<&Origin>) -> String {
        match origin {
            Some(origin) if !origin.name.is_empty() => {
                let mut name = origin.name.to_string();
                for (k, counter) in origin.counters.iter().enumerate() {
                    // Many counters stand close together.
                    if k == 0 || origin.counters.len() <= 2 {
                        name.push('_');
                    }
                    self.counter(counter, &mut name);
                }
                name
            }
            _ => plain(graph, id),
        }
    }

    /// Adds `s2`, or `jn1` for -1.
    fn counter(&self, counter: &Counter, name: &mut String) {
        name.push_str(self.short.get(&*counter.name).map_or(&*counter.name, String::as_str));
        if counter.value < 0 {
            name.push('n');
        }
        name.push_str(&counter.value.unsigned_abs().to_string());
    }
}

/// Gives the variables of a module names that differ from each other and from all `others` in their scope, and are no words of
/// the language.
pub fn assign(module: &mut Module<'_>, resources: &Resources, words: Words, others: &[String]) {
    let mut taken: HashSet<String> = OWN.map(str::to_owned).into();
    taken.extend(others.iter().cloned());
    taken.insert(resources.entry.clone());
    if resources.options.has_place() {
        taken.extend(OF_REGIONS.map(str::to_owned));
    }
    if resources.group.is_some() {
        taken.extend(OF_GROUPS.map(str::to_owned));
    }
    taken.extend(resources.names().map(str::to_owned));
    rename_functions(module, &taken);
    taken.extend(module.functions.iter().map(|f| f.name.clone()));
    let mut scopes = Scopes {
        variables: &mut module.variables,
        words,
        taken,
        numbers: HashMap::new(),
    };
    // Tables are seen by all; what a function declares is its own.
    for (var, _) in &module.tables {
        scopes.declare(*var);
    }
    for function in &module.functions {
        let declared: Vec<String> = function.params.iter().map(|param| scopes.declare(*param)).collect();
        scopes.block(&function.body);
        scopes.leave(declared);
    }
    scopes.block(&module.body);
}

/// Gives functions of the module's other names where theirs are those of something else at module scope.
fn rename_functions(module: &mut Module<'_>, taken: &HashSet<String>) {
    let mut names: HashMap<String, String> = HashMap::new();
    for function in &module.functions {
        let mut name = function.name.clone();
        while taken.contains(&name) {
            name.push_str("_of");
        }
        if name != function.name {
            names.insert(function.name.clone(), name);
        }
    }
    if names.is_empty() {
        return;
    }
    let mut rename = |mut expr: Expr| {
        if let ast::Op::Function(name) = &mut expr.op
            && let Some(other) = names.get(name)
        {
            name.clone_from(other);
        }
        expr
    };
    let bodies = module.functions.iter_mut().map(|function| &mut function.body);
    for stmt in bodies.flatten().chain(&mut module.body) {
        stmt.rewrite(&mut rename);
    }
    for (_, value) in &mut module.tables {
        value.rewrite_in_place(&mut rename);
    }
    for function in &mut module.functions {
        if let Some(name) = names.get(&function.name) {
            function.name.clone_from(name);
        }
    }
}

/// Names in scopes: what is declared in a block is free again after it.
struct Scopes<'m> {
    variables: &'m mut [Variable],
    words: Words,
    taken: HashSet<String>,
    /// By name, the number below which all are taken.
    numbers: HashMap<String, u32>,
}

impl Scopes<'_> {
    fn block(&mut self, block: &[Stmt<'_>]) {
        let mut declared = Vec::new();
        for stmt in block {
            match stmt.kind {
                StmtKind::Let(var, _) | StmtKind::Var(var, _) => declared.push(self.declare(var)),
                StmtKind::For { counter, .. } => {
                    let name = self.declare(counter);
                    stmt.blocks().into_iter().for_each(|inner| self.block(inner));
                    match self.words {
                        // A counter of HLSL lives until the end of the block around its loop.
                        Words::Hlsl => declared.push(name),
                        Words::Wgsl | Words::Glsl => self.leave(vec![name]),
                    }
                }
                _ => stmt.blocks().into_iter().for_each(|inner| self.block(inner)),
            }
        }
        self.leave(declared);
    }

    /// Gives a variable its name. The entry point's own are named as they are.
    fn declare(&mut self, var: VarId) -> String {
        let variable = &mut self.variables[var.0 as usize];
        if var <= VarId::PLACE {
            return variable.name.clone();
        }
        // naga keeps a digit at the end of a name for its own suffixes.
        let base = identifier(&variable.name);
        let mut name = match self.words.reserve(&base) {
            true => format!("{base}_value"),
            false => base.clone(),
        };
        if !self.taken.insert(name.clone()) {
            let k = self.numbers.entry(base.clone()).or_insert(2);
            loop {
                name = format!("{base}_{k}");
                *k += 1;
                if self.taken.insert(name.clone()) {
                    break;
                }
            }
        }
        self.variables[var.0 as usize].name.clone_from(&name);
        name
    }

    fn leave(&mut self, declared: Vec<String>) {
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

/// What a value without a variable is called.
fn plain(graph: &Graph, id: NodeId) -> String {
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
        // A texel is called as if it had been read from the texture.
        Op::SharedLoad(shared) if graph.shared[*shared as usize].filled => {
            graph.shared[*shared as usize].name.trim_end_matches("_tile").to_owned()
        }
        Op::SharedLoad(shared) => graph.shared[*shared as usize].name.clone() + "_element",
        Op::TextureSize(texture) => graph.textures[*texture as usize].name.clone() + "_size",
        Op::TextureLevels(texture) => graph.textures[*texture as usize].name.clone() + "_levels",
        Op::TextureLayers(texture) => graph.textures[*texture as usize].name.clone() + "_layers",
        Op::BufferLen(buffer) => graph.buffers[*buffer as usize].name.clone() + "_len",
        Op::Unary(op) => unary(*op).to_owned(),
        Op::Binary(op) => binary(*op, node.ty).to_owned(),
        Op::Lane => "lane".to_owned(),
        Op::Message(_) => "swapped".to_owned(),
        Op::Derivative(_) => "slope".to_owned(),
        Op::Dot => "dotted".to_owned(),
        Op::Cross => "crossed".to_owned(),
        Op::Clamp => "clamped".to_owned(),
        Op::Select | Op::Result(_) if node.ty.is_scalar() => "selected".to_owned(),
        Op::Select | Op::Result(_) => "selection".to_owned(),
        Op::MakeArray => "table".to_owned(),
        Op::ArrayGet => "element".to_owned(),
        Op::ArraySet => "array".to_owned(),
        Op::Convert => match node.ty.kind() {
            Some(Scalar::F32) => "as_float".to_owned(),
            _ => "as_integer".to_owned(),
        },
        Op::Bitcast => "bits".to_owned(),
        Op::Param(_, 0) => "k".to_owned(),
        Op::Param(..) => "carried".to_owned(),
        _ => "vector".to_owned(),
    }
}

/// What an operation gives.
fn unary(op: UnaryOp) -> &'static str {
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

/// What an operation gives.
fn binary(op: BinaryOp, ty: Type) -> &'static str {
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
        And if ty.kind() == Some(Scalar::Bool) => "both",
        Or if ty.kind() == Some(Scalar::Bool) => "either",
        And | Or | Xor => "masked",
        Shl | Shr => "shifted",
        Eq => "is_equal",
        Ne => "differs",
        Lt | Le => "is_less",
        Gt | Ge => "is_greater",
    }
}

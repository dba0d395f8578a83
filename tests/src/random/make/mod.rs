//! Random kernels as text, in everything that the kernel language has. rustc says what they mean, so nothing here
//! evaluates them; what is tracked is what the generator needs: which values are compile-time constants, which
//! variables are borrowed, and how much is computed.

mod adaptors;
mod angles;
mod branches;
mod calls;
mod choices;
mod closures;
mod conditions;
mod exprs;
mod features;
mod floats;
mod functions;
mod generics;
mod groups;
mod held;
mod integers;
mod items;
mod kernel;
mod lazy;
mod lets;
mod library;
mod loops;
mod matches;
mod objects;
mod orders;
mod places;
mod references;
mod resources;
mod shape;
mod shown;
mod slices;
mod spaces;
mod statements;
mod structures;
mod types;
mod vectors;
mod writes;

pub use features::{Feature, Features};

use super::Random;
use super::oracle::Text;
use groups::{Kept, Memory};
use shape::Shape;
use types::{Choice, Enumeration, Lane, Signature, Structure, Ty};

/// Bound on what a kernel computes with all loops unrolled, in nodes of its expressions.
const BUDGET: u32 = 420;

/// The kernel of a seed, made of the given features.
pub fn make(seed: u64, features: Features) -> Text {
    let mut maker = Maker::new(seed, features);
    maker.shape();
    maker.items();
    maker.kernel();
    Text {
        seed,
        source: maker.lines.join("\n") + "\n",
    }
}

/// Way in which a variable holds its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hold {
    /// By value.
    Value,
    /// `&T`.
    Shared,
    /// `&mut T`.
    Mutable,
}

/// A variable in reach.
#[derive(Clone, Debug)]
struct Local {
    name: String,
    ty: Ty,
    mutable: bool,
    hold: Hold,
    /// `true` if the value is a compile-time constant once all loops are unrolled.
    known: bool,
    /// Bounds of a known integer that may index or bound a loop.
    range: Option<(i64, i64)>,
    /// A counter that only its loop changes.
    counter: bool,
    /// A borrow makes it unusable until the reference is gone.
    frozen: bool,
}

/// Requirements on an expression.
#[derive(Clone, Copy, Debug)]
struct Want {
    /// Levels of nesting left.
    depth: u32,
    /// A compile-time constant.
    known: bool,
    /// `true` if rustc infers the type of an untyped literal from the context.
    inferred: bool,
}

impl Want {
    fn deeper(self) -> Want {
        Want {
            depth: self.depth.saturating_sub(1),
            ..self
        }
    }

    fn inferred(self, inferred: bool) -> Want {
        Want { inferred, ..self }
    }
}

/// A loop around.
#[derive(Clone, Debug)]
struct Around {
    /// Runtime conditions around it: under more of them it cannot be left.
    dynamic: u32,
    label: Option<String>,
    /// `true` if it, or an iteration of it, may be left at run time.
    left: bool,
}

/// A constant: its name, its type, and the range that an integer lies in.
type Constant = (String, Ty, Option<(i64, i64)>);

struct Maker {
    random: Random,
    features: Features,
    lines: Vec<String>,
    indent: usize,
    structures: Vec<Structure>,
    enumerations: Vec<Enumeration>,
    choices: Vec<Choice>,
    /// `true` if there are functions with `?`, with `..` in a pattern, and one that returns a closure.
    tries: bool,
    /// `true` if the trait is declared.
    traits: bool,
    signatures: Vec<Signature>,
    /// Names, types and bounds of constants.
    constants: Vec<Constant>,
    locals: Vec<Local>,
    next: u32,
    /// Runtime conditions around.
    dynamic: u32,
    nesting: u32,
    /// Upper bound on the executions of the current place.
    repeats: u32,
    cost: u32,
    budget: u32,
    loops: Vec<Around>,
    /// Type of the result of the function that is being made.
    result: Option<Ty>,
    /// Parameters and result of the kernel.
    shape: Shape,
    /// Memories of the workgroup, and values that each thread keeps.
    memories: Vec<Memory>,
    kept: Vec<Kept>,
    /// `true` if `a`, `b`, `p`, `q`, `r`, further inputs and `pixel` are in scope.
    inputs: bool,
    /// `true` inside an index or a value for a further input, which reads no other.
    reading: bool,
    /// `true` if an expression may call functions that change variables.
    effects: bool,
    options: bool,
}

impl Maker {
    fn new(seed: u64, features: Features) -> Maker {
        Maker {
            random: Random(seed),
            features,
            lines: Vec::new(),
            indent: 0,
            structures: Vec::new(),
            enumerations: Vec::new(),
            choices: Vec::new(),
            tries: false,
            traits: false,
            signatures: Vec::new(),
            constants: Vec::new(),
            locals: Vec::new(),
            next: 0,
            dynamic: 0,
            nesting: 0,
            repeats: 1,
            cost: 0,
            budget: BUDGET,
            loops: Vec::new(),
            result: None,
            shape: Shape::plain(),
            memories: Vec::new(),
            kept: Vec::new(),
            inputs: false,
            reading: false,
            effects: false,
            options: false,
        }
    }

    fn on(&self, feature: Feature) -> bool {
        self.features.has(feature)
    }

    /// True once in `n` times, where a feature is on.
    fn chance(&mut self, feature: Feature, n: usize) -> bool {
        self.on(feature) && self.random.once_in(n)
    }

    fn poor(&self) -> bool {
        self.cost >= self.budget
    }

    fn spend(&mut self, n: u32) {
        self.cost = self.cost.saturating_add(n.saturating_mul(self.repeats));
    }

    fn line(&mut self, text: impl AsRef<str>) {
        let text = text.as_ref();
        self.lines.push(format!("{}{text}", "    ".repeat(self.indent)));
    }

    fn open(&mut self, text: impl AsRef<str>) {
        self.line(text);
        self.indent += 1;
    }

    fn close(&mut self, text: &str) {
        self.indent -= 1;
        self.line(text);
    }

    fn fresh(&mut self, prefix: &str) -> String {
        self.next += 1;
        format!("{prefix}{}", self.next)
    }

    /// A variable's name: often one that is taken, for shadowing.
    fn name(&mut self) -> String {
        if self.random.once_in(4) {
            let frozen = |l: &&Local| {
                l.hold == Hold::Value
                    && !l.counter
                    && !l.frozen
                    && l.name != "self"
                    && l.name != "acc"
                    && l.name.len() < 4
            };
            let taken: Vec<String> = self.locals.iter().filter(frozen).map(|l| l.name.clone()).collect();
            let shielded = |name: &String| {
                self.locals
                    .iter()
                    .any(|l| l.name == *name && (l.frozen || l.counter || l.hold != Hold::Value))
            };
            let taken: Vec<String> = taken.into_iter().filter(|name| !shielded(name)).collect();
            if !taken.is_empty() {
                return self.random.pick(&taken);
            }
        }
        self.fresh("v")
    }

    fn bind(&mut self, name: &str, ty: &Ty, mutable: bool) {
        self.locals.push(Local {
            name: name.to_owned(),
            ty: ty.clone(),
            mutable,
            hold: Hold::Value,
            known: false,
            range: None,
            counter: false,
            frozen: false,
        });
    }

    fn last(&mut self) -> &mut Local {
        self.locals.last_mut().expect("a variable was just bound")
    }

    /// Variables that their names still reach and that no reference blocks.
    fn visible(&self) -> Vec<Local> {
        let mut seen: Vec<&str> = Vec::new();
        let mut found = Vec::new();
        for local in self.locals.iter().rev() {
            if !seen.contains(&local.name.as_str()) {
                seen.push(&local.name);
                if !local.frozen {
                    found.push(local.clone());
                }
            }
        }
        found
    }

    fn freeze(&mut self, name: &str, frozen: bool) {
        if let Some(local) = self.locals.iter_mut().rev().find(|l| l.name == name) {
            local.frozen = frozen;
        }
    }
}

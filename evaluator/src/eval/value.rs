//! What a variable holds while a kernel is evaluated.

use super::enums::EnumValue;
use crate::diagnostic::{Diagnostic, Span};
use crate::front::name::Name;
use crate::front::tree::Closure;
use crate::ir::NodeId;
use crate::limits::Held;
use std::collections::BTreeSet;
use std::ops::{Deref, DerefMut};
use std::rc::Rc;
use std::sync::Arc;

/// A value of the kernel language. A compile-time constant is known exactly: numbers as constant nodes, all else by itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A `usize` that is known, never negative.
    Int(i64),
    /// A scalar or vector, or in a structured loop an array; known if the node is a constant.
    Node(NodeId),
    /// A value of an enum; shared until it is changed.
    Enum(Rc<EnumValue>),
    /// A structure.
    Struct {
        /// Its type.
        ty: Name,
        /// Its fields in order; shared until one is changed.
        fields: Rc<Vec<(Name, Value)>>,
    },
    /// A tuple; `()` is empty.
    Tuple(Vec<Value>),
    /// An array with known indices; shared until it is changed.
    Array(Rc<Elements>),
    /// An array of structures, tuples, enums or arrays that is indexed at run time.
    Table(Rc<Table>),
    /// Counters from a first to one before an end, for a loop.
    Range(Range),
    /// A text: the name in `tally`.
    Str(String),
    /// A texture, by its index in the graph.
    Texture(u32),
    /// A sampler, by its index in the graph.
    Sampler(u32),
    /// A buffer, by its index in the graph.
    Buffer(u32),
    /// What a workgroup shares, by its index in the graph.
    Shared(u32),
    /// A picture that is written, by its index in the graph.
    Image(u32),
    /// A mutable reference to a variable or a part of one. A shared reference is the value that it refers to: nothing can
    /// change that meanwhile.
    Ref(Rc<Place>),
    /// A closure.
    Closure(Rc<ClosureValue>),
    /// A function, by the last two segments of its path.
    Function(Vec<String>),
    /// One of several functions and closures, by a number that is a runtime value: of two a boolean, `true` for the
    /// second, of more an `i32`.
    OneOf(NodeId, Rc<Vec<Value>>),
    /// `array::from_fn(f)`, of which only the type that is stated for it tells the length.
    Elements(Rc<Value>),
    /// A constant parameter of a structure's type, a hidden field: the 3 of `Window<3>`, or 1 for `true`.
    Const(i64),
    /// What a type parameter stands for, by the name of the type.
    Type(String),
    /// What a variable of a closure holds that is a variable around it.
    Alias(Rc<Place>),
    /// What a variable holds that has been declared and not been given a value.
    Unset,
    /// Any value of any type: what nobody looks at before it is given another one.
    Undef,
    /// What an expression with an error gives; using it is no second error.
    Poison,
}

/// Elements of an array, whose memory is counted.
#[derive(Clone, Debug)]
pub struct Elements {
    elements: Vec<Value>,
    /// Counts as long as the elements are held.
    _held: Held,
}

impl PartialEq for Elements {
    fn eq(&self, other: &Self) -> bool {
        self.elements == other.elements
    }
}

impl Deref for Elements {
    type Target = Vec<Value>;

    fn deref(&self) -> &Vec<Value> {
        &self.elements
    }
}

impl DerefMut for Elements {
    fn deref_mut(&mut self) -> &mut Vec<Value> {
        &mut self.elements
    }
}

/// An array by columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Number of elements.
    pub len: usize,
    /// An element with an array in place of each number: the numbers of all elements. Where an element is an array, it is a table whose
    /// arrays hold the numbers of all rows one after the other.
    pub element: Value,
    /// Row of the first element, an `i32`: set for a row of a table of arrays, which reads the arrays of the whole.
    pub from: Option<NodeId>,
}

impl Table {
    /// An array that is no part of another one.
    pub fn whole(len: usize, element: Value) -> Value {
        Value::Table(Rc::new(Table {
            len,
            element,
            from: None,
        }))
    }
}

/// A closure with the variables that it mentions.
#[derive(Clone, Debug)]
pub struct ClosureValue {
    /// What it computes.
    pub code: Arc<Closure>,
    /// Its variables by name.
    pub captured: Vec<(String, Captured)>,
    /// The function that it is made in, by which its loops are known.
    pub function: String,
}

impl PartialEq for ClosureValue {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.code, &other.code) && self.captured == other.captured
    }
}

/// A variable of a closure.
#[derive(Clone, Debug, PartialEq)]
pub enum Captured {
    /// One that it only reads.
    Value(Value),
    /// One that it writes.
    Place(Rc<Place>),
}

/// A variable, or a part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Position of the variable in the scope.
    pub slot: usize,
    /// The variable's number, by which it is known to be the same one still.
    pub id: u32,
    /// The way from the variable to the part.
    pub path: Vec<Step>,
}

/// A step from a value to one of its parts.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A field of a structure, a part of a tuple, a component of a vector.
    Field(Name),
    /// An element of an array, a component of a vector; the index may be a runtime value.
    Index(Value),
    /// A field of the variant of an enum at a position.
    VariantField(usize, Name),
}

impl Place {
    /// A part of this place.
    pub fn with_step(&self, step: Step) -> Place {
        let mut place = self.clone();
        place.path.push(step);
        place
    }
}

/// What a `for` runs over.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Its smallest value: a known integer, or a node of type `i32` or `u32`.
    pub start: Box<Value>,
    /// Its end, of the same type.
    pub end: Box<Value>,
    /// Whether the end belongs to it.
    pub inclusive: bool,
    /// Whether its steps go from the largest value down: `(a..b).rev()`.
    pub down: bool,
    /// Distance of values, at least 1.
    pub step: i64,
    /// Whether its values then come last to first: `(a..b).step_by(n).rev()`.
    pub reversed: bool,
}

impl Value {
    /// `()`.
    pub fn unit() -> Value {
        Value::Tuple(Vec::new())
    }

    /// An array of its elements.
    pub fn array(elements: Vec<Value>) -> Value {
        let held = Held::new(elements.len() * size_of::<Value>());
        Value::Array(Rc::new(Elements { elements, _held: held }))
    }

    /// A structure.
    pub fn structure(ty: impl Into<Name>, fields: Vec<(Name, Value)>) -> Value {
        Value::Struct {
            ty: ty.into(),
            fields: Rc::new(fields),
        }
    }

    /// Whether it can be called.
    pub fn is_called(&self) -> bool {
        matches!(self, Value::Closure(_) | Value::Function(_) | Value::OneOf(..))
    }

    /// Whether all nodes in it are those that [`Value::flatten`] lists: it holds no closure, range or place.
    pub fn is_plain(&self) -> bool {
        match self {
            Value::Struct { fields, .. } => fields.iter().all(|(_, value)| value.is_plain()),
            Value::Tuple(parts) => parts.iter().all(Value::is_plain),
            Value::Array(parts) => parts.iter().all(Value::is_plain),
            Value::Table(table) => table.element.is_plain(),
            Value::Enum(choice) => choice.all_fields().all(|(_, value)| value.is_plain()),
            Value::Int(_) | Value::Const(_) | Value::Node(_) | Value::Unset | Value::Undef => true,
            _ => false,
        }
    }

    /// Whether it is a closure that changes variables around it, or may be one.
    pub fn changes_variables(&self) -> bool {
        match self {
            Value::OneOf(_, all) => all.iter().any(Value::changes_variables),
            Value::Closure(closed) => closed.captured.iter().any(|(_, c)| matches!(c, Captured::Place(_))),
            _ => false,
        }
    }

    /// Numbers and other parts in it, counted up to `limit`.
    pub fn count_parts(&self, limit: usize) -> usize {
        let parts: Box<dyn Iterator<Item = &Value>> = match self {
            Value::Struct { fields, .. } => Box::new(fields.iter().map(|(_, value)| value)),
            Value::Tuple(parts) => Box::new(parts.iter()),
            Value::Array(parts) => Box::new(parts.iter()),
            Value::Enum(choice) => Box::new(choice.all_fields().map(|(_, value)| value)),
            Value::Table(table) => return table.len.saturating_mul(table.element.count_parts(limit)),
            _ => return 1,
        };
        let mut sum = 1;
        for part in parts {
            sum += part.count_parts(limit.saturating_sub(sum));
            if sum > limit {
                break;
            }
        }
        sum
    }

    /// Its kind, for messages.
    pub fn describe(&self) -> String {
        match self {
            Value::Int(_) => "an integer".to_owned(),
            Value::Node(_) => "a number".to_owned(),
            Value::Enum(choice) => format!("a `{}`", choice.ty),
            Value::Struct { ty, .. } => format!("a `{ty}`"),
            Value::Tuple(parts) if parts.is_empty() => "`()`".to_owned(),
            Value::Tuple(parts) => format!("a tuple of {}", parts.len()),
            Value::Array(parts) => format!("an array of {}", parts.len()),
            Value::Table(table) => format!("an array of {}", table.len),
            Value::Range(_) => "a range".to_owned(),
            Value::Str(_) => "a text".to_owned(),
            Value::Texture(_) => "a texture".to_owned(),
            Value::Sampler(_) => "a sampler".to_owned(),
            Value::Buffer(_) => "a buffer".to_owned(),
            Value::Image(_) => "a picture that is written".to_owned(),
            Value::Shared(_) => "memory of a workgroup".to_owned(),
            Value::Ref(_) => "a mutable reference".to_owned(),
            Value::Closure(_) => "a closure".to_owned(),
            Value::Function(path) => format!("the function `{}`", path.join("::")),
            Value::OneOf(..) => "one of several functions".to_owned(),
            Value::Elements(_) => "an array of which no type states the length".to_owned(),
            Value::Const(n) => format!("the constant {n}"),
            Value::Type(ty) => format!("the type `{ty}`"),
            Value::Alias(_) => "a variable".to_owned(),
            Value::Undef => "any value".to_owned(),
            Value::Unset => "a variable without a value".to_owned(),
            Value::Poison => "an error".to_owned(),
        }
    }
}

/// A value that had to be a compile-time constant, and is none because of loops left in the shader.
#[derive(Debug)]
pub struct ConstantDemand {
    /// Loops that the value depends on and that can be unrolled.
    pub loops: BTreeSet<Span>,
    /// The error if they could not be: names the place and the need.
    pub error: Diagnostic,
}

/// How evaluation of an expression ends other than by its value.
#[derive(Debug)]
pub enum Exit {
    /// With an error, not yet noted.
    Error(Box<Diagnostic>),
    /// With an error that has been noted.
    Noted,
    /// With values that had to be compile-time constants, and may be if loops before them are unrolled.
    Demand(Vec<ConstantDemand>),
    /// By leaving the blocks around it.
    Left(Jump),
}

impl Exit {
    /// Returns whether evaluation has nothing to go on with.
    pub fn is_failure(&self) -> bool {
        !matches!(self, Exit::Left(_))
    }
}

/// How the blocks around are left.
#[derive(Clone, Debug)]
pub enum Jump {
    /// `break`, of the loop with a label.
    Break(Option<String>),
    /// `continue`, of the loop with a label.
    Continue(Option<String>),
    /// `return`.
    Return(Value),
}

impl Jump {
    /// Whether it ends the loop with a label, if it stands in its body.
    pub fn breaks_loop(&self, label: Option<&str>) -> bool {
        matches!(self, Jump::Break(of) if of.is_none() || of.as_deref() == label)
    }

    /// Whether it ends an iteration of the loop with a label, if it stands in its body.
    pub fn continues_loop(&self, label: Option<&str>) -> bool {
        matches!(self, Jump::Continue(of) if of.is_none() || of.as_deref() == label)
    }

    /// Whether both lead to one place.
    pub fn is_like(&self, other: &Jump) -> bool {
        match (self, other) {
            (Jump::Break(a), Jump::Break(b)) | (Jump::Continue(a), Jump::Continue(b)) => a == b,
            (Jump::Return(_), Jump::Return(_)) => true,
            _ => false,
        }
    }

    /// What is taken along.
    pub fn into_value(self) -> Value {
        match self {
            Jump::Return(value) => value,
            _ => Value::unit(),
        }
    }
}

impl From<Diagnostic> for Exit {
    fn from(diagnostic: Diagnostic) -> Self {
        Exit::Error(Box::new(diagnostic))
    }
}

/// A value, or how the blocks around are left instead.
pub type Eval<T = Value> = Result<T, Exit>;

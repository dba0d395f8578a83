//! Values that variables hold while a kernel is evaluated.

use super::endless::Endless;
use super::enums::EnumValue;
use super::types::KnownType;
use crate::diagnostic::{Diagnostic, Span};
use crate::front::name::Name;
use crate::front::tree::Closure;
use crate::ir::NodeId;
use crate::limits::Held;
use std::collections::BTreeSet;
use std::ops::{Deref, DerefMut};
use std::rc::Rc;
use std::sync::Arc;

/// A value of the kernel language. A compile-time constant is known exactly: a number as a constant node, everything
/// else as the value itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A known `usize`, never negative.
    Int(i64),
    /// A scalar or vector, or in a structured loop an array; known if the node is a constant.
    Node(NodeId),
    /// A value of an enum; shared until changed.
    Enum(Rc<EnumValue>),
    /// A structure.
    Struct {
        /// Type of the structure.
        ty: Name,
        /// Fields in order; shared until one is changed.
        fields: Rc<Vec<(Name, Value)>>,
    },
    /// A tuple; `()` is empty.
    Tuple(Vec<Value>),
    /// An array whose indices are all known; shared until changed.
    Array(Rc<Elements>),
    /// An array of structures, tuples, enums or arrays that is indexed at run time.
    Table(Rc<Table>),
    /// Counters of a loop: a half-open or closed range.
    Range(Range),
    /// A string: the name in `tally`.
    Str(String),
    /// A texture, by its index in the graph.
    Texture(u32),
    /// A sampler, by its index in the graph.
    Sampler(u32),
    /// A buffer, by its index in the graph.
    Buffer(u32),
    /// Workgroup-shared memory, by its index in the graph.
    Shared(u32),
    /// A writable image, by its index in the graph.
    Image(u32),
    /// A mutable reference to a variable or a part of one. A shared reference is represented by the value that it
    /// refers to, which cannot change while the reference lives.
    Ref(Rc<Place>),
    /// A closure.
    Closure(Rc<ClosureValue>),
    /// A function, by the last two segments of its path.
    Function(Vec<String>),
    /// A choice among functions and closures, selected by a runtime value: a boolean for two (`true` selects the
    /// second), an `i32` for more.
    OneOf(NodeId, Rc<Vec<Value>>),
    /// A sequence of `std::iter` whose length no method has limited.
    Endless(Rc<Endless>),
    /// `array::from_fn(f)`: the length is known only from the stated type.
    Elements(Rc<Value>),
    /// A constant parameter of a structure's type, stored as a hidden field: the 3 of `Window<3>`, or 1 for `true`.
    Const(i64),
    /// The type bound to a type parameter.
    Type(Rc<KnownType>),
    /// A closure's variable that aliases a variable of the enclosing function.
    Alias(Rc<Place>),
    /// An uninitialised variable.
    Unset,
    /// An undefined value of any type.
    Undef,
    /// The result of an expression with an error; using it reports no second error.
    Poison,
}

/// Elements of an array, counted against the memory limit.
#[derive(Clone, Debug)]
pub struct Elements {
    elements: Vec<Value>,
    /// Counts the memory as long as the elements are held.
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

/// A table: an array stored by columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Number of elements.
    pub len: usize,
    /// An element in which each number is replaced by an array of that number in all elements. An array in an element
    /// becomes a table whose arrays hold the numbers of all rows, one row after the other.
    pub element: Value,
    /// Row of the first element, an `i32`. Set for a row of a table of arrays, which reads from the arrays of the
    /// whole table.
    pub from: Option<NodeId>,
}

impl Table {
    /// An array that is not part of another one.
    pub fn whole(len: usize, element: Value) -> Value {
        Value::Table(Rc::new(Table {
            len,
            element,
            from: None,
        }))
    }
}

/// A closure with its captured variables.
#[derive(Clone, Debug)]
pub struct ClosureValue {
    /// Code of the closure.
    pub code: Arc<Closure>,
    /// Captured variables by name.
    pub captured: Vec<(String, Captured)>,
    /// The function that defines the closure; its loops are identified by this name.
    pub function: String,
}

impl PartialEq for ClosureValue {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.code, &other.code) && self.captured == other.captured
    }
}

/// A captured variable.
#[derive(Clone, Debug, PartialEq)]
pub enum Captured {
    /// A variable that the closure only reads.
    Value(Value),
    /// A variable that the closure writes.
    Place(Rc<Place>),
}

/// A variable, or a part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Position of the variable in the scope.
    pub slot: usize,
    /// Number of the variable, which detects that the slot has been reused.
    pub id: u32,
    /// Steps from the variable to the part.
    pub path: Vec<Step>,
}

/// A step from a value to one of its parts.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A field of a structure, a part of a tuple, a component of a vector.
    Field(Name),
    /// An element of an array, a component of a vector; the index may be a runtime value.
    Index(Value),
    /// Elements of an array, from an index on: a slice.
    Slice {
        /// Index of the first element.
        from: usize,
        /// Number of elements.
        len: usize,
    },
    /// A field of the variant of an enum at a position.
    VariantField(usize, Name),
}

impl Place {
    /// Returns the place of a part of this place.
    pub fn with_step(&self, step: Step) -> Place {
        let mut place = self.clone();
        place.path.push(step);
        place
    }
}

/// Range of a `for` loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Smallest value: a known integer, or a node of type `i32` or `u32`.
    pub start: Box<Value>,
    /// End, of the same type.
    pub end: Box<Value>,
    /// `true` if the range includes its end.
    pub inclusive: bool,
    /// `true` if the values descend from the largest: `(a..b).rev()`.
    pub down: bool,
    /// Distance between consecutive values, at least 1.
    pub step: i64,
    /// `true` if the stepped values are then reversed: `(a..b).step_by(n).rev()`.
    pub reversed: bool,
}

impl Value {
    /// Returns `()`.
    pub fn unit() -> Value {
        Value::Tuple(Vec::new())
    }

    /// Returns an array of these elements.
    pub fn array(elements: Vec<Value>) -> Value {
        let held = Held::new(elements.len() * size_of::<Value>());
        Value::Array(Rc::new(Elements { elements, _held: held }))
    }

    /// Returns a structure of type `ty`.
    pub fn structure(ty: impl Into<Name>, fields: Vec<(Name, Value)>) -> Value {
        Value::Struct {
            ty: ty.into(),
            fields: Rc::new(fields),
        }
    }

    /// `true` if the value can be called.
    pub fn is_called(&self) -> bool {
        matches!(self, Value::Closure(_) | Value::Function(_) | Value::OneOf(..))
    }

    /// `true` if [`Value::flatten`] lists every node in the value, which therefore holds no closure, range or place.
    pub fn is_plain(&self) -> bool {
        match self {
            Value::Struct { fields, .. } => fields.iter().all(|(_, value)| value.is_plain()),
            Value::Tuple(parts) => parts.iter().all(Value::is_plain),
            Value::Array(parts) => parts.iter().all(Value::is_plain),
            Value::Table(table) => table.element.is_plain(),
            Value::Enum(choice) => choice.all_fields().all(|(_, value)| value.is_plain()),
            Value::Int(_) | Value::Const(_) | Value::Type(_) | Value::Node(_) | Value::Unset | Value::Undef => true,
            _ => false,
        }
    }

    /// `true` if the value is, or may be, a closure that changes captured variables.
    pub fn changes_variables(&self) -> bool {
        match self {
            Value::OneOf(_, all) => all.iter().any(Value::changes_variables),
            Value::Closure(closed) => closed.captured.iter().any(|(_, c)| matches!(c, Captured::Place(_))),
            _ => false,
        }
    }

    /// Returns the number of parts, nested ones included, counted up to `limit`.
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

    /// Returns the kind of the value, for messages.
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
            Value::Endless(_) => "a sequence without a length".to_owned(),
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
            Value::Type(ty) => format!("the type `{}`", ty.name),
            Value::Alias(_) => "a variable".to_owned(),
            Value::Undef => "any value".to_owned(),
            Value::Unset => "a variable without a value".to_owned(),
            Value::Poison => "an error".to_owned(),
        }
    }
}

/// A value that has to be a compile-time constant, but depends on loops left in the shader.
#[derive(Debug)]
pub struct ConstantDemand {
    /// Loops that the value depends on and that can be unrolled.
    pub loops: BTreeSet<Span>,
    /// The error to report if they cannot be unrolled; names the place and the need.
    pub error: Diagnostic,
}

/// Reason why the evaluation of an expression ended without a value.
#[derive(Debug)]
pub enum Exit {
    /// An error that has not been recorded yet.
    Error(Box<Diagnostic>),
    /// An error that has been recorded.
    Noted,
    /// Values that have to be compile-time constants, and may become so if earlier loops are unrolled.
    Demand(Vec<ConstantDemand>),
    /// A jump out of the enclosing blocks.
    Left(Jump),
}

impl Exit {
    /// `true` if evaluation cannot continue.
    pub fn is_failure(&self) -> bool {
        !matches!(self, Exit::Left(_))
    }
}

/// A jump out of the enclosing blocks.
#[derive(Clone, Debug)]
pub enum Jump {
    /// `break`, with the label of its loop.
    Break(Option<String>),
    /// `continue`, with the label of its loop.
    Continue(Option<String>),
    /// `return`.
    Return(Value),
    /// `unreachable!()`, at a place: no invocation takes it, so the other side of a branch gives all values.
    Unreachable(Span),
}

impl Jump {
    /// `true` if the jump, in the body of a loop with this label, ends that loop.
    pub fn breaks_loop(&self, label: Option<&str>) -> bool {
        matches!(self, Jump::Break(of) if of.is_none() || of.as_deref() == label)
    }

    /// `true` if the jump, in the body of a loop with this label, ends an iteration of that loop.
    pub fn continues_loop(&self, label: Option<&str>) -> bool {
        matches!(self, Jump::Continue(of) if of.is_none() || of.as_deref() == label)
    }

    /// `true` if both jumps have the same target.
    pub fn is_like(&self, other: &Jump) -> bool {
        match (self, other) {
            (Jump::Break(a), Jump::Break(b)) | (Jump::Continue(a), Jump::Continue(b)) => a == b,
            (Jump::Return(_), Jump::Return(_)) | (Jump::Unreachable(_), Jump::Unreachable(_)) => true,
            _ => false,
        }
    }

    /// Returns the value carried by the jump.
    pub fn into_value(self) -> Value {
        match self {
            Jump::Return(value) => value,
            _ => Value::unit(),
        }
    }
}

impl From<Box<Diagnostic>> for Exit {
    fn from(error: Box<Diagnostic>) -> Exit {
        Exit::Error(error)
    }
}

impl From<Diagnostic> for Exit {
    fn from(diagnostic: Diagnostic) -> Self {
        Exit::Error(Box::new(diagnostic))
    }
}

/// A value, or the reason why there is none.
pub type Eval<T = Value> = Result<T, Exit>;

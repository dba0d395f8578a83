//! Values that are known while a chain is read.

use super::Source;
use super::signature::PictureType;
use std::rc::Rc;
use straightline_manifest::chain::SizeRule;

/// Value of a variable of a chain, or of an expression.
#[derive(Clone)]
pub enum Value {
    /// An image with its type.
    Image(Image),
    /// A list of images.
    Images(Vec<Image>),
    /// Several values.
    Tuple(Vec<Value>),
    /// An integer of any type.
    Integer(i64),
    /// A boolean.
    Flag(bool),
    /// A variant of an enum of the options, in kebab case.
    Choice(String),
    /// A size.
    Size(SizeRule),
    /// A width (0) or a height (1).
    Side(SizeRule, usize),
    /// A parameter of the chain that is neither an image nor the options, by name.
    Param(String),
    /// The options of the chain.
    Options(String),
    /// A value that each pass computes for itself: the index of its `let`.
    Later(usize),
    /// The value of an expression that was refused.
    Broken,
    /// The value of a variable before it has one.
    Unset,
    /// The value of a statement that has run.
    Unit,
}

/// An image that a pass can read.
#[derive(Clone)]
pub struct Image {
    /// The input or picture.
    pub source: Source,
    /// Its type, as a variable of the chain has it.
    pub ty: Rc<PictureType>,
}

impl Value {
    /// Name of the kind of value, for messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Value::Image(_) => "a picture",
            Value::Images(_) => "a list of pictures",
            Value::Tuple(_) => "a tuple",
            Value::Integer(_) => "an integer",
            Value::Flag(_) => "a boolean",
            Value::Choice(_) => "a variant of an option",
            Value::Size(_) => "a size",
            Value::Side(..) => "a side of a size",
            Value::Param(_) => "a value that is set at run time",
            Value::Options(_) => "the options",
            Value::Later(_) => "a value that only a pass can compute",
            Value::Broken | Value::Unset | Value::Unit => "nothing",
        }
    }

    /// The boolean that this is.
    pub fn into_flag(self) -> Option<bool> {
        match self {
            Value::Flag(flag) => Some(flag),
            _ => None,
        }
    }
}

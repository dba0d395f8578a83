//! Names of nodes, after the variables, fields and parameters that hold them.

use super::Evaluator;
use super::value::Value;
use crate::diagnostic::Span;
use crate::front::name::Name;
use crate::ir::{Naming, NodeId, Op, Origin};
use std::rc::Rc;
use std::sync::Arc;

/// Number of structures remembered as already named.
const NAMED_STRUCTURES: usize = 4;

/// Upper limit for the array elements that are named one by one.
const MAX_NAMED: usize = 1024;

/// A structure whose parts have been named.
pub struct NamedStruct {
    fields: Rc<Vec<(Name, Value)>>,
    /// The parameter after which they are named.
    after: Name,
}

impl Evaluator<'_> {
    /// `true` if the parts of a structure were recently named after a parameter, so that naming them again changes
    /// nothing.
    pub fn was_named(&mut self, value: &Value, parameter: &Name) -> bool {
        let Value::Struct { fields, .. } = value else {
            return false;
        };
        let is_it = |named: &NamedStruct| named.after == *parameter && Rc::ptr_eq(&named.fields, fields);
        if self.named.iter().any(is_it) {
            return true;
        }
        if self.named.len() == NAMED_STRUCTURES {
            self.named.pop_front();
        }
        self.named.push_back(NamedStruct {
            fields: Rc::clone(fields),
            after: parameter.clone(),
        });
        false
    }

    /// Names nodes after the variable that they are assigned to.
    pub fn name_value(&mut self, value: &Value, name: &str, span: Span) {
        self.name_as(value, name, Naming::Let, span);
    }

    /// Gives the numbers in a value the names that they have from now on.
    pub fn name_as(&mut self, value: &Value, name: &str, naming: Naming, span: Span) {
        // Variables of the built-in library do not name anything.
        if span.file != crate::front::std::FILE && !name.starts_with('#') {
            self.name_parts(value, &LazyName::Whole(name), naming, span);
        }
    }

    fn name_parts(&mut self, value: &Value, called: &LazyName<'_>, naming: Naming, span: Span) {
        match value {
            Value::Node(id) => self.name_node(*id, called, naming, span),
            Value::Struct { fields, .. } => {
                for (field, value) in fields.iter() {
                    self.name_parts(value, &LazyName::Field(called, field), naming, span);
                }
            }
            Value::Tuple(parts) => self.name_each(parts, called, naming, span),
            Value::Array(parts) => self.name_each(parts, called, naming, span),
            Value::Table(table) => self.name_parts(&table.element, called, naming, span),
            Value::Enum(choice) if choice.names_something() => {
                let (tag, inside) = self.choice_names(choice, &called.to_string());
                if let Some((id, name)) = tag {
                    self.name_node(id, &LazyName::Whole(&name), naming, span);
                }
                for (value, name) in inside {
                    self.name_parts(&value, &LazyName::Whole(&name), naming, span);
                }
            }
            _ => {}
        }
    }

    fn name_each(&mut self, parts: &[Value], called: &LazyName<'_>, naming: Naming, span: Span) {
        // So many names are of no use to a reader, and an array is named each time it is copied.
        if parts.len() > MAX_NAMED {
            return;
        }
        for (k, part) in parts.iter().enumerate() {
            self.name_parts(part, &LazyName::Number(called, k), naming, span);
        }
    }

    fn name_node(&mut self, id: NodeId, called: &LazyName<'_>, naming: Naming, span: Span) {
        let op = &self.builder.graph().node(id).op;
        // Other variables may hold the same constant; the result of a function is unambiguous.
        let is_constant = matches!(op, Op::Const(_));
        if is_constant && naming < Naming::Function {
            return;
        }
        if matches!(
            op,
            Op::Pixel
                | Op::FrameSize
                | Op::Uniform(_)
                | Op::Override(_)
                | Op::Varying(_)
                | Op::Param(..)
                | Op::MakeArray
        ) {
            return;
        }
        let known = self.builder.graph().origin(id);
        if let Some(known) = known.filter(|origin| !origin.name.is_empty() && origin.naming <= naming) {
            // The present name is as good. If the new name is equal, keep only the details that both share.
            if naming > Naming::Let || !called.is_name(&known.name) {
                return;
            }
        }
        let origin = Origin {
            name: match called {
                LazyName::Whole(name) => (*name).into(),
                parts => parts.to_string().into(),
            },
            naming,
            file: span.file,
            line: span.line,
            counters: match is_constant {
                true => Arc::default(),
                false => Arc::clone(self.loops.counters()),
            },
        };
        self.builder.set_origin(id, &origin);
    }
}

/// The name of a part of a value, assembled only when needed.
enum LazyName<'n> {
    Whole(&'n str),
    Field(&'n LazyName<'n>, &'n str),
    Number(&'n LazyName<'n>, usize),
}

impl LazyName<'_> {
    /// `true` if this name equals `name`.
    fn is_name(&self, name: &str) -> bool {
        match self {
            LazyName::Whole(whole) => *whole == name,
            LazyName::Field(whole, field) => {
                let rest = name.strip_suffix(field).and_then(|rest| rest.strip_suffix('_'));
                rest.is_some_and(|rest| whole.is_name(rest))
            }
            LazyName::Number(whole, k) => {
                let (rest, number) = name.rsplit_once('_').unwrap_or_default();
                number.parse() == Ok(*k) && whole.is_name(rest)
            }
        }
    }
}

impl std::fmt::Display for LazyName<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            LazyName::Whole(name) => f.write_str(name),
            LazyName::Field(whole, field) => write!(f, "{whole}_{field}"),
            LazyName::Number(whole, k) => write!(f, "{whole}_{k}"),
        }
    }
}

//! Lists of values as functions of a position, so that a loop over them can be left in the shader.
//!
//! Values of one shape are split into columns, one for each number in them. A column is one of: a number equal in
//! every value; an arithmetic progression (the counter of `enumerate`); elements of one array at indices in
//! arithmetic progression (`iter`, `rev`); or a table of its own.

use super::Evaluator;
use super::loops::LoopBody;
use super::shape::same_shape;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::Pattern;
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type};
use std::rc::Rc;

/// `true` if a value contains values of enums.
pub fn has_choices(value: &Value) -> bool {
    match value {
        Value::Enum(_) => true,
        Value::Struct { fields, .. } => fields.iter().any(|(_, part)| has_choices(part)),
        Value::Tuple(parts) => parts.iter().any(has_choices),
        Value::Array(parts) => parts.iter().any(has_choices),
        _ => false,
    }
}

/// Upper limit for the numbers in one value of a list stored as a table.
const MAX_COLUMNS: usize = 64;

/// A list of values of one shape.
pub struct Columns {
    template: Value,
    columns: Vec<Column>,
    len: u32,
}

/// The numbers at one position in each value of a list.
enum Column {
    /// A number equal in every value.
    Same(NodeId),
    /// An arithmetic progression.
    Even(Progression, Type),
    /// Elements of an array at indices in arithmetic progression.
    Of(NodeId, Progression),
}

/// An arithmetic progression, wrapping on overflow.
#[derive(Clone, Copy)]
struct Progression {
    first: u32,
    step: u32,
}

impl Columns {
    /// Returns the number of values.
    pub fn len(&self) -> u32 {
        self.len
    }
}

impl Evaluator<'_> {
    /// Splits the values into columns; an error says why that is impossible.
    pub fn by_columns(&mut self, values: &[Value], span: Span) -> Eval<Columns> {
        let mut rows = Vec::new();
        for value in values {
            rows.push(self.known_integers(value, &values[0]));
        }
        self.with_all_variants(&mut rows, span)?;
        let unlike = rows.iter().find(|row| !same_shape(row, &rows[0]));
        if let Some(unlike) = unlike {
            return Err(Diagnostic::error_at(
                Code::UnlikeValues,
                span,
                format!(
                    "the elements are unlike: {} and {}",
                    rows[0].describe(),
                    unlike.describe()
                ),
            )
            .into());
        }
        let leaves: Vec<Vec<NodeId>> = rows
            .iter()
            .map(|row| {
                let mut leaves = Vec::new();
                row.flatten(&mut leaves);
                leaves
            })
            .collect();
        let width = leaves[0].len();
        if width > MAX_COLUMNS {
            return Err(Diagnostic::error_at(
                Code::TooLarge,
                span,
                format!("each element has {width} numbers, more than {MAX_COLUMNS}"),
            )
            .into());
        }
        let mut columns = Vec::new();
        for k in 0..width {
            let column: Vec<NodeId> = leaves.iter().map(|row| row[k]).collect();
            columns.push(self.build_column(&column, span)?);
        }
        Ok(Columns {
            template: rows[0].clone(),
            columns,
            len: values.len() as u32,
        })
    }

    /// Returns the value with untyped integers as nodes of the type found at the same position in `like`.
    fn known_integers(&mut self, value: &Value, like: &Value) -> Value {
        match (value, like) {
            (Value::Int(n), _) => {
                let ty = match like {
                    Value::Node(id) if matches!(self.ty(*id), Type::U32 | Type::I32) => self.ty(*id),
                    _ => Type::USIZE,
                };
                // An integer that does not fit stays unchanged, which makes the shapes differ.
                let fits = match ty {
                    Type::U32 => u32::try_from(*n).is_ok(),
                    Type::I32 => i32::try_from(*n).is_ok(),
                    _ => return Value::Node(self.builder.usize(*n as u64)),
                };
                match fits {
                    true => Value::Node(self.integer_constant(*n as u32, ty)),
                    false => value.clone(),
                }
            }
            (Value::Struct { ty, fields }, Value::Struct { fields: others, .. }) if fields.len() == others.len() => {
                let pairs = fields.iter().zip(others.iter());
                let fields = pairs.map(|((name, part), (_, like))| (name.clone(), self.known_integers(part, like)));
                let fields = fields.collect();
                Value::structure(ty.clone(), fields)
            }
            (Value::Tuple(parts), Value::Tuple(others)) if parts.len() == others.len() => {
                let parts = parts
                    .iter()
                    .zip(others)
                    .map(|(part, like)| self.known_integers(part, like));
                Value::Tuple(parts.collect())
            }
            (Value::Array(parts), Value::Array(others)) if parts.len() == others.len() => {
                let parts = parts
                    .iter()
                    .zip(others.iter())
                    .map(|(part, like)| self.known_integers(part, like));
                let parts = parts.collect();
                Value::array(parts)
            }
            (Value::Enum(choice), _) => {
                Value::Enum(Rc::new(choice.with_fields(|value| self.known_integers(value, value))))
            }
            _ => value.clone(),
        }
    }

    /// Gives values of enums one shape, in which every variant that any of them may be is possible.
    fn with_all_variants(&mut self, rows: &mut [Value], span: Span) -> Eval<()> {
        if !rows.first().is_some_and(has_choices) {
            return Ok(());
        }
        let mut widest = rows[0].clone();
        for row in rows.iter() {
            widest = self.unify_values(&widest, row, span)?.0;
        }
        for row in rows.iter_mut() {
            *row = self.unify_values(row, &widest, span)?.0;
        }
        Ok(())
    }

    fn build_column(&mut self, nodes: &[NodeId], span: Span) -> Eval<Column> {
        let ty = self.ty(nodes[0]);
        if nodes.iter().all(|id| *id == nodes[0]) {
            return Ok(Column::Same(nodes[0]));
        }
        let Type::Value {
            scalar,
            components: lanes,
        } = ty
        else {
            return Err(Diagnostic::error_at(Code::UnlikeValues, span, "its elements are arrays").into());
        };
        if nodes.iter().any(|id| self.ty(*id) != ty) {
            return Err(Diagnostic::error_at(Code::UnlikeValues, span, "its elements have several types").into());
        }
        if matches!(ty, Type::I32 | Type::U32 | Type::USIZE)
            && let Some(even) = self.find_progression(nodes)
        {
            return Ok(Column::Even(even, ty));
        }
        // Elements of one array.
        let graph = self.builder.graph();
        let array = graph.node(nodes[0]).args.first().copied();
        if let Some(array) = array
            && nodes.iter().all(|id| {
                let node = graph.node(*id);
                node.op == Op::ArrayGet && node.args[0] == array
            })
        {
            let indices: Vec<NodeId> = nodes.iter().map(|id| graph.node(*id).args[1]).collect();
            if let Some(even) = self.find_progression(&indices) {
                return Ok(Column::Of(array, even));
            }
        }
        let len = nodes.len() as u32;
        let table = Type::Array {
            scalar,
            components: lanes,
            len,
        };
        let array = self.builder.add(Op::MakeArray, nodes, table);
        Ok(Column::Of(array, Progression { first: 0, step: 1 }))
    }

    /// Returns the constants as an arithmetic progression, if they are one.
    fn find_progression(&self, nodes: &[NodeId]) -> Option<Progression> {
        let graph = self.builder.graph();
        let low = |bits: crate::ir::Bits| (bits[1] == 0).then_some(bits[0]);
        let bits: Option<Vec<u32>> = nodes.iter().map(|id| graph.constant_bits(*id).and_then(low)).collect();
        let bits = bits?;
        let step = bits.get(1)?.wrapping_sub(bits[0]);
        let evenly = bits.windows(2).all(|pair| pair[1].wrapping_sub(pair[0]) == step);
        // A negative step of a `usize` wraps at 32 bits here, but at 64 bits in native code.
        let wide = graph.ty(nodes[0]) == Type::USIZE && step > i32::MAX as u32 && step != u32::MAX;
        (evenly && !wide).then_some(Progression { first: bits[0], step })
    }

    /// Returns the value at a position, an `i32`.
    pub fn element_at(&mut self, columns: &Columns, position: NodeId) -> Value {
        let mut nodes = Vec::new();
        for column in &columns.columns {
            nodes.push(match column {
                Column::Same(id) => *id,
                Column::Even(even, ty) => {
                    let position = self.convert_node(position, ty.scalar_kind().unwrap_or(Scalar::I32));
                    self.progression_value(*even, position)
                }
                Column::Of(array, even) => {
                    let index = self.progression_value(*even, position);
                    let element = self.ty(*array).element_type();
                    self.builder.add(Op::ArrayGet, [*array, index], element)
                }
            });
        }
        columns.template.unflatten(&mut nodes.into_iter())
    }

    /// Returns the element at a runtime index of an array of arrays, tuples or structures; `None` for an array of
    /// numbers that cannot be simplified.
    pub fn element_of_many(&mut self, base: &Value, index: NodeId, span: Span) -> Eval<Option<Value>> {
        let Value::Array(elements) = base else { return Ok(None) };
        match elements.first() {
            Some(Value::Array(row)) if row.len() * elements.len() <= super::MAX_PARTS => {
                if let Some(flat) = self.flatten_rows(elements) {
                    let from = self.build_integer_op(BinaryOp::Mul, index, row.len() as u32);
                    let element = self.ty(flat).element_type();
                    let row = (0..row.len() as u32).map(|k| {
                        let at = self.build_integer_op(BinaryOp::Add, from, k);
                        Value::Node(self.builder.add(Op::ArrayGet, [flat, at], element))
                    });
                    let row = row.collect();
                    return Ok(Some(Value::array(row)));
                }
                self.row_of_list(base, elements, index, span)
            }
            Some(Value::Array(_) | Value::Struct { .. } | Value::Tuple(_) | Value::Enum(_) | Value::Table(_)) => {
                self.row_of_list(base, elements, index, span)
            }
            Some(Value::Node(id)) if self.ty(*id).is_array() => self.row_of_list(base, elements, index, span),
            Some(first) if first.is_called() && elements.iter().all(Value::is_called) => {
                Ok(Some(self.called_at(elements, index)))
            }
            _ => Ok(self.element_of_row(elements, index)),
        }
    }

    /// Returns an element of a list through columns, or through a table if the elements contain arrays.
    fn row_of_list(&mut self, base: &Value, elements: &[Value], index: NodeId, span: Span) -> Eval<Option<Value>> {
        let error = match self.by_columns(elements, span) {
            Ok(columns) => return Ok(Some(self.element_at(&columns, index))),
            Err(Exit::Error(error)) => error,
            Err(exit) => return Err(exit),
        };
        match self.tabled(base, span) {
            Ok(Value::Table(table)) => Ok(Some(self.row_at(&table.element, index))),
            Err(exit @ Exit::Demand(_)) => Err(exit),
            _ => Err(Exit::Error(error)),
        }
    }

    /// Concatenates an array of arrays of numbers of one type, row by row.
    fn flatten_rows(&mut self, rows: &[Value]) -> Option<NodeId> {
        let mut nodes = Vec::new();
        for row in rows {
            let (Value::Array(row), Value::Array(first)) = (row, &rows[0]) else {
                return None;
            };
            if row.len() != first.len() {
                return None;
            }
            for value in row.iter() {
                match self.known_integers(value, &first[0]) {
                    Value::Node(id) => nodes.push(id),
                    _ => return None,
                }
            }
        }
        let Type::Value {
            scalar,
            components: lanes,
        } = self.ty(nodes[0])
        else {
            return None;
        };
        let len = nodes.len() as u32;
        let alike = nodes.iter().all(|id| self.ty(*id) == self.ty(nodes[0]));
        let ty = Type::Array {
            scalar,
            components: lanes,
            len,
        };
        alike.then(|| self.builder.add(Op::MakeArray, nodes, ty))
    }

    /// Returns an element of a row of a flat array, whose elements are `flat[from]`, `flat[from + 1]`, ...
    fn element_of_row(&mut self, row: &[Value], index: NodeId) -> Option<Value> {
        let get = |e: &Self, value: &Value| match value {
            Value::Node(id) if e.builder.graph().node(*id).op == Op::ArrayGet => {
                let args = &e.builder.graph().node(*id).args;
                Some((args[0], args[1]))
            }
            _ => None,
        };
        let (flat, from) = get(self, row.first()?)?;
        // Elements at known indices are left to the folding rules.
        if row.len() < 2 || self.builder.graph().constant_bits(from).is_some() {
            return None;
        }
        for (k, value) in row.iter().enumerate() {
            let at = self.build_integer_op(BinaryOp::Add, from, k as u32);
            if get(self, value)? != (flat, at) {
                return None;
            }
        }
        let at = self.builder.add(Op::Binary(BinaryOp::Add), [from, index], Type::I32);
        let element = self.ty(flat).element_type();
        Some(Value::Node(self.builder.add(Op::ArrayGet, [flat, at], element)))
    }

    fn progression_value(&mut self, even: Progression, position: NodeId) -> NodeId {
        let ty = self.ty(position);
        let first = self.integer_constant(even.first, ty);
        if even.step == u32::MAX {
            return self.builder.add(Op::Binary(BinaryOp::Sub), [first, position], ty);
        }
        let far = self.build_integer_op(BinaryOp::Mul, position, even.step);
        self.builder.add(Op::Binary(BinaryOp::Add), [first, far], ty)
    }

    /// Names the counter of a loop if the pattern binds it directly: the first part of `enumerate`.
    pub fn name_position(&mut self, body: &LoopBody<'_>, item: &Value, own: NodeId) {
        if let (Some(Pattern::Tuple(parts, _)), Value::Tuple(values)) = (body.pattern, item)
            && let (Some(Pattern::Name(name, _, at)), Some(Value::Node(id))) = (parts.first(), values.first())
            && *id == own
            && matches!(self.builder.graph().node(own).op, Op::Param(..))
        {
            self.name_params(&Value::Node(own), name, *at);
        }
    }
}

//! Arrays of structures, tuples, enums and arrays that are indexed at run time. They are stored as one array of
//! numbers for each number of an element.
//!
//! `[Light; 4]` with a position and a colour becomes two arrays of four vectors; `[[f32; 3]; 8]` becomes one array of
//! 24 numbers, row by row. As long as all indices are constants, such an array is a list of its elements instead.

use super::Evaluator;
use super::enums::{EnumValue, Tag};
use super::expr::out_of_range;
use super::shape::{MAX_INDEXED, not_indexed, same_shape, too_many_elements};
use super::value::{Eval, Step, Table, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::name::Name;
use crate::ir::{BinaryOp, NodeId, Op, Type};
use std::rc::Rc;

impl Evaluator<'_> {
    /// Returns an array in the form that a runtime index needs: a node of numbers, or a table.
    pub fn tabled(&mut self, value: &Value, span: Span) -> Eval {
        match value {
            Value::Table(table) if table.from.is_none() => Ok(value.clone()),
            Value::Table(_) => {
                let rows = self.rows(value, span)?;
                self.tabled(&Value::array(rows), span)
            }
            Value::Array(rows) if self.is_tabled(value) => {
                let (len, rows) = (rows.len(), rows.to_vec());
                let element = self.columns_of(rows, span)?;
                Ok(Table::whole(len, element))
            }
            other => Ok(Value::Node(self.array_node(other, span)?)),
        }
    }

    /// `true` if a value is an array of anything but numbers.
    pub fn is_tabled(&self, value: &Value) -> bool {
        match value {
            Value::Table(_) => true,
            Value::Array(rows) => rows.first().is_some_and(|first| !self.is_numeric(first)),
            _ => false,
        }
    }

    fn is_numeric(&self, value: &Value) -> bool {
        match value {
            Value::Int(_) => true,
            Value::Node(id) => !self.ty(*id).is_array(),
            _ => false,
        }
    }

    /// Returns the elements of an array in any form.
    pub fn rows(&mut self, array: &Value, span: Span) -> Eval<Vec<Value>> {
        let len = self.array_len(array).unwrap_or(0);
        (0..len as i64)
            .map(|k| self.array_element(array, &Value::Int(k), span))
            .collect()
    }

    /// Returns the number of elements of an array in any form.
    pub fn array_len(&self, value: &Value) -> Option<usize> {
        match value {
            Value::Array(elements) => Some(elements.len()),
            Value::Table(table) => Some(table.len),
            Value::Node(id) => match self.ty(*id) {
                Type::Array { len, .. } => Some(len as usize),
                _ => None,
            },
            _ => None,
        }
    }

    /// Returns two arrays, at least one of them a table, in one form.
    pub fn unify_tables(&mut self, a: &Value, b: &Value, span: Span) -> Eval<(Value, Value)> {
        let (left, right) = (self.tabled(a, span)?, self.tabled(b, span)?);
        if same_shape(&left, &right) {
            return Ok((left, right));
        }
        let (left, right) = (self.rows(&left, span)?, self.rows(&right, span)?);
        let (left, right) = self.unify_values(&Value::array(left), &Value::array(right), span)?;
        Ok((self.tabled(&left, span)?, self.tabled(&right, span)?))
    }

    /// Combines rows of one shape into columns.
    fn columns_of(&mut self, mut rows: Vec<Value>, span: Span) -> Eval {
        if rows.len() > MAX_INDEXED {
            return Err(too_many_elements(rows.len(), span).into());
        }
        let mut widest = rows[0].clone();
        if !rows
            .iter()
            .all(|row| self.is_numeric(row) || self.array_len(row).is_some())
        {
            for row in &rows[1..] {
                widest = self.unify_values(&widest, row, span)?.0;
            }
            for row in &mut rows {
                // Functions are numbered in the order of the first list, which is to be the one of all rows.
                *row = self.unify_values(&widest, row, span)?.1;
            }
        }
        let part =
            |rows: &[Value], of: &dyn Fn(&Value) -> Option<Value>| rows.iter().filter_map(of).collect::<Vec<_>>();
        match &widest {
            Value::Struct { ty, fields } => {
                let mut columns = Vec::new();
                for (k, (name, _)) in fields.iter().enumerate() {
                    let parts = part(&rows, &|row| match row {
                        Value::Struct { fields, .. } => fields.get(k).map(|(_, value)| value.clone()),
                        _ => None,
                    });
                    columns.push((name.clone(), self.columns_of(parts, span)?));
                }
                Ok(Value::structure(ty.clone(), columns))
            }
            Value::Tuple(parts) => {
                let mut columns = Vec::new();
                for k in 0..parts.len() {
                    let parts = part(&rows, &|row| match row {
                        Value::Tuple(parts) => parts.get(k).cloned(),
                        _ => None,
                    });
                    columns.push(self.columns_of(parts, span)?);
                }
                Ok(Value::Tuple(columns))
            }
            Value::Enum(choice) => self.columns_of_choices(choice, &rows, span),
            Value::OneOf(_, all) => {
                let numbers = part(&rows, &|row| match row {
                    Value::OneOf(id, _) => Some(Value::Node(*id)),
                    _ => None,
                });
                let numbers = self.array_node(&Value::array(numbers), span)?;
                Ok(Value::OneOf(numbers, Rc::clone(all)))
            }
            first if self.array_len(first).is_some() => {
                let len = self.array_len(first);
                let mut inner = Vec::new();
                for row in &rows {
                    if self.array_len(row) != len {
                        return Err(unlike_rows(span).into());
                    }
                    inner.extend(self.rows(row, span)?);
                }
                if inner.is_empty() {
                    return Ok(first.clone());
                }
                let element = self.columns_of(inner, span)?;
                Ok(Table::whole(len.unwrap_or(0), element))
            }
            Value::Int(_) | Value::Node(_) => Ok(Value::Node(self.array_node(&Value::array(rows), span)?)),
            // Equal in all rows, such as a texture.
            other if rows.iter().all(|row| row == other) => Ok(other.clone()),
            other => Err(not_indexed(other, span).into()),
        }
    }

    fn columns_of_choices(&mut self, widest: &EnumValue, rows: &[Value], span: Span) -> Eval {
        let choices: Vec<&Rc<EnumValue>> = rows
            .iter()
            .filter_map(|row| match row {
                Value::Enum(choice) => Some(choice),
                _ => None,
            })
            .collect();
        let tags = choices
            .iter()
            .map(|choice| Value::Node(self.tag_node(choice)))
            .collect();
        let tag = Tag::Node(self.array_node(&Value::array(tags), span)?);
        let mut held = Vec::new();
        for (variant, fields) in widest.variants.iter().enumerate() {
            let Some(fields) = fields else {
                held.push(None);
                continue;
            };
            let mut columns = Vec::new();
            for (k, (name, _)) in fields.iter().enumerate() {
                let parts = choices
                    .iter()
                    .filter_map(|choice| choice.variant_fields(variant)?.get(k));
                let parts = parts.map(|(_, value)| value.clone()).collect();
                columns.push((name.clone(), self.columns_of(parts, span)?));
            }
            held.push(Some(columns));
        }
        Ok(Value::Enum(Rc::new(EnumValue {
            ty: widest.ty.clone(),
            tag,
            variants: held,
        })))
    }

    /// Returns an index as a node. Refuses a constant that is out of range.
    fn checked_index(&mut self, index: &Value, len: usize, span: Span) -> Eval<NodeId> {
        match self.known_int(index) {
            Some(k) if usize::try_from(k).is_ok_and(|k| k >= len) => Err(out_of_range(k, len, span).into()),
            _ => self.index_node(index, span),
        }
    }

    /// Returns an element of a table.
    pub fn row_of_table(&mut self, table: &Table, index: &Value, span: Span) -> Eval {
        let index = self.checked_index(index, table.len, span)?;
        let row = match table.from {
            Some(from) => self.builder.add(Op::Binary(BinaryOp::Add), [from, index], Type::I32),
            None => index,
        };
        Ok(self.row_at(&table.element, row))
    }

    /// Returns the values of the columns at a row.
    pub fn row_at(&mut self, columns: &Value, row: NodeId) -> Value {
        match columns {
            Value::Node(array) => Value::Node(self.number_at(*array, row)),
            Value::OneOf(array, all) => Value::OneOf(self.number_at(*array, row), Rc::clone(all)),
            Value::Struct { ty, fields } => {
                let fields = fields.iter().map(|(name, part)| (name.clone(), self.row_at(part, row)));
                let fields = fields.collect();
                Value::structure(ty.clone(), fields)
            }
            Value::Tuple(parts) => Value::Tuple(parts.iter().map(|part| self.row_at(part, row)).collect()),
            Value::Enum(choice) => {
                let mut of_row = choice.with_fields(|part| self.row_at(part, row));
                if let Tag::Node(tags) = choice.tag {
                    of_row.tag = Tag::Node(self.number_at(tags, row));
                }
                Value::Enum(Rc::new(of_row))
            }
            Value::Table(inner) => Value::Table(Rc::new(Table {
                from: Some(self.build_integer_op(BinaryOp::Mul, row, inner.len as u32)),
                ..(**inner).clone()
            })),
            other => other.clone(),
        }
    }

    fn number_at(&mut self, array: NodeId, row: NodeId) -> NodeId {
        let element = self.ty(array).element_type();
        self.builder.add(Op::ArrayGet, [array, row], element)
    }

    /// Returns a table with a part of one element replaced.
    pub fn set_in_table(&mut self, table: &Table, index: &Value, rest: &[Step], new: Value, span: Span) -> Eval {
        let row = self.checked_index(index, table.len, span)?;
        let element = self.set_row(&table.element, (row, table.len), rest, new, span)?;
        Ok(Table::whole(table.len, element))
    }

    /// Returns columns with a part of one row replaced; the row is passed with the number of rows.
    fn set_row(
        &mut self,
        columns: &Value,
        (row, count): (NodeId, usize),
        path: &[Step],
        new: Value,
        span: Span,
    ) -> Eval {
        let Some((step, rest)) = path.split_first() else {
            return self.set_whole_row(columns, (row, count), new, span);
        };
        let named = |fields: &[(Name, Value)], name: &str| fields.iter().position(|(field, _)| field == name);
        match (columns, step) {
            (Value::Struct { ty, fields }, Step::Field(name)) if named(fields, name).is_some() => {
                let mut fields = fields.to_vec();
                for (_, part) in fields.iter_mut().filter(|(field, _)| field == name) {
                    *part = self.set_row(part, (row, count), rest, new.clone(), span)?;
                }
                Ok(Value::structure(ty.clone(), fields))
            }
            (Value::Tuple(parts), Step::Field(name)) if name.parse::<usize>().is_ok_and(|k| k < parts.len()) => {
                let (mut parts, k) = (parts.clone(), name.parse().unwrap_or(0));
                parts[k] = self.set_row(&parts[k], (row, count), rest, new, span)?;
                Ok(Value::Tuple(parts))
            }
            (Value::Enum(choice), Step::VariantField(k, name))
                if choice.variant_fields(*k).is_some_and(|f| named(f, name).is_some()) =>
            {
                let mut choice = (**choice).clone();
                let fields = choice.variants[*k].iter_mut().flatten();
                for (_, part) in fields.filter(|(field, _)| field == name) {
                    *part = self.set_row(part, (row, count), rest, new.clone(), span)?;
                }
                Ok(Value::Enum(Rc::new(choice)))
            }
            (Value::Table(inner), Step::Index(index)) => {
                let index = self.checked_index(index, inner.len, span)?;
                let from = self.build_integer_op(BinaryOp::Mul, row, inner.len as u32);
                let at = self.builder.add(Op::Binary(BinaryOp::Add), [from, index], Type::I32);
                let element = self.set_row(&inner.element, (at, count * inner.len), rest, new, span)?;
                Ok(Table::whole(inner.len, element))
            }
            _ => {
                let current = self.row_at(columns, row);
                let changed = self.replace_part(current, path, new, span)?;
                self.set_whole_row(columns, (row, count), changed, span)
            }
        }
    }

    fn set_whole_row(&mut self, columns: &Value, at: (NodeId, usize), new: Value, span: Span) -> Eval {
        if is_fixed(columns) {
            return self.put_row(columns, at.0, &new, span);
        }
        // An enum with a variant that no row has had so far, or another function.
        let current = self.row_at(columns, at.0);
        let (new, wider) = self.unify_values(&new, &current, span)?;
        if same_shape(&wider, &current) {
            return self.put_row(columns, at.0, &new, span);
        }
        let mut rows = Vec::new();
        for k in 0..at.1 {
            let row = self.integer_constant(k as u32, Type::I32);
            let old = self.row_at(columns, row);
            rows.push(self.unify_values(&old, &new, span)?.0);
        }
        let columns = self.columns_of(rows, span)?;
        self.put_row(&columns, at.0, &new, span)
    }

    /// Returns columns with a row replaced by the parts of a value of the same shape.
    fn put_row(&mut self, columns: &Value, row: NodeId, new: &Value, span: Span) -> Eval {
        Ok(match (columns, new) {
            (Value::Node(array), new) => Value::Node(self.put_number(*array, row, new, span)?),
            (Value::OneOf(array, all), Value::OneOf(new, _)) => {
                Value::OneOf(self.put_number(*array, row, &Value::Node(*new), span)?, Rc::clone(all))
            }
            (Value::Struct { ty, fields }, Value::Struct { fields: parts, .. }) if fields.len() == parts.len() => {
                let mut put = Vec::new();
                for ((name, column), (_, part)) in fields.iter().zip(parts.iter()) {
                    put.push((name.clone(), self.put_row(column, row, part, span)?));
                }
                Value::structure(ty.clone(), put)
            }
            (Value::Tuple(columns), Value::Tuple(parts)) if columns.len() == parts.len() => {
                let pairs = columns.iter().zip(parts);
                let put = pairs.map(|(column, part)| self.put_row(column, row, part, span));
                Value::Tuple(put.collect::<Eval<_>>()?)
            }
            (Value::Enum(choice), Value::Enum(other)) => {
                let mut put = (**choice).clone();
                if let Tag::Node(tags) = put.tag {
                    let tag = self.tag_node(other);
                    put.tag = Tag::Node(self.put_number(tags, row, &Value::Node(tag), span)?);
                }
                for (k, fields) in put.variants.iter_mut().enumerate() {
                    let others = other.variant_fields(k).unwrap_or_default();
                    for ((_, column), (_, part)) in fields.iter_mut().flatten().zip(others) {
                        *column = self.put_row(column, row, part, span)?;
                    }
                }
                Value::Enum(Rc::new(put))
            }
            (Value::Table(inner), new) => {
                if self.array_len(new) != Some(inner.len) {
                    return Err(unlike_rows(span).into());
                }
                let from = self.build_integer_op(BinaryOp::Mul, row, inner.len as u32);
                let mut element = inner.element.clone();
                for (k, part) in self.rows(new, span)?.iter().enumerate() {
                    let at = self.build_integer_op(BinaryOp::Add, from, k as u32);
                    element = self.put_row(&element, at, part, span)?;
                }
                Table::whole(inner.len, element)
            }
            (other, _) => other.clone(),
        })
    }

    fn put_number(&mut self, array: NodeId, row: NodeId, new: &Value, span: Span) -> Eval<NodeId> {
        let current = Value::Node(self.number_at(array, row));
        let (new, _) = self.same_type(new, &current, span)?;
        let ty = self.ty(array);
        Ok(self.builder.add(Op::ArraySet, [array, row, new], ty))
    }
}

/// `true` if any value of the type fits into a row: the columns contain no enum or function.
fn is_fixed(columns: &Value) -> bool {
    match columns {
        Value::Node(_) => true,
        Value::Struct { fields, .. } => fields.iter().all(|(_, part)| is_fixed(part)),
        Value::Tuple(parts) => parts.iter().all(is_fixed),
        Value::Table(inner) => is_fixed(&inner.element),
        _ => false,
    }
}

fn unlike_rows(span: Span) -> Diagnostic {
    Diagnostic::error_at(
        Code::RuntimeIndex,
        span,
        "an array of arrays of several lengths cannot be indexed at run time",
    )
    .label("the index is a runtime value")
    .help("give its arrays one length")
}

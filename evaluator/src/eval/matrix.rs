//! Matrices: structures of columns, with glam's names and order of operations.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::instead::{Receiver, find_text};
use crate::front::name::Name;
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type};

const AXES: [&str; 4] = ["x_axis", "y_axis", "z_axis", "w_axis"];

/// Number of columns of `Mat2`, `Mat3` or `Mat4`.
pub fn column_count(ty: &str) -> Option<u8> {
    match ty {
        "Mat2" => Some(2),
        "Mat3" => Some(3),
        "Mat4" => Some(4),
        _ => None,
    }
}

/// Type that `mat2`, `mat3` or `mat4` constructs; empty for any other name.
fn made_by(name: &str) -> &'static str {
    match name {
        "mat2" => "Mat2",
        "mat3" => "Mat3",
        "mat4" => "Mat4",
        _ => "",
    }
}

/// Field names of a matrix: its columns.
pub fn axis_names(n: u8) -> &'static [&'static str] {
    &AXES[..n as usize]
}

impl Evaluator<'_> {
    /// Evaluates `Mat3::from_cols(a, b, c)`, `mat3(a, b, c)`, `Mat3::from_diagonal(d)`.
    pub fn matrix_function(&mut self, path: &[String], values: &[Value], span: Span) -> Eval<Option<Value>> {
        let (ty, name) = match path {
            [name] => (made_by(name), "from_cols"),
            [.., ty, name] => (ty.as_str(), name.as_str()),
            [] => return Ok(None),
        };
        let Some(n) = column_count(ty) else { return Ok(None) };
        let column = Type::value(Scalar::F32, n);
        match (name, values) {
            ("from_cols", columns) if columns.len() == n as usize => {
                let mut nodes = Vec::new();
                for value in columns {
                    let id = self.value_node(value, span)?;
                    if self.ty(id) != column {
                        return Err(Diagnostic::error_at(
                            Code::MismatchedTypes,
                            span,
                            format!(
                                "a column of a {ty} is a {}, not {}",
                                column.in_rust(),
                                self.ty(id).in_rust()
                            ),
                        )
                        .into());
                    }
                    nodes.push(id);
                }
                Ok(Some(matrix_value(&nodes)))
            }
            ("from_diagonal", [diagonal]) => {
                let id = self.value_node(diagonal, span)?;
                if self.ty(id) != column {
                    return Err(Diagnostic::error_at(
                        Code::MismatchedTypes,
                        span,
                        format!("the diagonal of a {ty} is a {}", column.in_rust()),
                    )
                    .into());
                }
                let lanes = self.vector_components(id);
                let zero = self.builder.f32(0.0);
                let columns: Vec<NodeId> = (0..n as usize)
                    .map(|c| {
                        let parts: Vec<_> = (0..n as usize).map(|r| if r == c { lanes[c] } else { zero }).collect();
                        self.builder.add(Op::Compose, parts, column)
                    })
                    .collect();
                Ok(Some(matrix_value(&columns)))
            }
            // A method called by its path.
            (_, [receiver @ Value::Struct { ty: of, .. }, rest @ ..]) if *of == ty => {
                self.matrix_method(receiver, name, rest, span).map(Some)
            }
            _ => Err(unknown_method(ty, name, span).into()),
        }
    }

    /// Evaluates a matrix method.
    pub fn matrix_method(&mut self, value: &Value, name: &str, args: &[Value], span: Span) -> Eval {
        let (ty, columns) = self.matrix_columns(value, span)?;
        match (name, args) {
            ("transpose", []) => {
                let rows: Vec<NodeId> = (0..columns.len())
                    .map(|r| {
                        let parts: Vec<_> = columns
                            .iter()
                            .map(|c| self.builder.add(Op::Extract(r as u8), [*c], Type::F32))
                            .collect();
                        self.builder.add(Op::Compose, parts, self.ty(columns[0]))
                    })
                    .collect();
                Ok(matrix_value(&rows))
            }
            ("col", [index]) => match self
                .known_int(index)
                .and_then(|k| columns.get(usize::try_from(k).ok()?))
            {
                Some(column) => Ok(Value::Node(*column)),
                None => {
                    let error = Diagnostic::error_at(
                        Code::RuntimeIndex,
                        span,
                        "the column of a matrix must be a compile-time constant, and one of its columns",
                    )
                    .label("a runtime value, or out of range")
                    .help(format!("columns are 0 to {}", columns.len() - 1));
                    Err(self.demand_of(&[index], error))
                }
            },
            ("mul_vec2" | "mul_vec3" | "mul_vec4", [vector]) => self.matrix_product(value, vector, span),
            ("mul_mat2" | "mul_mat3" | "mul_mat4", [other]) => self.matrix_product(value, other, span),
            // As in glam: w is 1 for a point and 0 for a direction, and the result's w is dropped.
            ("transform_point3" | "transform_vector3", [vector]) if columns.len() == 4 => {
                let vector = self.value_node(vector, span)?;
                if self.ty(vector) != Type::value(Scalar::F32, 3) {
                    return Err(
                        Diagnostic::error_at(Code::MismatchedTypes, span, format!("`{name}` takes a Vec3")).into(),
                    );
                }
                let mut sum = self.scale_column(columns[0], vector, 0);
                for k in 1..3 {
                    let term = self.scale_column(columns[k as usize], vector, k);
                    sum = self
                        .builder
                        .add(Op::Binary(BinaryOp::Add), [sum, term], Type::value(Scalar::F32, 4));
                }
                if name == "transform_point3" {
                    let whole = Type::value(Scalar::F32, 4);
                    sum = self.builder.add(Op::Binary(BinaryOp::Add), [sum, columns[3]], whole);
                }
                let lanes = self.vector_components(sum);
                let short = Type::value(Scalar::F32, 3);
                Ok(Value::Node(self.builder.add(Op::Compose, &lanes[..3], short)))
            }
            _ => Err(unknown_method(&ty, name, span).into()),
        }
    }

    /// Builds a matrix times a vector, another matrix, or a number.
    pub fn matrix_product(&mut self, left: &Value, right: &Value, span: Span) -> Eval {
        if let (Value::Node(_), Value::Struct { .. }) = (left, right) {
            return self.matrix_by_number(right, left, span);
        }
        let (ty, columns) = self.matrix_columns(left, span)?;
        match right {
            Value::Struct { .. } => {
                let (other, others) = self.matrix_columns(right, span)?;
                if other != ty {
                    return Err(
                        Diagnostic::error_at(Code::OperatorTypes, span, format!("a {ty} times a {other}")).into(),
                    );
                }
                let mut products = Vec::new();
                for column in others {
                    products.push(self.times_vector(&columns, column));
                }
                Ok(matrix_value(&products))
            }
            _ => {
                let id = self.value_node(right, span)?;
                if self.ty(id) == Type::F32 {
                    return self.matrix_by_number(left, right, span);
                }
                if self.ty(id) != self.ty(columns[0]) {
                    return Err(Diagnostic::error_at(
                        Code::OperatorTypes,
                        span,
                        format!("a {ty} times a {}", self.ty(id).in_rust()),
                    )
                    .label("of another size")
                    .help("use `.truncate()` or `.extend(...)`, or another matrix")
                    .into());
                }
                Ok(Value::Node(self.times_vector(&columns, id)))
            }
        }
    }

    fn matrix_by_number(&mut self, left: &Value, number: &Value, span: Span) -> Eval {
        let (_, columns) = self.matrix_columns(left, span)?;
        let mut products = Vec::new();
        for column in columns {
            let product = self.eval_binary(BinaryOp::Mul, &Value::Node(column), number, span)?;
            products.push(self.value_node(&product, span)?);
        }
        Ok(matrix_value(&products))
    }

    /// Builds the sum of the columns times the vector's components, first to last.
    fn times_vector(&mut self, columns: &[NodeId], vector: NodeId) -> NodeId {
        let ty = self.ty(columns[0]);
        let mut sum = self.scale_column(columns[0], vector, 0);
        for (k, column) in columns.iter().enumerate().skip(1) {
            let term = self.scale_column(*column, vector, k as u8);
            sum = self.builder.add(Op::Binary(BinaryOp::Add), [sum, term], ty);
        }
        sum
    }

    fn scale_column(&mut self, column: NodeId, vector: NodeId, lane: u8) -> NodeId {
        let ty = self.ty(column);
        let lane = self.builder.add(Op::Extract(lane), [vector], Type::F32);
        let lane = self.build_splat(lane, ty.component_count());
        self.builder.add(Op::Binary(BinaryOp::Mul), [column, lane], ty)
    }

    fn matrix_columns(&mut self, value: &Value, span: Span) -> Eval<(Name, Vec<NodeId>)> {
        match value {
            Value::Struct { ty, fields } if column_count(ty).is_some() => {
                let nodes: Eval<Vec<NodeId>> = fields.iter().map(|(_, column)| self.value_node(column, span)).collect();
                Ok((ty.clone(), nodes?))
            }
            other => Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                format!("{} where a matrix is needed", other.describe()),
            )
            .into()),
        }
    }
}

/// Matrix value with the given columns.
pub fn matrix_value(columns: &[NodeId]) -> Value {
    let named = AXES.iter().zip(columns);
    let fields = named.map(|(name, id)| ((*name).into(), Value::Node(*id)));
    Value::structure(format!("Mat{}", columns.len()), fields.collect())
}

fn unknown_method(ty: &str, name: &str, span: Span) -> Diagnostic {
    Diagnostic::error_at(
        Code::UnknownMethod,
        span,
        format!("a {ty} has no `{name}` with such arguments"),
    )
    .label("not supported")
    .help(find_text(Receiver::Matrix, name).unwrap_or_else(|| {
        "matrices have from_cols, from_diagonal, IDENTITY, x_axis .. w_axis, col, transpose, mul_vec3, \
             transform_point3, transform_vector3, and `*` with vectors, matrices and numbers"
            .to_owned()
    }))
}

//! Quads: a lane's value is a node like any other; quad swaps read the other lanes' values.
//!
//! rustc ensures that a `Quad<bool>` controls no branch, so all lanes reach every swap.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::Type as SourceType;
use crate::ir::{BinaryOp, Invocation, NodeId, Op, QuadDirection, Scalar, Type, Varying};

const PAIR: Type = Type::value(Scalar::I32, 2);

impl Evaluator<'_> {
    /// Type of a lane's value, for a `Quad`; `None` for any other type.
    pub fn lane_type<'t>(&self, ty: &'t SourceType) -> Option<&'t SourceType> {
        match ty.peel_refs() {
            SourceType::Name(name, args) if name == "Quad" && !self.library.structs.contains_key("Quad") => {
                args.first()
            }
            _ => None,
        }
    }

    /// Adds a kernel parameter with a value for each lane: the pixel, or an interpolated value.
    pub fn quad_parameter(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        let Some(SourceType::Name(lane, _)) = self.lane_type(ty) else {
            return Ok(None);
        };
        let lane = lane.as_str();
        self.builder.graph_mut().invocation = Invocation::Lane;
        if name == "pixel" && lane == "IVec2" {
            return Ok(Some(Value::Node(self.builder.add(Op::Pixel, Vec::new(), PAIR))));
        }
        let ty = match crate::ir::vector_named(lane) {
            _ if lane == "f32" => Type::F32,
            Some((Scalar::F32, lanes)) => Type::value(Scalar::F32, lanes),
            _ => {
                return Err(
                    Diagnostic::error_at(Code::KernelParameter, span, format!("`{name}` is a quad of `{lane}`, which no rasteriser interpolates"))
                        .label("not supported")
                        .help("a kernel takes `pixel: Quad<IVec2>`, and quads of f32, Vec2, Vec3 or Vec4 for what is interpolated")
                        .into(),
                );
            }
        };
        let name = &*self.input_name(name);
        let varyings = &mut self.builder.graph_mut().varyings;
        varyings.push(Varying {
            name: name.to_owned(),
            ty,
        });
        let index = varyings.len() as u32 - 1;
        Ok(Some(Value::Node(self.builder.add(Op::Varying(index), Vec::new(), ty))))
    }

    /// Evaluates a prelude function for lanes; `None` if there is none with this name.
    pub fn quad_function(&mut self, path: &[String], values: &[Value], span: Span) -> Eval<Option<Value>> {
        let (of, name) = match path {
            [.., of, name] => (of.as_str(), name.as_str()),
            [name] => ("", name.as_str()),
            [] => return Ok(None),
        };
        match (of, name, values) {
            (_, "lane_position", []) => Ok(Some(Value::Node(self.quad_lane(span)?))),
            (_, "quad_select", []) => {
                let lane = self.quad_lane(span)?;
                Ok(Some(Value::Node(self.convert_node(lane, Scalar::F32))))
            }
            (_, "quad_vector", []) => {
                let lane = self.quad_lane(span)?;
                let lane = Value::Node(self.convert_node(lane, Scalar::F32));
                let (one, two) = (Value::Node(self.builder.f32(1.0)), Value::Node(self.builder.f32(2.0)));
                let twice = self.eval_binary(BinaryOp::Mul, &lane, &two, span)?;
                let vector = self.eval_binary(BinaryOp::Sub, &twice, &one, span)?;
                self.name_value(&vector, "quad_vector", span);
                Ok(Some(vector))
            }
            ("Quad", "splat" | "from", [value]) => Ok(Some(value.clone())),
            ("Quad", "new", [lanes]) => {
                let lanes = self.array_elements(lanes, 4, span)?;
                self.of_lanes(&lanes, span).map(Some)
            }
            ("Quad", "from_xy", [x, y]) => {
                let lanes = [x, y].map(|v| self.int_or_node(v, Scalar::F32, span));
                let [x, y] = lanes;
                let pair = Type::value(Scalar::F32, 2);
                let lanes = vec![x?, y?];
                Ok(Some(Value::Node(self.builder.add(Op::Compose, lanes, pair))))
            }
            _ => Ok(None),
        }
    }

    /// Evaluates a method that only quads have; `None` if there is none with this name.
    pub fn quad_method(&mut self, receiver: &Value, name: &str, args: &[Value], span: Span) -> Eval<Option<Value>> {
        let direction = match name {
            "swap_horizontal" => Some(QuadDirection::Horizontal),
            "swap_vertical" => Some(QuadDirection::Vertical),
            "swap_diagonal" => Some(QuadDirection::Diagonal),
            _ => None,
        };
        let value = match (name, args) {
            (_, []) if direction.is_some() => {
                let x = self.value_node(receiver, span)?;
                self.build_quad_swap(direction.unwrap_or(QuadDirection::Horizontal), x, name, span)?
            }
            ("gather", []) => {
                let x = self.value_node(receiver, span)?;
                self.build_quad_gather(x, name, span)?
            }
            ("sum" | "average", []) => {
                let x = self.value_node(receiver, span)?;
                let beside = self.build_quad_swap(QuadDirection::Horizontal, x, name, span)?;
                let row = self.eval_binary(BinaryOp::Add, receiver, &beside, span)?;
                let row_node = self.value_node(&row, span)?;
                self.name_value(&row, "row", span);
                let below = self.build_quad_swap(QuadDirection::Vertical, row_node, name, span)?;
                let sum = self.eval_binary(BinaryOp::Add, &row, &below, span)?;
                if name == "sum" {
                    sum
                } else {
                    let quarter = Value::Node(self.builder.f32(0.25));
                    self.eval_binary(BinaryOp::Mul, &sum, &quarter, span)?
                }
            }
            ("lt" | "le" | "gt" | "ge" | "eq" | "ne", [other]) => {
                let op = match name {
                    "lt" => BinaryOp::Lt,
                    "le" => BinaryOp::Le,
                    "gt" => BinaryOp::Gt,
                    "ge" => BinaryOp::Ge,
                    "eq" => BinaryOp::Eq,
                    _ => BinaryOp::Ne,
                };
                self.eval_binary(op, receiver, other, span)?
            }
            ("select", [yes, no]) => {
                let condition = self.value_node(receiver, span)?;
                if self.ty(condition) != Type::BOOL {
                    return Ok(None);
                }
                let (yes, no) = self.same_type(yes, no, span)?;
                let ty = self.ty(yes);
                Value::Node(self.builder.add(Op::Select, [condition, yes, no], ty))
            }
            ("x" | "y" | "z" | "w", []) => self.value_field(receiver, name, span)?,
            ("as_f32" | "as_i32", []) => {
                let x = self.value_node(receiver, span)?;
                let kind = if name == "as_f32" { Scalar::F32 } else { Scalar::I32 };
                Value::Node(self.convert_node(x, kind))
            }
            _ => return Ok(None),
        };
        Ok(Some(value))
    }

    fn build_quad_swap(&mut self, direction: QuadDirection, x: NodeId, name: &str, span: Span) -> Eval {
        self.needs_lanes(name, span)?;
        let ty = self.ty(x);
        if ty.is_array() {
            let error = Diagnostic::error_at(
                Code::QuadMessage,
                span,
                "a message carries a number or a vector, no array",
            )
            .label("an array of a structured loop")
            .help("send its elements one by one");
            return Err(self.demand_constants(&[x], error));
        }
        Ok(Value::Node(self.builder.add(Op::QuadSwap(direction), [x], ty)))
    }

    /// Builds the lane's own value and those received horizontally, vertically and diagonally. Small values take two swaps:
    /// own and vertical value are swapped horizontally together.
    fn build_quad_gather(&mut self, x: NodeId, name: &str, span: Span) -> Eval {
        let own = Value::Node(x);
        let (Some(scalar), lanes @ (1 | 2)) = (self.ty(x).scalar_kind(), self.ty(x).component_count()) else {
            let mut all = vec![own];
            for direction in QuadDirection::ALL {
                all.push(self.build_quad_swap(direction, x, name, span)?);
            }
            return Ok(Value::array(all));
        };
        let below = self.build_quad_swap(QuadDirection::Vertical, x, name, span)?;
        let below_node = self.value_node(&below, span)?;
        let both = [x, below_node]
            .map(|value| self.take_components(value, 0..lanes))
            .concat();
        let both = self.builder.add(Op::Compose, both, Type::value(scalar, 2 * lanes));
        let heard = self.build_quad_swap(QuadDirection::Horizontal, both, name, span)?;
        self.name_value(&heard, "heard", span);
        let heard = self.value_node(&heard, span)?;
        let [beside, across] = [0..lanes, lanes..2 * lanes].map(|parts| {
            let parts = self.take_components(heard, parts);
            Value::Node(match parts[..] {
                [one] => one,
                _ => self.builder.add(Op::Compose, parts, Type::value(scalar, lanes)),
            })
        });
        Ok(Value::array(vec![own, beside, below, across]))
    }

    /// Components of a vector; a scalar as it is.
    fn take_components(&mut self, value: NodeId, lanes: std::ops::Range<u8>) -> Vec<NodeId> {
        let ty = self.ty(value);
        match (ty.is_scalar(), ty.scalar_kind()) {
            (false, Some(scalar)) => {
                let part = |lane| self.builder.add(Op::Extract(lane), [value], Type::scalar(scalar));
                lanes.map(part).collect()
            }
            _ => vec![value],
        }
    }

    fn quad_lane(&mut self, span: Span) -> Eval<NodeId> {
        self.needs_lanes("lane_position", span)?;
        let lane = self.builder.add(Op::Lane, Vec::new(), PAIR);
        self.name_value(&Value::Node(lane), "lane", span);
        Ok(lane)
    }

    fn needs_lanes(&self, name: &str, span: Span) -> Eval<()> {
        if self.builder.graph().invocation == Invocation::Lane {
            return Ok(());
        }
        Err(Diagnostic::error_at(
            Code::QuadMessage,
            span,
            format!("`{name}` is of quads, and this kernel computes one pixel"),
        )
        .label("no other lane to receive from")
        .help("take `pixel: Quad<IVec2>` and give a `Quad<Vec4>`")
        .into())
    }

    /// Selects one of four values by the lane.
    fn of_lanes(&mut self, lanes: &[Value], span: Span) -> Eval {
        let lane = self.quad_lane(span)?;
        let zero = self.builder.i32(0);
        let [right, below] = [0, 1].map(|axis| {
            let part = self.builder.add(Op::Extract(axis), [lane], Type::I32);
            self.builder.add(Op::Binary(BinaryOp::Ne), [part, zero], Type::BOOL)
        });
        let mut rows = Vec::new();
        for row in lanes.chunks(2) {
            let (left, other) = self.same_type(&row[0], &row[1], span)?;
            let ty = self.ty(left);
            let row = self.builder.add(Op::Select, [right, other, left], ty);
            rows.push(Value::Node(row));
        }
        let (upper, lower) = self.same_type(&rows[0], &rows[1], span)?;
        let ty = self.ty(upper);
        Ok(Value::Node(self.builder.add(Op::Select, [below, lower, upper], ty)))
    }
}

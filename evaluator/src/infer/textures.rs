//! Methods of textures, with the signatures that the prelude gives them.

use super::Checker;
use super::types::Ty;
use crate::front::textures::{Gives, Param, TextureType};
use crate::front::tree::Expr;
use crate::ir::{Scalar, Type};

impl<'l> Checker<'l> {
    /// The type of a method of a texture with such texels; of one that it does not have, the evaluator says so.
    pub(super) fn of_texture(&mut self, of: &TextureType, texel: &Ty, name: &str, args: &'l [Expr]) -> Ty {
        let Some(method) = of.find_method(name, args.len()) else {
            self.infer_loose_args(args);
            return Ty::Unknown;
        };
        let dimensions = of.kind.dimension_count();
        let mut result = match method.gives {
            Gives::Texel => texel.clone(),
            Gives::Four => Ty::Vector(Scalar::F32, 4),
            Gives::Share => Ty::Float,
            Gives::Size => Ty::Vector(Scalar::U32, dimensions),
            Gives::Count => Ty::USIZE,
        };
        for (param, arg) in method.params.iter().zip(args) {
            match param {
                Param::Coordinate => result = self.per_lane(arg, &vector_type(of.kind.coordinate_type()), &result),
                Param::Place if method.name == "sample_grad" => {
                    self.check_expr(arg, &vector_type(of.kind.position_type()))
                }
                Param::Place => result = self.per_lane(arg, &vector_type(of.kind.position_type()), &result),
                Param::Step(_) => self.check_expr(arg, &vector_type(of.kind.position_type())),
                Param::Layer | Param::Sample | Param::Level | Param::Component => self.check_expr(arg, &Ty::USIZE),
                Param::Detail | Param::Reference => self.check_lane_argument(arg, &Ty::Float),
                Param::Filtering => self.check_expr(arg, &Ty::Sampler.into_shared_ref()),
                Param::Comparing => self.check_expr(arg, &Ty::ComparisonSampler.into_shared_ref()),
            }
        }
        result
    }

    /// Returns the type of a read at a coordinate, or in each lane for a coordinate in each lane.
    fn per_lane(&mut self, coord: &'l Expr, wanted: &Ty, result: &Ty) -> Ty {
        let found = self.infer_expr(coord, Some(wanted));
        match self.table.resolve_shallow(&found) {
            Ty::Quad(lane) => {
                self.coerce(wanted, &lane, coord.span);
                Ty::Quad(Box::new(result.clone()))
            }
            _ => {
                self.coerce(wanted, &found, coord.span);
                result.clone()
            }
        }
    }
}

/// A vector of the graph as inference has it.
fn vector_type(ty: Type) -> Ty {
    Ty::Vector(ty.scalar_kind().unwrap_or(Scalar::F32), ty.component_count())
}

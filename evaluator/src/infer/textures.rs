//! Methods of textures, with the signatures that the prelude gives them.

use super::Checker;
use super::types::Ty;
use crate::front::textures::{Gives, Param, TextureType};
use crate::front::tree::Expr;
use crate::ir::{Scalar, Type};

impl<'l> Checker<'l> {
    /// The type of a method of a texture with such texels; of one that it does not have, the evaluator says so.
    pub(super) fn of_texture(&mut self, of: &TextureType, texel: &Ty, name: &str, args: &'l [Expr]) -> Ty {
        let Some(method) = of.method(name, args.len()) else {
            self.loose(args);
            return Ty::Unknown;
        };
        let dimensions = of.kind.dimensions();
        let mut result = match method.gives {
            Gives::Texel => texel.clone(),
            Gives::Four => Ty::Vector(Scalar::F32, 4),
            Gives::Share => Ty::Float,
            Gives::Size => Ty::Vector(Scalar::U32, dimensions),
            Gives::Count => Ty::USIZE,
        };
        for (param, arg) in method.params.iter().zip(args) {
            match param {
                Param::Coordinate => result = self.per_lane(arg, &vector(of.kind.coordinate()), &result),
                Param::Place if method.name == "sample_grad" => self.against(arg, &vector(of.kind.place())),
                Param::Place => result = self.per_lane(arg, &vector(of.kind.place()), &result),
                Param::Step(_) => self.against(arg, &vector(of.kind.place())),
                Param::Layer | Param::Sample | Param::Level | Param::Component => self.against(arg, &Ty::USIZE),
                Param::Detail | Param::Reference => self.lane(arg, &Ty::Float),
                Param::Filtering => self.against(arg, &Ty::Sampler.shared()),
                Param::Comparing => self.against(arg, &Ty::ComparisonSampler.shared()),
            }
        }
        result
    }

    /// Returns the type of a read at a coordinate, or in each lane for a coordinate in each lane.
    fn per_lane(&mut self, coord: &'l Expr, wanted: &Ty, result: &Ty) -> Ty {
        let found = self.expr(coord, Some(wanted));
        match self.table.shallow(&found) {
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
fn vector(ty: Type) -> Ty {
    Ty::Vector(ty.kind().unwrap_or(Scalar::F32), ty.components())
}

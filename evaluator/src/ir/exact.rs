//! Operations whose rounding no compiler may change.

use super::{BinaryOp, Builder, NodeId, Op, Type};

impl Builder<'_> {
    /// Starts or stops making operations on floats exact.
    pub fn set_exact(&mut self, exact: bool) {
        self.exact = exact;
    }

    /// `true` while operations on floats are made exact.
    pub fn is_exact(&self) -> bool {
        self.exact
    }

    /// Adds an operation on floats with each of its roundings marked as exact. A dot or cross product is expanded into
    /// products and sums, first to last, because shader languages leave their order open.
    pub fn add_exact(&mut self, op: Op, args: &[NodeId], ty: Type) -> NodeId {
        match op {
            Op::Dot => {
                let of = self.graph().ty(args[0]);
                let product = self.add_marked(Op::Binary(BinaryOp::Mul), args, of);
                let mut lanes = (0..of.component_count()).map(Op::Extract);
                let first = lanes.next().map(|lane| self.add_simplified(lane, [product], ty));
                let first = first.expect("a vector has components");
                lanes.fold(first, |sum, lane| {
                    let lane = self.add_simplified(lane, [product], ty);
                    self.add_marked(Op::Binary(BinaryOp::Add), &[sum, lane], ty)
                })
            }
            Op::Cross => {
                let turned = |b: &mut Self, of: NodeId, turn: [u8; 3]| {
                    let lanes = turn.map(|lane| b.add_simplified(Op::Extract(lane), [of], Type::F32));
                    b.add_simplified(Op::Compose, lanes, ty)
                };
                let (next, last) = ([1, 2, 0], [2, 0, 1]);
                let products = [(next, last), (last, next)].map(|(first, second)| {
                    let sides = [turned(self, args[0], first), turned(self, args[1], second)];
                    self.add_marked(Op::Binary(BinaryOp::Mul), &sides, ty)
                });
                self.add_marked(Op::Binary(BinaryOp::Sub), &products, ty)
            }
            op => self.add_marked(op, args, ty),
        }
    }

    fn add_marked(&mut self, op: Op, args: &[NodeId], ty: Type) -> NodeId {
        let id = self.add_simplified(op, args, ty);
        match self.graph().node(id).op.is_rounding() {
            true => self.intern(Op::Exact, [id], ty),
            false => id,
        }
    }
}

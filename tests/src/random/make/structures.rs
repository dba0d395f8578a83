//! Structures with constants, constructors and methods.

use super::orders::Order;
use super::types::{Param, Signature, Structure, Ty};
use super::{Feature, Hold, Maker, Want};

impl Maker {
    pub(super) fn structure(&mut self) {
        let name = self.fresh("S");
        let copy = self.random.below(4) > 0;
        let tuple = self.random.once_in(4);
        let count = self.random.between(1, 3);
        let fields: Vec<(String, Ty)> = (0..count)
            .map(|k| {
                let ty = if k == 0 { self.plain_type() } else { self.part_type() };
                (if tuple { k.to_string() } else { format!("f{k}") }, ty)
            })
            .collect();
        let parts: Vec<Ty> = fields.iter().map(|(_, ty)| ty.clone()).collect();
        let order = self.chosen_order(&parts);
        let mut derived = if copy { vec!["Clone", "Copy"] } else { Vec::new() };
        derived.extend(order.derived());
        if !derived.is_empty() {
            self.line(format!("#[derive({})]", derived.join(", ")));
        }
        if tuple {
            let fields: Vec<String> = fields.iter().map(|(_, ty)| self.ty(ty)).collect();
            self.line(format!("struct {name}({});", fields.join(", ")));
        } else {
            self.open(format!("struct {name} {{"));
            for (field, ty) in &fields {
                let text = format!("{field}: {},", self.ty(ty));
                self.line(text);
            }
            self.close("}");
        }
        self.structures.push(Structure {
            name,
            fields,
            tuple,
            copy,
            operators: false,
            order,
        });
        if order == Order::None && copy && self.chance(Feature::Orders, 3) {
            self.order_by_hand();
        }
    }

    pub(super) fn methods(&mut self, k: usize) {
        let name = self.structures[k].name.clone();
        self.locals.clear();
        self.inputs = false;
        self.open(format!("impl {name} {{"));
        if self.random.once_in(3) && self.structures[k].copy {
            let constant = self.fresh("K");
            let want = Want {
                depth: 0,
                known: true,
                inferred: true,
            };
            // Enums are not compared in constants.
            let enumerations = std::mem::take(&mut self.enumerations);
            let value = self.leaf(&Ty::Struct(k), want);
            self.enumerations = enumerations;
            self.line(format!("const {constant}: Self = {value};"));
            self.constants
                .push((format!("{name}::{constant}"), Ty::Struct(k), None));
        }
        if self.random.once_in(2) {
            let function = self.fresh("make");
            let fields = self.structures[k].fields.clone();
            let params: Vec<String> = fields
                .iter()
                .enumerate()
                .map(|(n, (_, ty))| format!("n{n}: {}", self.ty(ty)))
                .collect();
            let values: Vec<String> = (0..fields.len()).map(|n| format!("n{n}")).collect();
            let value = if self.structures[k].tuple {
                format!("{name}({})", values.join(", "))
            } else {
                let pairs: Vec<String> = fields
                    .iter()
                    .zip(&values)
                    .map(|((f, _), v)| format!("{f}: {v}"))
                    .collect();
                format!("Self {{ {} }}", pairs.join(", "))
            };
            self.line(format!("fn {function}({}) -> Self {{ {value} }}", params.join(", ")));
            let params = fields.iter().enumerate().map(|(n, (_, ty))| Param {
                name: format!("n{n}"),
                ty: ty.clone(),
                hold: Hold::Value,
                known: None,
            });
            let params = params.collect();
            self.signatures.push(Signature {
                name: format!("{name}::{function}"),
                receiver: None,
                inputs: false,
                params,
                result: Some(Ty::Struct(k)),
                known: false,
                cost: 1,
            });
        }
        for _ in 0..1 + self.random.below(2) {
            let hold = match self.random.below(5) {
                0 if self.structures[k].copy => Hold::Value,
                0 | 1 => Hold::Shared,
                _ if self.on(Feature::Mutable) => Hold::Mutable,
                _ => Hold::Shared,
            };
            self.function(Some((Ty::Struct(k), hold)));
        }
        self.close("}");
    }
}

//! Orders of structures, tuples, arrays, enums and options, and discriminants of enums.

use super::types::Ty;
use super::{Feature, Maker, Want};

/// Operators that order the values of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// None.
    None,
    /// `<` and its like.
    Partial,
    /// These, and `max`, `min` and `cmp`.
    Total,
}

impl Order {
    /// Traits to derive.
    pub fn derived(self) -> &'static [&'static str] {
        match self {
            Order::None => &[],
            Order::Partial => &["PartialEq", "PartialOrd"],
            Order::Total => &["PartialEq", "Eq", "PartialOrd", "Ord"],
        }
    }
}

impl Maker {
    /// The order of a type's values.
    fn order(&self, ty: &Ty) -> Order {
        match ty {
            Ty::Bool | Ty::I32 | Ty::U32 | Ty::Usize => Order::Total,
            Ty::F32 => Order::Partial,
            Ty::Vec(..) | Ty::Mat(_) => Order::None,
            Ty::Array(of, _) | Ty::Option(of) => self.order(of),
            Ty::Tuple(parts) => parts.iter().map(|part| self.order(part)).min().unwrap_or(Order::Total),
            Ty::Struct(k) => self.structures[*k].order,
            Ty::Enum(k) => self.enumerations[*k].order,
            Ty::Choice(k) => self.choices[*k].order,
        }
    }

    /// The order that a new type of some parts derives.
    pub(super) fn chosen_order(&mut self, parts: &[Ty]) -> Order {
        let most = parts.iter().map(|part| self.order(part)).min().unwrap_or(Order::Total);
        match self.chance(Feature::Orders, 2) {
            true => most,
            false => Order::None,
        }
    }

    /// Implements the order of the last structure by its first field, from the largest to the smallest.
    pub(super) fn order_by_hand(&mut self) {
        let k = self.structures.len() - 1;
        let s = self.structures[k].clone();
        let (field, ty) = &s.fields[0];
        let order = self.order(ty);
        let name = &s.name;
        let (eq, ordering) = ("fn eq(&self, o: &Self) -> bool", "std::cmp::Ordering");
        match order {
            Order::None => return,
            Order::Partial => {
                self.line(format!(
                    "impl PartialEq for {name} {{ {eq} {{ self.{field} == o.{field} }} }}"
                ));
                self.line(format!(
                    "impl PartialOrd for {name} {{ fn partial_cmp(&self, o: &Self) -> Option<{ordering}> {{ \
                     o.{field}.partial_cmp(&self.{field}) }} }}"
                ));
            }
            Order::Total => {
                self.line(format!(
                    "impl PartialEq for {name} {{ {eq} {{ self.{field} == o.{field} }} }}"
                ));
                self.line(format!("impl Eq for {name} {{}}"));
                self.line(format!(
                    "impl Ord for {name} {{ fn cmp(&self, o: &Self) -> {ordering} {{ o.{field}.cmp(&self.{field}) }} }}"
                ));
                self.line(format!(
                    "impl PartialOrd for {name} {{ fn partial_cmp(&self, o: &Self) -> Option<{ordering}> {{ \
                     Some(self.cmp(o)) }} }}"
                ));
            }
        }
        self.structures[k].order = order;
    }

    /// A type with at least an order; structures and enums first.
    fn ordered_type(&mut self, least: Order) -> Ty {
        let structures = (0..self.structures.len()).map(Ty::Struct);
        let enumerations = (0..self.enumerations.len()).map(Ty::Enum);
        let choices = (0..self.choices.len()).map(Ty::Choice);
        let mut all: Vec<Ty> = structures.chain(enumerations).chain(choices).collect();
        all.retain(|ty| self.order(ty) >= least);
        if !all.is_empty() && self.random.below(3) > 0 {
            return self.random.pick(&all);
        }
        let parts = [Ty::I32, Ty::U32, Ty::Bool, Ty::F32];
        let parts = &parts[..if least == Order::Total { 3 } else { 4 }];
        match self.random.below(3) {
            0 => Ty::Tuple(vec![self.random.pick(parts), self.random.pick(parts)]),
            1 => Ty::array(self.random.pick(&parts[..2]), 2),
            _ => Ty::Option(Box::new(self.random.pick(&parts[..2]))),
        }
    }

    /// Two values that are ordered as wholes.
    pub(super) fn ordered(&mut self, want: Want) -> String {
        let d = want.deeper();
        let total = self.random.once_in(3);
        let ty = self.ordered_type(if total { Order::Total } else { Order::Partial });
        let (a, b) = (
            self.ordered_value(&ty, d.inferred(false)),
            self.ordered_value(&ty, d.inferred(true)),
        );
        let op = self.random.pick(&["<", "<=", ">", ">="]);
        if total && self.random.once_in(2) {
            return match self.random.below(3) {
                0 => format!("(match ({a}).cmp(&({b})) {{ std::cmp::Ordering::Less => true, _ => false }})"),
                1 => format!("({a}).cmp(&({b})).is_ge()"),
                _ => format!("(({a}).partial_cmp(&({b})) == Some(std::cmp::Ordering::Less))"),
            };
        }
        format!("(({a}) {op} ({b}))")
    }

    /// A value of a type that is ordered. That of an enum is a runtime value.
    fn ordered_value(&mut self, ty: &Ty, want: Want) -> String {
        match ty {
            Ty::Enum(k) => self.enum_at_run_time(*k, want),
            _ => self.expr(ty, want),
        }
    }

    /// The larger or the smaller of two structures, tuples, arrays, enums or options.
    pub(super) fn largest(&mut self, ty: &Ty, want: Want) -> Option<String> {
        let whole = matches!(
            ty,
            Ty::Struct(_) | Ty::Tuple(_) | Ty::Array(..) | Ty::Option(_) | Ty::Choice(_)
        );
        let empty = *ty == Ty::Tuple(Vec::new());
        if !whole || empty || !self.on(Feature::Orders) || self.order(ty) != Order::Total || want.depth == 0 {
            return None;
        }
        let d = want.deeper();
        let (a, b) = (self.expr(ty, d.inferred(false)), self.expr(ty, d.inferred(true)));
        Some(match self.random.below(3) {
            0 => format!("({a}).max({b})"),
            1 => format!("({a}).min({b})"),
            _ => format!("std::cmp::max({a}, {b})"),
        })
    }

    /// Variants with a discriminant each, with one for the first, or with none.
    pub(super) fn discriminants(&mut self, variants: &[String]) -> Vec<String> {
        if !self.on(Feature::Orders) || self.random.once_in(2) {
            return variants.to_vec();
        }
        let all = self.random.once_in(2);
        let first = self.random.between(-3, 6);
        // Each is smaller than the one before.
        let stated = variants.iter().enumerate().map(|(k, name)| match all || k == 0 {
            true => format!("{name} = {}", first - 2 * k as i64),
            false => name.clone(),
        });
        stated.collect()
    }

    /// A value of an enum that is a runtime value.
    fn enum_at_run_time(&mut self, k: usize, want: Want) -> String {
        let e = self.enumerations[k].clone();
        let [a, b] = [0, 1].map(|_| format!("{}::{}", e.name, self.random.pick(&e.variants)));
        if self.random.once_in(2) {
            return format!("(if {} {{ {a} }} else {{ {b} }})", self.condition(want));
        }
        format!("[{a}, {b}, {a}][{}]", self.index(3, false, want.depth.min(1)))
    }

    /// The discriminant of an enum's value.
    pub(super) fn discriminant(&mut self, ty: &Ty, want: Want) -> Option<String> {
        if self.enumerations.is_empty() || !self.on(Feature::Orders) || want.depth == 0 {
            return None;
        }
        let k = self.random.below(self.enumerations.len());
        let value = self.enum_at_run_time(k, want.deeper().inferred(false));
        Some(format!("({value} as {})", self.ty(ty)))
    }
}

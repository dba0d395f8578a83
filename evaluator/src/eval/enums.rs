//! Values of enums. The variant may be a runtime value, the tag. The value then holds the fields of every possible
//! variant, one slot per variant; slots of inactive variants are undefined.

use super::Evaluator;
use super::control::Tail;
use super::value::{Eval, Exit, Jump, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::name::Name;
use crate::front::tree::{Enum, Expr, ExprKind};
use crate::ir::{BinaryOp, NodeId, Op, Type, UnaryOp};
use crate::policy::Branches;
use std::rc::Rc;

/// A value of an enum.
#[derive(Clone, Debug, PartialEq)]
pub struct EnumValue {
    /// The enum.
    pub ty: Name,
    /// Tag of the variant.
    pub tag: Tag,
    /// Fields of each variant by name; `None` for a variant that is known to be impossible.
    pub variants: Vec<Option<Vec<(Name, Value)>>>,
}

/// Tag of a value's variant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tag {
    /// The variant at this position.
    Known(usize),
    /// A runtime value: for an enum of two variants, `true` for the second; otherwise the position as an `i32`.
    Node(NodeId),
}

impl EnumValue {
    /// Returns a value whose variant is known.
    pub fn with_variant(ty: impl Into<Name>, definition: &Enum, variant: usize, fields: Vec<(Name, Value)>) -> Value {
        let mut held = vec![None; definition.variants.len()];
        held[variant] = Some(fields);
        Value::Enum(Rc::new(EnumValue {
            ty: ty.into(),
            tag: Tag::Known(variant),
            variants: held,
        }))
    }

    /// Returns the fields of the variant at a position, if that variant is possible.
    pub fn variant_fields(&self, variant: usize) -> Option<&[(Name, Value)]> {
        self.variants.get(variant)?.as_deref()
    }

    /// Returns the fields of all possible variants.
    pub fn all_fields(&self) -> impl Iterator<Item = &(Name, Value)> {
        self.variants.iter().flatten().flatten()
    }

    /// `true` if the value holds more than a known variant: numbers or other values.
    pub fn names_something(&self) -> bool {
        matches!(self.tag, Tag::Node(_)) || self.all_fields().next().is_some()
    }

    /// Returns a copy with every field mapped by `change`.
    pub fn with_fields(&self, mut change: impl FnMut(&Value) -> Value) -> EnumValue {
        let one = |(name, value): &(Name, Value)| (name.clone(), change(value));
        let mut one = one;
        let held = self
            .variants
            .iter()
            .map(|fields| fields.as_ref().map(|fields| fields.iter().map(&mut one).collect()));
        EnumValue {
            ty: self.ty.clone(),
            tag: self.tag,
            variants: held.collect(),
        }
    }
}

impl Evaluator<'_> {
    /// Returns the variant of a value, if known.
    pub fn known_variant(&self, choice: &EnumValue) -> Option<usize> {
        let known = match choice.tag {
            Tag::Known(k) => Some(k),
            Tag::Node(id) => self.builder.graph().constant_bits(id).map(|bits| bits[0] as usize),
        };
        known.or_else(|| {
            let mut possible = (0..choice.variants.len()).filter(|k| choice.variants[*k].is_some());
            possible.next().filter(|_| possible.next().is_none())
        })
    }

    /// Returns the tag as a node.
    pub fn tag_node(&mut self, choice: &EnumValue) -> NodeId {
        match choice.tag {
            Tag::Node(id) => id,
            Tag::Known(k) if choice.variants.len() == 2 => self.builder.bool(k == 1),
            Tag::Known(k) => self.builder.i32(k as i32),
        }
    }

    /// Returns the condition that a value is the variant at a position.
    pub fn is_variant(&mut self, choice: &EnumValue, variant: usize) -> NodeId {
        if let Some(known) = self.known_variant(choice) {
            return self.builder.bool(known == variant);
        }
        if choice.variants.get(variant).is_none_or(Option::is_none) {
            return self.builder.bool(false);
        }
        let tag = self.tag_node(choice);
        if choice.variants.len() == 2 {
            return if variant == 1 { tag } else { self.not(tag) };
        }
        let wanted = self.builder.i32(variant as i32);
        self.builder.add(Op::Binary(BinaryOp::Eq), [tag, wanted], Type::BOOL)
    }

    /// Returns the discriminants of an enum's variants: each is stated, or the one before it plus 1.
    fn discriminants(&mut self, definition: &Enum, span: Span) -> Eval<Vec<i64>> {
        let mut found: Vec<i64> = Vec::new();
        for variant in &definition.variants {
            let discriminant = match &variant.discriminant {
                Some(stated) => {
                    // A number without a type, whose sign would be one of a `usize`.
                    let (sign, number) = match &stated.kind {
                        ExprKind::Unary(UnaryOp::Neg, number) => (-1, &**number),
                        _ => (1, stated),
                    };
                    let value = self.eval_value(number)?;
                    let known = self.as_constant(&value).ok_or_else(|| {
                        Diagnostic::error_at(Code::RuntimeValue, stated.span, "a discriminant is a constant integer")
                            .label("a runtime value")
                    })?;
                    sign * known
                }
                None => found.last().map_or(0, |last| last + 1),
            };
            if let Some(k) = found.iter().position(|known| *known == discriminant) {
                let (first, second) = (&definition.variants[k].name, &variant.name);
                let message = format!("`{first}` and `{second}` both have the discriminant {discriminant}");
                return Err(Diagnostic::error_at(Code::DefinedTwice, span, message)
                    .label("cast here")
                    .help(format!("give `{second}` another one"))
                    .into());
            }
            found.push(discriminant);
        }
        Ok(found)
    }

    /// Returns the discriminant of a value as an `i32`.
    pub fn discriminant_of(&mut self, choice: &EnumValue, span: Span) -> Eval {
        let library = self.library;
        let Some(definition) = library.enums.get(choice.ty.as_str()) else {
            return Err(Exit::Noted);
        };
        let discriminants = self.discriminants(definition, span)?;
        let number = |k: usize| discriminants.get(k).copied().unwrap_or_default() as i32;
        if let Some(k) = self.known_variant(choice) {
            return Ok(Value::Node(self.builder.i32(number(k))));
        }
        let tag = self.tag_node(choice);
        if discriminants.len() > 2 && (0..discriminants.len()).all(|k| number(k) == k as i32) {
            return Ok(Value::Node(tag));
        }
        let mut result = self.builder.i32(number(discriminants.len() - 1));
        for k in (0..discriminants.len() - 1).rev() {
            let (is, own) = (self.is_variant(choice, k), self.builder.i32(number(k)));
            result = self.builder.add(Op::Select, [is, own, result], Type::I32);
        }
        Ok(Value::Node(result))
    }

    /// Returns the variant named by a path, with its fields; `None` for any other path. Fails if the number of values
    /// is wrong.
    pub fn variant_of(&mut self, path: &[String], values: Vec<Value>, span: Span) -> Eval<Option<Value>> {
        let library = self.library;
        let Some((ty, k, variant)) = library.find_variant(path) else {
            return Ok(None);
        };
        if variant.fields.len() != values.len() {
            let (wanted, found) = (variant.fields.len(), values.len());
            let plural = if wanted == 1 { "" } else { "s" };
            return Err(Diagnostic::error_at(
                Code::ArgumentCount,
                span,
                format!("`{}` takes {wanted} argument{plural}, not {found}", path.join("::")),
            )
            .label("made here")
            .into());
        }
        let mut fields = Vec::new();
        for ((name, ty, _), value) in variant.fields.iter().zip(values) {
            fields.push((name.clone(), self.ascribe_type(value, Some(ty), span)?));
        }
        Ok(Some(EnumValue::with_variant(ty, &library.enums[ty], k, fields)))
    }

    /// Returns two values of one enum in one shape, in which every variant that either value may be is possible.
    pub fn agree_choices(&mut self, a: &EnumValue, b: &EnumValue, span: Span) -> Eval<(Value, Value)> {
        let (mut left, mut right) = (a.clone(), b.clone());
        if a.tag != b.tag {
            left.tag = Tag::Node(self.tag_node(a));
            right.tag = Tag::Node(self.tag_node(b));
        }
        for (x, y) in left.variants.iter_mut().zip(&mut right.variants) {
            match (x.as_mut(), y.as_mut()) {
                (Some(x), Some(y)) => {
                    for ((_, x), (_, y)) in x.iter_mut().zip(y) {
                        (*x, *y) = self.unify_values(x, y, span)?;
                    }
                }
                (Some(x), None) => *y = Some(self.blank_fields(x)),
                (None, Some(y)) => *x = Some(self.blank_fields(y)),
                (None, None) => {}
            }
        }
        Ok((Value::Enum(Rc::new(left)), Value::Enum(Rc::new(right))))
    }

    fn blank_fields(&mut self, fields: &[(Name, Value)]) -> Vec<(Name, Value)> {
        let each = fields
            .iter()
            .map(|(name, value)| (name.clone(), self.undef_like(value)));
        each.collect()
    }

    /// Returns the condition that two values of one type are equal, part by part, like `#[derive(PartialEq)]`. `None`
    /// unless they are structures, tuples, arrays or enums.
    pub fn values_equal(&mut self, a: &Value, b: &Value, span: Span) -> Eval<Option<NodeId>> {
        if let (Value::Enum(a), Value::Enum(b)) = (a, b)
            && a.ty == b.ty
        {
            return self.equal_choices(a, b, span).map(Some);
        }
        match self.pair_parts(a, b, span)? {
            Some(pairs) => self.all_equal(pairs, span).map(Some),
            None => Ok(None),
        }
    }

    /// Returns the parts of two structures, tuples or arrays in pairs.
    pub fn pair_parts(&mut self, a: &Value, b: &Value, span: Span) -> Eval<Option<Vec<(Value, Value)>>> {
        Ok(match (a, b) {
            (
                Value::Struct { ty, fields },
                Value::Struct {
                    ty: other,
                    fields: others,
                },
            ) if ty == other => {
                let pairs = fields.iter().zip(others.iter());
                Some(pairs.map(|((_, a), (_, b))| (a.clone(), b.clone())).collect())
            }
            (Value::Tuple(a), Value::Tuple(b)) if a.len() == b.len() => {
                Some(a.iter().cloned().zip(b.iter().cloned()).collect())
            }
            (Value::Array(_) | Value::Table(_), _) | (_, Value::Array(_) | Value::Table(_)) => {
                let (a, b) = (self.listed_array(a, span)?, self.listed_array(b, span)?);
                if a.len() != b.len() {
                    return Ok(None);
                }
                Some(a.into_iter().zip(b).collect())
            }
            (Value::Node(x), Value::Node(y)) if self.ty(*x).is_array() && self.ty(*y).is_array() => {
                let (a, b) = (self.listed_array(a, span)?, self.listed_array(b, span)?);
                Some(a.into_iter().zip(b).collect())
            }
            _ => None,
        })
    }

    fn all_equal(&mut self, pairs: Vec<(Value, Value)>, span: Span) -> Eval<NodeId> {
        let mut all = self.builder.bool(true);
        for (a, b) in pairs {
            if self.known_bool(all) == Some(false) {
                break;
            }
            // Arguments of one type are equal.
            if matches!(&a, Value::Const(_) | Value::Type(_)) {
                continue;
            }
            let same = self.eval_binary(BinaryOp::Eq, &a, &b, span)?;
            let same = self.value_node(&same, span)?;
            all = self.and(all, same);
        }
        Ok(all)
    }

    fn equal_choices(&mut self, a: &EnumValue, b: &EnumValue, span: Span) -> Eval<NodeId> {
        let mut any = self.builder.bool(false);
        for (both, pairs) in self.common_variants(a, b) {
            let fields = self.all_equal(pairs, span)?;
            let same = self.and(both, fields);
            any = self.or(any, same);
        }
        Ok(any)
    }

    /// Returns the variants that two values may both be: the condition that they are, and their fields in pairs.
    pub fn common_variants(&mut self, a: &EnumValue, b: &EnumValue) -> Vec<(NodeId, Vec<(Value, Value)>)> {
        let mut found = Vec::new();
        for k in 0..a.variants.len() {
            let (Some(x), Some(y)) = (a.variant_fields(k), b.variant_fields(k)) else {
                continue;
            };
            let (of_a, of_b) = (self.is_variant(a, k), self.is_variant(b, k));
            let both = self.and(of_a, of_b);
            if self.known_bool(both) != Some(false) {
                let pairs = x.iter().zip(y).map(|((_, x), (_, y))| (x.clone(), y.clone()));
                found.push((both, pairs.collect()));
            }
        }
        found
    }

    fn listed_array(&mut self, value: &Value, span: Span) -> Eval<Vec<Value>> {
        let len = self.array_len(value).unwrap_or(0);
        self.array_elements(value, len, span)
    }

    /// Evaluates `value?`.
    pub fn eval_try(&mut self, value: &Expr, span: Span) -> Eval {
        let found = self.eval_value(value)?;
        let Value::Enum(choice) = &found else {
            return match found {
                Value::Poison => Err(Exit::Noted),
                other => Err(Diagnostic::error_at(
                    Code::QuestionMark,
                    span,
                    format!(
                        "the `?` operator on {}, which is neither an `Option` nor a `Result`",
                        other.describe()
                    ),
                )
                .label("not an `Option`")
                .help("leave out the `?`")
                .into()),
            };
        };
        let good = usize::from(choice.ty == "Option");
        let holds = self.is_variant(choice, good);
        let inside = choice
            .variant_fields(good)
            .and_then(<[_]>::first)
            .map(|(_, value)| value.clone());
        let library = self.library;
        let other = EnumValue::with_variant(
            &choice.ty,
            &library.enums[&*choice.ty],
            1 - good,
            choice.variant_fields(1 - good).unwrap_or_default().to_vec(),
        );
        match (self.known_bool(holds), inside) {
            (Some(true), Some(inside)) => Ok(inside),
            (None, Some(inside)) => {
                let keep = self.keeps_exits(None::<Branches>);
                let leave = |_: &mut Self| Err(Exit::Left(Jump::Return(other)));
                self.eval_branch(Tail::Open, holds, keep, span, |_| Ok(inside), leave)
            }
            _ => Err(Exit::Left(Jump::Return(other))),
        }
    }

    /// Evaluates `unwrap()` or `expect(..)` on a value known to hold something.
    pub fn eval_unwrap(&mut self, choice: &EnumValue, name: &str, span: Span) -> Eval {
        let good = usize::from(choice.ty == "Option");
        let empty = if choice.ty == "Option" { "None" } else { "Err" };
        let inside = choice
            .variant_fields(good)
            .and_then(<[_]>::first)
            .map(|(_, value)| value.clone());
        match (self.known_variant(choice), inside) {
            (Some(k), Some(inside)) if k == good => Ok(inside),
            (Some(_), _) => {
                Err(
                    Diagnostic::error_at(Code::Unwrap, span, format!("`{name}` of what is always `{empty}`"))
                        .label("Rust panics here")
                        .help("give what is to be there instead: `unwrap_or(..)`")
                        .into(),
                )
            }
            (None, _) => {
                let error = Diagnostic::error_at(
                    Code::Unwrap,
                    span,
                    format!("`{name}` of what may be `{empty}` at run time"),
                )
                .label("Rust would panic for some pixels, and a shader has no way to fail")
                .help("give what is to be there instead with `unwrap_or(..)`, or take it apart with `if let`");
                let tag = match choice.tag {
                    Tag::Node(tag) => vec![tag],
                    Tag::Known(_) => Vec::new(),
                };
                Err(self.demand_constants(&tag, error))
            }
        }
    }

    /// Returns the names of the numbers in a value of an enum, derived from the name of the whole: the tag, and the
    /// fields of each variant.
    pub fn choice_names(&self, choice: &EnumValue, name: &str) -> EnumNames {
        let library = self.library;
        let variants: Vec<&str> = match library.enums.get(&*choice.ty) {
            Some(known) => known.variants.iter().map(|variant| variant.name.as_str()).collect(),
            None => self.implementers.clone(),
        };
        let tag = match choice.tag {
            Tag::Known(_) => None,
            Tag::Node(id) => Some((
                id,
                match variants.as_slice() {
                    [_, second] => format!("{name}_is_{}", to_snake_case(second)),
                    _ => format!("{name}_kind"),
                },
            )),
        };
        let mut inside = Vec::new();
        for (variant, fields) in variants.iter().zip(&choice.variants) {
            for (field, value) in fields.iter().flatten() {
                let only = choice
                    .variants
                    .iter()
                    .flatten()
                    .filter(|fields| !fields.is_empty())
                    .count()
                    == 1
                    && fields.iter().flatten().count() == 1;
                let name = match (only, field.parse::<usize>().is_ok(), fields.iter().flatten().count()) {
                    (true, ..) => name.to_owned(),
                    (false, true, 1) => format!("{name}_{}", to_snake_case(variant)),
                    (false, _, _) => format!("{name}_{}_{field}", to_snake_case(variant)),
                };
                inside.push((value.clone(), name));
            }
        }
        (tag, inside)
    }
}

/// The tag with its name if it is a node, and values with their names.
type EnumNames = (Option<(NodeId, String)>, Vec<(Value, String)>);

/// Converts `TwoWords` to `two_words`.
fn to_snake_case(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !out.is_empty() {
            out.push('_');
        }
        out.push(c.to_ascii_lowercase());
    }
    out
}

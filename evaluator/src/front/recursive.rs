//! Types that hold themselves, which have no size.

use super::library::Library;
use super::tree::Type;
use crate::diagnostic::{Code, Diagnostic, Span};

/// An error for each type that holds itself, directly or through others: rustc's E0072.
pub fn check_recursive_types(library: &Library) -> Vec<Diagnostic> {
    let mut names: Vec<&String> = library.structs.keys().chain(library.enums.keys()).collect();
    names.sort_unstable();
    let found = names.into_iter().filter_map(|name| {
        let at = find_holding_field(library, name, name, &mut Vec::new())?;
        Some(
            Diagnostic::error_at(
                Code::EndlessDefinition,
                at,
                format!("recursive type `{name}` has infinite size"),
            )
            .label("it holds itself here")
            .help("keep the other one's index"),
        )
    });
    found.collect()
}

/// Finds the field through which a type holds a type of the name `wanted`: the place of the type's own field.
fn find_holding_field(library: &Library, name: &str, wanted: &str, seen: &mut Vec<String>) -> Option<Span> {
    if seen.iter().any(|other| other == name) {
        return None;
    }
    seen.push(name.to_owned());
    let fields = library.structs.get(name).map(|of| &of.fields).into_iter();
    let variants = library.enums.get(name).into_iter().flat_map(|of| &of.variants);
    let mut fields = fields.chain(variants.map(|variant| &variant.fields)).flatten();
    fields.find_map(|(_, ty, at)| {
        let mut named = Vec::new();
        names_in(ty, &mut named);
        let found = named
            .iter()
            .any(|inner| inner == wanted || find_holding_field(library, inner, wanted, seen).is_some());
        found.then_some(*at)
    })
}

/// The types that a value of a type holds, by name.
fn names_in(ty: &Type, out: &mut Vec<String>) {
    match ty {
        Type::Name(name, args) => {
            out.push(name.clone());
            args.iter().for_each(|arg| names_in(arg, out));
        }
        Type::Array(element, _) => names_in(element, out),
        Type::Tuple(parts) => parts.iter().for_each(|part| names_in(part, out)),
        Type::Ref(..) | Type::Fn(..) | Type::Const(_) => {}
    }
}

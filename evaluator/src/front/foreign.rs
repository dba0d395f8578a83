//! Items that are not part of the kernel language, noted by their names, and names from texts that are not given.

use super::check::Check;
use super::items::Items;
use super::library::Library;
use super::textures::TextureType;

use crate::diagnostic::{Code, Diagnostic, Span};
use ::std::collections::HashSet;
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;

/// Crates whose names the evaluator knows.
const FOREIGN: [&str; 5] = ["std", "core", "alloc", "glam", "straightline_kernels"];

/// A name that a `use` brings in.
pub struct Import {
    /// First segment of its path.
    root: String,
    /// The segment before the name: an enum, of one of its variants.
    of: String,
    /// `true` if it comes from a module `prelude`.
    prelude: bool,
    /// The name there, and the name here.
    name: (String, String),
    span: Span,
}

impl Import {
    /// Returns whether the import brings in this name.
    pub fn brings(&self, name: &str) -> bool {
        self.name.1 == name
    }

    /// The name that the import brings in, unless the kernel's files define it.
    pub fn unknown_name(&self, library: &Library) -> Option<&str> {
        let here = self.name.1.as_str();
        let known = library.functions.contains_key(here) || library.consts.contains_key(here);
        (!known).then_some(here)
    }

    /// The name that the import brings in from Rust, glam or the prelude, which other modules may import from this one.
    pub fn foreign_name(&self) -> Option<&str> {
        let is_foreign = FOREIGN.contains(&self.root.as_str()) || self.prelude;
        is_foreign.then_some(self.name.1.as_str())
    }

    /// The name and why the kernel may not use it, if what it stands for is neither in the kernel's files nor among the names
    /// that they import from elsewhere.
    pub fn missing_error(self, library: &Library, elsewhere: &HashSet<String>) -> Option<(String, Diagnostic)> {
        let (there, here) = self.name;
        // A module of these files that is named has to have the name itself.
        let of_parent = ["super", "self", "crate"].contains(&self.of.as_str());
        if of_parent && (is_in_prelude(&there) || elsewhere.contains(&there)) {
            return None;
        }
        let given = library.functions.contains_key(&there)
            || library.consts.contains_key(&there)
            || library.has_type(&there)
            || library.traits.contains_key(&there)
            || library.enums.contains_key(&self.of)
            || library.functions.keys().any(|name| method_of(name, &there));
        let known = FOREIGN.contains(&self.root.as_str());
        if given || known || self.prelude {
            return None;
        }
        let error = Diagnostic::error_at(
            Code::MissingFile,
            self.span,
            format!("`{there}` is not among the kernel's files"),
        )
        .label("imported here")
        .help("give the file that defines it too, or define it here");
        Some((here, error))
    }
}

/// Returns whether the prelude has a type or a function of a name.
fn is_in_prelude(name: &str) -> bool {
    let constructs = ["vec", "ivec", "uvec", "bvec", "mat"]
        .iter()
        .any(|prefix| matches!(name.strip_prefix(prefix), Some("2" | "3" | "4")));
    is_prelude_type(name) || constructs || super::FUNCTIONS.contains(&name) || ["Quat", "options"].contains(&name)
}

/// Returns whether `name` is a method of the type `of`.
fn method_of(name: &str, of: &str) -> bool {
    name.split_once("::").is_some_and(|(ty, _)| ty == of)
}

/// Returns whether a path may name a function by its last segment alone: that of a function in a module, since functions are found without
/// their module. Paths of a type's functions and of those in a module of the standard library are not.
pub fn is_by_last(path: &[String]) -> bool {
    let [.., of, name] = path else {
        return path.len() == 1;
    };
    let of_rust = match of.as_str() {
        "array" => name == "from_fn",
        "mem" => matches!(name.as_str(), "swap" | "replace" | "take"),
        "cmp" => matches!(name.as_str(), "min" | "max"),
        of => is_prelude_type(of),
    };
    !of_rust && !of.starts_with(char::is_uppercase)
}

/// Types of the prelude that a host binds.
pub fn is_resource(name: &str) -> bool {
    let others = [
        "Sampler",
        "ComparisonSampler",
        "Buffer",
        "AtomicBuffer",
        "StorageBuffer",
        "StorageTexture",
        "Shared",
        "AtomicShared",
    ];
    TextureType::from_name(name).is_some() || others.contains(&name)
}

/// Types of Rust, of glam and of the prelude, which the evaluator knows by their names.
pub fn is_prelude_type(name: &str) -> bool {
    let vector = ["Vec", "IVec", "UVec", "BVec", "Mat"];
    let numbered = |prefix: &&str| {
        name.strip_prefix(*prefix)
            .is_some_and(|n| matches!(n, "2" | "3" | "4" | "3A"))
    };
    vector.iter().any(numbered)
        || is_resource(name)
        || matches!(
            name,
            "Quad"
                | "bool"
                | "char"
                | "str"
                | "f32"
                | "f64"
                | "i8"
                | "i16"
                | "i32"
                | "i64"
                | "i128"
                | "isize"
                | "u8"
                | "u16"
                | "u32"
                | "u64"
                | "u128"
                | "usize"
        )
}

impl Items {
    /// An item that no kernel may reach.
    pub(super) fn note_foreign_item(&mut self, item: &mut syn::Item, mut check: Check) {
        macro_rules! named {
            ($item:expr, $what:literal, $instead:literal) => {{
                if check.keeps(&mut $item.attrs) {
                    check.refuse($item.ident.span(), $what, $instead);
                    let name = $item.ident.to_string();
                    self.note(&name, TokenStream::new(), check);
                }
            }};
        }
        match item {
            syn::Item::Union(i) => named!(i, "a `union`", "write a structure, and convert with `to_bits`"),
            syn::Item::TraitAlias(i) => named!(i, "a trait", "write functions of the types themselves"),
            syn::Item::ForeignMod(i) => {
                if !check.keeps(&mut i.attrs) {
                    return;
                }
                for inner in &i.items {
                    let name = match inner {
                        syn::ForeignItem::Fn(f) => &f.sig.ident,
                        syn::ForeignItem::Static(s) => &s.ident,
                        syn::ForeignItem::Type(t) => &t.ident,
                        // A macro, or unstable syntax.
                        _ => {
                            self.refuse_definitions(inner.to_token_stream(), check.for_same_file());
                            continue;
                        }
                    };
                    let mut check = check.for_same_file();
                    check.refuse(name.span(), "an item of an `extern` block", "write it in Rust");
                    self.note(&name.to_string(), TokenStream::new(), check);
                }
            }
            syn::Item::Use(i) => {
                if check.keeps(&mut i.attrs) {
                    let mut path = Vec::new();
                    self.collect_imports(&check, &i.tree, &mut path);
                }
            }
            syn::Item::Macro(m) => {
                if !check.keeps(&mut m.attrs) {
                    return;
                }
                match &m.ident {
                    Some(name) if name == "assert" || name == "options" => {
                        check.refuse(name.span(), &format!("another `{name}!`"), "give it another name");
                        self.refuse_all(check);
                    }
                    // Calls of it are refused where they stand.
                    Some(_) => {}
                    None => {
                        self.note_unknown_names(true);
                        self.refuse_definitions(m.mac.tokens.clone(), check);
                    }
                }
            }
            // Another crate's name only stands before `::`.
            syn::Item::ExternCrate(_) => {}
            other => self.refuse_definitions(other.to_token_stream(), check),
        }
    }

    /// Text that may define anything, as a macro does: what looks like a definition in it is refused.
    pub(super) fn refuse_definitions(&mut self, text: TokenStream, check: Check) {
        let mut tokens = text.into_iter().peekable();
        while let Some(token) = tokens.next() {
            match (token, tokens.peek()) {
                (TokenTree::Group(group), _) => self.refuse_definitions(group.stream(), check.for_same_file()),
                (TokenTree::Ident(word), Some(TokenTree::Ident(name)))
                    if [
                        "fn", "const", "static", "struct", "enum", "union", "type", "trait", "ref",
                    ]
                    .contains(&word.to_string().as_str()) =>
                {
                    let mut check = check.for_same_file();
                    check.refuse(
                        name.span(),
                        &format!("`{name}`, which a macro or unstable syntax defines,"),
                        "write the definition out",
                    );
                    self.note(&name.to_string(), TokenStream::new(), check);
                }
                _ => {}
            }
        }
    }

    fn collect_imports(&mut self, check: &Check, tree: &syn::UseTree, path: &mut Vec<String>) {
        match tree {
            syn::UseTree::Path(p) => {
                path.push(p.ident.to_string());
                self.collect_imports(check, &p.tree, path);
                path.pop();
            }
            syn::UseTree::Group(g) => g.items.iter().for_each(|tree| self.collect_imports(check, tree, path)),
            syn::UseTree::Glob(_) => {
                let known = path.first().is_some_and(|root| root == "straightline_kernels")
                    || path.last().is_some_and(|last| last == "consts" || last == "Ordering");
                self.note_unknown_names(!known);
            }
            syn::UseTree::Name(n) => self.import_name(check, path, (&n.ident, &n.ident)),
            syn::UseTree::Rename(r) => {
                if r.rename != "_" {
                    self.import_name(check, path, (&r.ident, &r.rename));
                }
            }
        }
    }

    fn import_name(&mut self, check: &Check, path: &[String], (there, here): (&syn::Ident, &syn::Ident)) {
        let (there, name) = (there.to_string(), here.to_string());
        if name == "self" || there == "self" {
            return;
        }
        self.add_import(Import {
            root: path.first().cloned().unwrap_or_default(),
            of: path.last().cloned().unwrap_or_default(),
            prelude: path.iter().any(|segment| segment == "prelude"),
            name: (there, name),
            span: check.token_span(here.span()),
        });
    }
}

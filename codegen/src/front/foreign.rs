//! Items that are not part of the kernel language, noted by their names, and names from texts that are not given.

use super::check::Check;
use super::items::Items;
use super::tree::{Library, Type};
use crate::diagnostic::{Diagnostic, Span};
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::spanned::Spanned;

/// A name that a `use` brings in.
pub struct Import {
    /// First segment of its path.
    root: String,
    /// Whether it comes out of a module `prelude`.
    prelude: bool,
    /// The name there, and the name here.
    name: (String, String),
    span: Span,
}

impl Import {
    /// The name and why the kernel may not use it, if what it stands for is not in the kernel's files.
    pub fn refused(self, library: &Library) -> Option<(String, Diagnostic)> {
        let (there, here) = self.name;
        if there != here {
            let error = Diagnostic::at(self.span, format!("`{there}` is imported by another name, `{here}`"))
                .label("not supported")
                .help(format!("import it as `{there}`, and use that name"));
            return Some((here, error));
        }
        let given = library.functions.contains_key(&here)
            || library.consts.contains_key(&here)
            || library.structs.contains_key(&here)
            || library.enums.contains_key(&here)
            || library.functions.keys().any(|name| method_of(name, &here));
        let known = ["std", "core", "alloc", "glam", "straightline_kernels"].contains(&self.root.as_str());
        if given || known || self.prelude {
            return None;
        }
        let error = Diagnostic::at(self.span, format!("`{here}` is not among the kernel's files"))
            .label("imported here")
            .help("give the file that defines it too, or define it here");
        Some((here, error))
    }
}

/// Whether `name` is a method of the type `of`.
fn method_of(name: &str, of: &str) -> bool {
    name.split_once("::").is_some_and(|(ty, _)| ty == of)
}

/// Types of Rust, of glam and of the prelude, which the evaluator knows by their names.
pub fn is_prelude_type(name: &str) -> bool {
    let vector = ["Vec", "IVec", "UVec", "BVec", "Mat"];
    let numbered = |prefix: &&str| {
        name.strip_prefix(*prefix)
            .is_some_and(|n| matches!(n, "2" | "3" | "4" | "3A"))
    };
    vector.iter().any(numbered)
        || matches!(
            name,
            "Frame"
                | "FrameLayers"
                | "Texture"
                | "Multisampled"
                | "DepthTexture"
                | "Sampler"
                | "ComparisonSampler"
                | "Buffer"
                | "AtomicBuffer"
                | "StorageBuffer"
                | "Quad"
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
    pub(super) fn elsewhere(&mut self, item: &mut syn::Item, mut check: Check) {
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
            syn::Item::Static(i) => named!(i, "a `static`", "write `const`"),
            syn::Item::Type(i) => named!(i, "another name for a type", "write the type itself"),
            syn::Item::Union(i) => named!(i, "a `union`", "write a structure, and convert with `to_bits`"),
            syn::Item::TraitAlias(i) => named!(i, "a trait", "write functions of the types themselves"),
            syn::Item::Trait(i) => {
                if !check.keeps(&mut i.attrs) {
                    return;
                }
                let of = i.ident.to_string();
                for inner in &i.items {
                    let name = match inner {
                        syn::TraitItem::Fn(f) => &f.sig.ident,
                        syn::TraitItem::Const(c) => &c.ident,
                        syn::TraitItem::Type(t) => &t.ident,
                        // A macro, or unstable syntax.
                        _ => {
                            self.hidden(inner.to_token_stream(), check.beside());
                            continue;
                        }
                    };
                    let mut check = check.beside();
                    check.refuse(
                        name.span(),
                        &format!("`{name}` of a trait"),
                        "write it as a function, or in an `impl` of the type itself",
                    );
                    self.note(&format!("{of}::{name}"), TokenStream::new(), check);
                }
            }
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
                            self.hidden(inner.to_token_stream(), check.beside());
                            continue;
                        }
                    };
                    let mut check = check.beside();
                    check.refuse(name.span(), "an item of an `extern` block", "write it in Rust");
                    self.note(&name.to_string(), TokenStream::new(), check);
                }
            }
            syn::Item::Use(i) => {
                if check.keeps(&mut i.attrs) {
                    let mut path = Vec::new();
                    self.import(&check, &i.tree, &mut path);
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
                    None => self.hidden(m.mac.tokens.clone(), check),
                }
            }
            // Another crate's name only stands before `::`.
            syn::Item::ExternCrate(_) => {}
            other => self.hidden(other.to_token_stream(), check),
        }
    }

    /// Functions of an implementation of a trait.
    pub(super) fn trait_implementation(
        &mut self,
        path: &syn::Path,
        ty: &Type,
        items: &[syn::ImplItem],
        mut check: Check,
    ) {
        let of = match ty {
            Type::Name(name, _) => name.as_str(),
            _ => "impl",
        };
        let name = path.segments.last().map(|s| s.ident.to_string()).unwrap_or_default();
        // What an operator or the end of a scope calls has no mention by its name.
        if matches!(name.as_str(), "PartialEq" | "PartialOrd" | "Drop") {
            check.refuse(
                path.span(),
                &format!("`{name}` written by hand"),
                "derive it, or compare the fields yourself",
            );
            self.note(of, TokenStream::new(), check.taken());
        }
        for item in items {
            let ident = match item {
                syn::ImplItem::Fn(f) => &f.sig.ident,
                syn::ImplItem::Const(c) => &c.ident,
                syn::ImplItem::Type(t) => &t.ident,
                // A macro, or unstable syntax.
                _ => {
                    self.hidden(item.to_token_stream(), check.beside());
                    continue;
                }
            };
            let mut check = check.beside();
            check.refuse(
                ident.span(),
                &format!("`{ident}` of the trait `{name}`"),
                &format!("write it in an `impl {of}` without a trait, or as a function"),
            );
            self.of_trait(format!("{of}::{ident}"), check.errors());
        }
    }

    /// Text that may define anything, as a macro does: what looks like a definition in it is refused.
    pub(super) fn hidden(&mut self, text: TokenStream, check: Check) {
        let mut tokens = text.into_iter().peekable();
        while let Some(token) = tokens.next() {
            match (token, tokens.peek()) {
                (TokenTree::Group(group), _) => self.hidden(group.stream(), check.beside()),
                (TokenTree::Ident(word), Some(TokenTree::Ident(name)))
                    if [
                        "fn", "const", "static", "struct", "enum", "union", "type", "trait", "ref",
                    ]
                    .contains(&word.to_string().as_str()) =>
                {
                    let mut check = check.beside();
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

    fn import(&mut self, check: &Check, tree: &syn::UseTree, path: &mut Vec<String>) {
        match tree {
            syn::UseTree::Path(p) => {
                path.push(p.ident.to_string());
                self.import(check, &p.tree, path);
                path.pop();
            }
            syn::UseTree::Group(g) => g.items.iter().for_each(|tree| self.import(check, tree, path)),
            syn::UseTree::Glob(_) => {}
            syn::UseTree::Name(n) => self.imported(check, path, (&n.ident, &n.ident)),
            syn::UseTree::Rename(r) => {
                if r.rename != "_" {
                    self.imported(check, path, (&r.ident, &r.rename));
                }
            }
        }
    }

    fn imported(&mut self, check: &Check, path: &[String], (there, here): (&syn::Ident, &syn::Ident)) {
        let (there, name) = (there.to_string(), here.to_string());
        if name == "self" || there == "self" {
            return;
        }
        self.takes(Import {
            root: path.first().cloned().unwrap_or_default(),
            prelude: path.iter().any(|segment| segment == "prelude"),
            name: (there, name),
            span: check.span(here.span()),
        });
    }
}

//! Items inside of functions: functions, types, implementations and imports are hoisted to the level of the function, like other items of
//! the file. Constants stay, since a block may have one with the name of a constant of the file; a function that is hoisted gets copies of
//! those constants of the enclosing blocks that it mentions.

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use std::collections::HashSet;
use syn::punctuated::Punctuated;

/// Takes the items out of all functions of a list, and adds them to it.
pub fn take_all(items: &mut Vec<syn::Item>) {
    let mut from = 0;
    while from < items.len() {
        let mut found = Vec::new();
        for item in &mut items[from..] {
            of_item(item, &mut found);
        }
        from = items.len();
        items.extend(found);
    }
}

fn of_item(item: &mut syn::Item, out: &mut Vec<syn::Item>) {
    match item {
        syn::Item::Fn(f) if is_plain(&f.attrs) => of_block(&mut f.block, &[], out),
        syn::Item::Impl(i) if is_plain(&i.attrs) => {
            for inner in &mut i.items {
                match inner {
                    syn::ImplItem::Fn(f) if is_plain(&f.attrs) => of_block(&mut f.block, &[], out),
                    syn::ImplItem::Const(c) if is_plain(&c.attrs) => of_expr(&mut c.expr, &[], out),
                    _ => {}
                }
            }
        }
        syn::Item::Trait(t) if is_plain(&t.attrs) => {
            for inner in &mut t.items {
                if let syn::TraitItem::Fn(f) = inner
                    && is_plain(&f.attrs)
                    && let Some(block) = &mut f.default
                {
                    of_block(block, &[], out);
                }
            }
        }
        syn::Item::Const(c) if is_plain(&c.attrs) => of_expr(&mut c.expr, &[], out),
        syn::Item::Static(s) if is_plain(&s.attrs) => of_expr(&mut s.expr, &[], out),
        syn::Item::Mod(m) => {
            if let Some((_, items)) = &mut m.content {
                take_all(items);
            }
        }
        _ => {}
    }
}

/// Returns whether a function is certainly there: the items of a function that `cfg` removes, or of a test, are not hoisted.
fn is_plain(attrs: &[syn::Attribute]) -> bool {
    attrs
        .iter()
        .all(|attr| !attr.path().is_ident("cfg") && !attr.path().is_ident("test"))
}

fn of_block(block: &mut syn::Block, around: &[syn::ItemConst], out: &mut Vec<syn::Item>) {
    let own = block.stmts.iter().filter_map(|statement| match statement {
        syn::Stmt::Item(syn::Item::Const(constant)) => Some(constant.clone()),
        _ => None,
    });
    let mut constants: Vec<syn::ItemConst> = own.collect();
    // If one constant hides another, those computed from the hidden one cannot be copied: no function gets any.
    let hides = |c: &syn::ItemConst| around.iter().any(|other| other.ident == c.ident);
    match constants.iter().any(hides) {
        true => constants.clear(),
        false => constants.extend(around.iter().cloned()),
    }
    let constants = constants.as_slice();
    let mut kept = Vec::new();
    for mut statement in std::mem::take(&mut block.stmts) {
        match statement {
            syn::Stmt::Item(
                mut item @ (syn::Item::Enum(_)
                | syn::Item::Fn(_)
                | syn::Item::Impl(_)
                | syn::Item::Static(_)
                | syn::Item::Struct(_)
                | syn::Item::Trait(_)
                | syn::Item::Type(_)
                | syn::Item::Use(_)),
            ) => {
                give_constants(&mut item, constants);
                out.push(item);
                continue;
            }
            syn::Stmt::Expr(ref mut e, _) => of_expr(e, constants, out),
            syn::Stmt::Local(ref mut local) => {
                if let Some(init) = &mut local.init {
                    of_expr(&mut init.expr, constants, out);
                }
            }
            _ => {}
        }
        kept.push(statement);
    }
    block.stmts = kept;
}

/// Blocks where items may be expected; what stands elsewhere is refused by the lowering.
fn of_expr(e: &mut syn::Expr, constants: &[syn::ItemConst], out: &mut Vec<syn::Item>) {
    match e {
        syn::Expr::Block(e) => of_block(&mut e.block, constants, out),
        syn::Expr::ForLoop(e) => of_block(&mut e.body, constants, out),
        syn::Expr::Loop(e) => of_block(&mut e.body, constants, out),
        syn::Expr::While(e) => of_block(&mut e.body, constants, out),
        syn::Expr::If(e) => {
            of_block(&mut e.then_branch, constants, out);
            if let Some((_, other)) = &mut e.else_branch {
                of_expr(other, constants, out);
            }
        }
        syn::Expr::Match(e) => e.arms.iter_mut().for_each(|arm| of_expr(&mut arm.body, constants, out)),
        syn::Expr::Closure(e) => of_expr(&mut e.body, constants, out),
        _ => {}
    }
}

/// Gives the functions of an item the constants of the blocks around it.
fn give_constants(item: &mut syn::Item, constants: &[syn::ItemConst]) {
    match item {
        syn::Item::Fn(f) => prepend_constants(&mut f.block, constants),
        syn::Item::Impl(i) => i.items.iter_mut().for_each(|inner| {
            if let syn::ImplItem::Fn(f) = inner {
                prepend_constants(&mut f.block, constants);
            }
        }),
        syn::Item::Trait(t) => t.items.iter_mut().for_each(|inner| {
            if let syn::TraitItem::Fn(f) = inner
                && let Some(block) = &mut f.default
            {
                prepend_constants(block, constants);
            }
        }),
        _ => {}
    }
}

/// Lets a block begin with those of some constants that it mentions, and those that they are made of; with none, where it has one
/// of its own of such a name.
fn prepend_constants(block: &mut syn::Block, constants: &[syn::ItemConst]) {
    if constants.is_empty() {
        return;
    }
    let own = block.stmts.iter().filter_map(|statement| match statement {
        syn::Stmt::Item(syn::Item::Const(constant)) => Some(constant.ident.to_string()),
        _ => None,
    });
    let own: HashSet<String> = own.collect();
    let mut mentioned = HashSet::new();
    collect_names(block.to_token_stream(), &mut mentioned);
    mentioned.retain(|name| !own.contains(name));
    let mut given: Vec<&syn::ItemConst> = Vec::new();
    while let Some(next) = constants.iter().find(|constant| {
        mentioned.contains(&constant.ident.to_string()) && given.iter().all(|known| known.ident != constant.ident)
    }) {
        collect_names(next.expr.to_token_stream(), &mut mentioned);
        collect_names(next.ty.to_token_stream(), &mut mentioned);
        given.push(next);
    }
    if given.iter().any(|constant| own.contains(&constant.ident.to_string())) {
        return;
    }
    let given = given.into_iter().cloned().map(|c| syn::Stmt::Item(syn::Item::Const(c)));
    block.stmts.splice(0..0, given.collect::<Vec<_>>());
}

/// Every name in a text.
fn collect_names(text: TokenStream, out: &mut HashSet<String>) {
    for token in text {
        match token {
            TokenTree::Group(group) => collect_names(group.stream(), out),
            TokenTree::Ident(name) => {
                out.insert(name.to_string());
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

/// The segments of a path but the last, and the name there and here; no names of `*`.
pub type Brought = (Vec<syn::Ident>, Option<(syn::Ident, syn::Ident)>);

/// Lists the imports of a path of a `use`: the segments before, and each name with the name by which it is known here; `None` for `*`.
pub fn list_imports(tree: &syn::UseTree) -> Vec<Brought> {
    let mut found = Vec::new();
    walk(tree, &mut Vec::new(), &mut found);
    found
}

fn walk(tree: &syn::UseTree, path: &mut Vec<syn::Ident>, out: &mut Vec<Brought>) {
    match tree {
        syn::UseTree::Path(p) => {
            path.push(p.ident.clone());
            walk(&p.tree, path, out);
            path.pop();
        }
        syn::UseTree::Group(g) => {
            let items: &Punctuated<syn::UseTree, syn::Token![,]> = &g.items;
            items.iter().for_each(|tree| walk(tree, path, out));
        }
        syn::UseTree::Glob(_) => out.push((path.clone(), None)),
        syn::UseTree::Name(n) => out.push((path.clone(), Some((n.ident.clone(), n.ident.clone())))),
        syn::UseTree::Rename(r) => out.push((path.clone(), Some((r.ident.clone(), r.rename.clone())))),
    }
}

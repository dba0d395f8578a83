//! Items inside of functions: functions, types, implementations and imports are taken out and stand beside the function, as
//! items of the file do. Constants stay, since a block may have one of a name that the file has too.

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
        syn::Item::Fn(f) if is_plain(&f.attrs) => of_block(&mut f.block, out),
        syn::Item::Impl(i) if is_plain(&i.attrs) => {
            for inner in &mut i.items {
                if let syn::ImplItem::Fn(f) = inner
                    && is_plain(&f.attrs)
                {
                    of_block(&mut f.block, out);
                }
            }
        }
        syn::Item::Trait(t) if is_plain(&t.attrs) => {
            for inner in &mut t.items {
                if let syn::TraitItem::Fn(f) = inner
                    && is_plain(&f.attrs)
                    && let Some(block) = &mut f.default
                {
                    of_block(block, out);
                }
            }
        }
        syn::Item::Mod(m) => {
            if let Some((_, items)) = &mut m.content {
                take_all(items);
            }
        }
        _ => {}
    }
}

/// Whether nothing takes a function away: what stands in one that is not there is not there either.
fn is_plain(attrs: &[syn::Attribute]) -> bool {
    attrs
        .iter()
        .all(|attr| !attr.path().is_ident("cfg") && !attr.path().is_ident("test"))
}

fn of_block(block: &mut syn::Block, out: &mut Vec<syn::Item>) {
    let mut kept = Vec::new();
    for mut statement in std::mem::take(&mut block.stmts) {
        match statement {
            syn::Stmt::Item(
                item @ (syn::Item::Enum(_)
                | syn::Item::Fn(_)
                | syn::Item::Impl(_)
                | syn::Item::Static(_)
                | syn::Item::Struct(_)
                | syn::Item::Trait(_)
                | syn::Item::Type(_)
                | syn::Item::Use(_)),
            ) => {
                out.push(item);
                continue;
            }
            syn::Stmt::Expr(ref mut e, _) => of_expr(e, out),
            syn::Stmt::Local(ref mut local) => {
                if let Some(init) = &mut local.init {
                    of_expr(&mut init.expr, out);
                }
            }
            _ => {}
        }
        kept.push(statement);
    }
    block.stmts = kept;
}

/// Blocks where items may be expected; what stands elsewhere is refused by the lowering.
fn of_expr(e: &mut syn::Expr, out: &mut Vec<syn::Item>) {
    match e {
        syn::Expr::Block(e) => of_block(&mut e.block, out),
        syn::Expr::ForLoop(e) => of_block(&mut e.body, out),
        syn::Expr::Loop(e) => of_block(&mut e.body, out),
        syn::Expr::While(e) => of_block(&mut e.body, out),
        syn::Expr::If(e) => {
            of_block(&mut e.then_branch, out);
            if let Some((_, other)) = &mut e.else_branch {
                of_expr(other, out);
            }
        }
        syn::Expr::Match(e) => e.arms.iter_mut().for_each(|arm| of_expr(&mut arm.body, out)),
        syn::Expr::Closure(e) => of_expr(&mut e.body, out),
        _ => {}
    }
}

/// The segments of a path but the last, and the name there and here; no names of `*`.
pub type Brought = (Vec<syn::Ident>, Option<(syn::Ident, syn::Ident)>);

/// What a path of a `use` brings in: the segments before, and each name with what it goes by here; `None` of `*`.
pub fn imports(tree: &syn::UseTree) -> Vec<Brought> {
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

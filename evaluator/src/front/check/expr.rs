//! Expressions and statements.

use super::super::cfg::Carrier;
use super::super::choice::MatchesSyntax;
use super::super::expr::{COUNTS_LINKS, DEPTH};
use super::super::macros::is_assertion;
use super::Check;
use crate::diagnostic::{Code, Diagnostic};
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;

impl Check {
    /// An expression where nothing can be left out.
    pub fn check_expr(&mut self, expr: &mut syn::Expr) {
        // The lowering refuses deeper nesting.
        if self.depth >= DEPTH {
            return;
        }
        self.depth += 1;
        let carrier = attribute_carrier(expr);
        if let Some(attrs) = expr_attributes(expr) {
            self.lower.keeps_always(attrs, carrier);
        }
        self.check_expr_kind(expr);
        self.depth -= 1;
    }

    /// The part of an expression that a chain goes on in, as [`Lower::link`](super::super::expr::Lower::link).
    fn check_link(&mut self, expr: &mut syn::Expr) {
        let depth = self.depth;
        if !COUNTS_LINKS {
            self.depth = depth.saturating_sub(1);
        }
        self.check_expr(expr);
        self.depth = depth;
    }

    fn check_expr_kind(&mut self, expr: &mut syn::Expr) {
        use syn::Expr as E;
        match expr {
            E::Array(e) => self.check_expr_list(&mut e.elems),
            E::Assign(e) => self.check_pair(&mut e.left, &mut e.right),
            E::Binary(e) => {
                self.check_link(&mut e.left);
                self.check_expr(&mut e.right);
            }
            E::Index(e) => {
                self.check_link(&mut e.expr);
                self.check_expr(&mut e.index);
            }
            E::Repeat(e) => self.check_pair(&mut e.expr, &mut e.len),
            E::Block(e) => self.check_block(&mut e.block),
            E::Call(e) => {
                match &mut *e.func {
                    E::Path(path) => self.check_path(&mut path.path, true),
                    other => self.check_link(other),
                }
                self.check_expr_list(&mut e.args);
            }
            E::Closure(e) => {
                for input in &mut e.inputs {
                    match input {
                        syn::Pat::Type(typed) => {
                            self.check_pattern(&mut typed.pat);
                            self.check_type(&mut typed.ty);
                        }
                        other => self.check_pattern(other),
                    }
                }
                if let syn::ReturnType::Type(_, ty) = &mut e.output {
                    self.check_type(ty);
                }
                self.check_expr(&mut e.body);
            }
            E::Cast(e) => {
                self.check_link(&mut e.expr);
                match &mut *e.ty {
                    syn::Type::Path(t) if t.qself.is_none() => self.check_path(&mut t.path, true),
                    other => self.check_type(other),
                }
            }
            E::Field(e) => self.check_link(&mut e.base),
            // The lowering refuses a `let` that is no condition.
            E::Let(e) => {
                self.check_pattern(&mut e.pat);
                self.check_expr(&mut e.expr);
            }
            E::ForLoop(e) => {
                self.check_pattern(&mut e.pat);
                self.check_expr(&mut e.expr);
                self.check_block(&mut e.body);
            }
            E::Group(e) => self.check_link(&mut e.expr),
            E::Paren(e) => self.check_link(&mut e.expr),
            E::Reference(e) => self.check_expr(&mut e.expr),
            E::Unary(e) => self.check_expr(&mut e.expr),
            E::If(e) => {
                self.check_expr(&mut e.cond);
                self.check_block(&mut e.then_branch);
                if let Some((_, other)) = &mut e.else_branch {
                    self.check_link(other);
                }
            }
            E::Loop(e) => self.check_block(&mut e.body),
            E::While(e) => {
                self.check_expr(&mut e.cond);
                self.check_block(&mut e.body);
            }
            E::Macro(e) => self.macro_call(&mut e.mac),
            E::Match(e) => {
                self.check_expr(&mut e.expr);
                for mut arm in std::mem::take(&mut e.arms) {
                    if self.keeps(&mut arm.attrs) {
                        self.check_pattern(&mut arm.pat);
                        self.check_expr(&mut arm.body);
                        e.arms.push(arm);
                    }
                }
            }
            E::MethodCall(e) => {
                self.check_link(&mut e.receiver);
                if let Some(list) = &mut e.turbofish {
                    self.generic_arguments(list);
                }
                self.check_expr_list(&mut e.args);
            }
            E::Path(e) if crate::front::expr::held_by_none(&e.path).is_some() => {
                for segment in &mut e.path.segments {
                    if let syn::PathArguments::AngleBracketed(list) = &mut segment.arguments {
                        list.args.iter_mut().for_each(|argument| {
                            if let syn::GenericArgument::Type(ty) = argument {
                                self.check_type(ty);
                            }
                        });
                    }
                }
            }
            E::Path(e) => {
                let is_instance = crate::front::expr::names_instance(&e.path);
                self.check_path(&mut e.path, is_instance);
            }
            E::Range(e) => [&mut e.start, &mut e.end]
                .into_iter()
                .flatten()
                .for_each(|end| self.check_expr(end)),
            E::Break(e) => e.expr.iter_mut().for_each(|e| self.check_expr(e)),
            E::Try(e) => self.check_link(&mut e.expr),
            E::Return(e) => e.expr.iter_mut().for_each(|e| self.check_expr(e)),
            E::Struct(e) => self.structure_literal(e),
            E::Tuple(e) => self.check_expr_list(&mut e.elems),
            // Nothing in them.
            E::Continue(_) | E::Lit(_) => {}
            // The lowering refuses these.
            E::Async(_)
            | E::Await(_)
            | E::Const(_)
            | E::Infer(_)
            | E::RawAddr(_)
            | E::TryBlock(_)
            | E::Unsafe(_)
            | E::Verbatim(_)
            | E::Yield(_) => {}
            // And whatever else syn may come to know.
            _ => {}
        }
    }

    fn check_pair(&mut self, left: &mut syn::Expr, right: &mut syn::Expr) {
        self.check_expr(left);
        self.check_expr(right);
    }

    /// Elements of a list, each of which `cfg` may remove.
    fn check_expr_list(&mut self, list: &mut Punctuated<syn::Expr, syn::Token![,]>) {
        let mut kept = Punctuated::new();
        for mut expr in std::mem::take(list) {
            let carrier = attribute_carrier(&expr);
            if expr_attributes(&mut expr).is_none_or(|attrs| self.lower.keeps_by_cfg(attrs, carrier)) {
                self.check_expr(&mut expr);
                kept.push(expr);
            }
        }
        *list = kept;
    }

    fn structure_literal(&mut self, e: &mut syn::ExprStruct) {
        if let Some(qself) = &e.qself {
            self.refuse(qself.span(), "a type in `<>`", "name the structure alone");
        }
        self.check_path(&mut e.path, true);
        let mut kept = Punctuated::new();
        for mut field in std::mem::take(&mut e.fields) {
            if self.keeps(&mut field.attrs) {
                self.check_expr(&mut field.expr);
                kept.push(field);
            }
        }
        e.fields = kept;
        match (&e.dot2_token, &mut e.rest) {
            (_, Some(rest)) => self.check_expr(rest),
            (Some(dots), None) => self.refuse(
                dots.span(),
                "`..` without a value after it",
                "name all fields, or write `..other` to take the rest from a value",
            ),
            (None, None) => {}
        }
    }

    /// Checks the arguments of assertions and `matches!`; the lowering refuses other macros.
    fn macro_call(&mut self, call: &mut syn::Macro) {
        if call.path.is_ident("matches") {
            if let Ok(mut body) = call.parse_body::<MatchesSyntax>() {
                self.check_expr(&mut body.value);
                self.check_pattern(&mut body.pattern);
                body.guard.iter_mut().for_each(|e| self.check_expr(e));
            }
            return;
        }
        let parser = Punctuated::<syn::Expr, syn::Token![,]>::parse_terminated;
        if !call
            .path
            .get_ident()
            .is_some_and(|name| is_assertion(&name.to_string()))
        {
            return;
        }
        if let Ok(mut parts) = call.parse_body_with(parser) {
            let before = parts.len();
            self.check_expr_list(&mut parts);
            if parts.len() != before {
                self.refuse(
                    call.span(),
                    "`#[cfg(..)]` in an assertion",
                    "put it before the assertion",
                );
            }
        }
    }

    /// Statements, each of which `cfg` may remove.
    pub fn check_block(&mut self, block: &mut syn::Block) {
        self.check_statements(block);
        for (k, statement) in block.stmts.iter().enumerate() {
            if let syn::Stmt::Local(syn::Local { pat, init: None, .. }) = statement {
                let name = match pat {
                    syn::Pat::Ident(p) => p,
                    syn::Pat::Type(typed) => match &*typed.pat {
                        syn::Pat::Ident(p) => p,
                        _ => continue,
                    },
                    _ => continue,
                };
                let rest = block.stmts[k + 1..].iter().map(|s| s.to_token_stream());
                if !rest.into_iter().any(|text| assigns_to(text, &name.ident)) {
                    let name = &name.ident;
                    self.never_assigned(name);
                }
            }
        }
    }

    fn never_assigned(&mut self, name: &syn::Ident) {
        let span = self.token_span(name.span());
        self.lower.errors.push(
            Diagnostic::error_at(
                Code::Unassigned,
                span,
                format!("`{name}` is declared, and never given a value"),
            )
            .label("no value")
            .help(format!("write `let {name} = ...;`, or assign to it before it is used")),
        );
    }

    fn check_statements(&mut self, block: &mut syn::Block) {
        for mut statement in std::mem::take(&mut block.stmts) {
            let kept = match &mut statement {
                syn::Stmt::Local(local) => self.check_let(local),
                syn::Stmt::Item(item) => self.inner_item(item),
                syn::Stmt::Expr(expr, _) => {
                    let target = leftmost(expr);
                    let carrier = attribute_carrier(target);
                    let kept = expr_attributes(target).is_none_or(|attrs| self.lower.keeps_by_cfg(attrs, carrier));
                    if kept {
                        self.check_expr(expr);
                    }
                    kept
                }
                syn::Stmt::Macro(m) => {
                    let kept = self.keeps(&mut m.attrs);
                    if kept {
                        self.macro_call(&mut m.mac);
                    }
                    kept
                }
            };
            if kept {
                block.stmts.push(statement);
            }
        }
    }

    fn check_let(&mut self, local: &mut syn::Local) -> bool {
        let init = local.init.as_ref().map(|init| attribute_carrier(&init.expr));
        let carrier = Carrier::Let(init == Some(Carrier::Branch));
        if !self.lower.keeps_by_cfg(&mut local.attrs, carrier) {
            return false;
        }
        match &mut local.pat {
            syn::Pat::Type(typed) => {
                self.check_pattern(&mut typed.pat);
                self.check_type(&mut typed.ty);
            }
            other => self.check_pattern(other),
        }
        if let Some(init) = &mut local.init {
            self.check_expr(&mut init.expr);
            if let Some((_, other)) = &mut init.diverge {
                self.check_expr(other);
            }
        }
        true
    }

    /// A constant or an import; other items in functions are refused by the lowering.
    fn inner_item(&mut self, item: &mut syn::Item) -> bool {
        match item {
            syn::Item::Const(c) => {
                let kept = self.keeps(&mut c.attrs);
                if kept {
                    self.check_constant(&mut c.generics, &mut c.ty, &mut c.expr);
                    self.constant_name(&c.ident);
                }
                kept
            }
            syn::Item::Use(u) => {
                let kept = self.keeps(&mut u.attrs);
                if kept {
                    self.inner_use(&u.tree);
                }
                kept
            }
            _ => true,
        }
    }

    fn inner_use(&mut self, tree: &syn::UseTree) {
        match tree {
            syn::UseTree::Path(p) => self.inner_use(&p.tree),
            syn::UseTree::Group(g) => g.items.iter().for_each(|tree| self.inner_use(tree)),
            syn::UseTree::Name(_) | syn::UseTree::Glob(_) => {}
            syn::UseTree::Rename(r) => {
                if r.rename != "_" {
                    self.refuse(r.span(), "`use` with another name", &format!("use it as `{}`", r.ident));
                }
            }
        }
    }

    /// A constant's name, by which a pattern tells it from a variable.
    pub fn constant_name(&mut self, name: &syn::Ident) {
        let shown = name.to_string();
        if shown.starts_with(|c: char| !c.is_uppercase() && c != '_') {
            self.refuse(
                name.span(),
                "a constant in lower case",
                &format!(
                    "write `{}`: in a pattern, a name in lower case is a new variable",
                    shown.to_uppercase()
                ),
            );
        }
    }
}

/// Returns whether text assigns to a variable by `name = ...`.
fn assigns_to(text: TokenStream, name: &syn::Ident) -> bool {
    let tokens: Vec<TokenTree> = text.into_iter().collect();
    let is = |at: usize, wanted: char| matches!(tokens.get(at), Some(TokenTree::Punct(p)) if p.as_char() == wanted);
    tokens.iter().enumerate().any(|(k, token)| match token {
        TokenTree::Group(group) => {
            let taken_apart = is(k + 1, '=') && !is(k + 2, '=');
            (taken_apart && mentions(group.stream(), name)) || assigns_to(group.stream(), name)
        }
        TokenTree::Ident(word) => word == name && is(k + 1, '=') && !is(k + 2, '='),
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}

/// Returns whether a text contains a name.
fn mentions(text: TokenStream, name: &syn::Ident) -> bool {
    text.into_iter().any(|token| match token {
        TokenTree::Group(group) => mentions(group.stream(), name),
        TokenTree::Ident(word) => word == *name,
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}

/// Class of an expression by the generator's own attributes that it accepts.
fn attribute_carrier(expr: &syn::Expr) -> Carrier {
    match expr {
        syn::Expr::ForLoop(_) | syn::Expr::While(_) | syn::Expr::Loop(_) => Carrier::Loop,
        syn::Expr::If(_) | syn::Expr::Match(_) => Carrier::Branch,
        syn::Expr::Block(_) => Carrier::Statement,
        _ => Carrier::Other,
    }
}

/// The part of a statement that syn gives the statement's attributes to.
fn leftmost(mut expr: &mut syn::Expr) -> &mut syn::Expr {
    loop {
        expr = match expr {
            syn::Expr::Assign(e) => &mut e.left,
            syn::Expr::Binary(e) => &mut e.left,
            syn::Expr::Cast(e) => &mut e.expr,
            other => return other,
        };
    }
}

/// The attributes of an expression.
fn expr_attributes(expr: &mut syn::Expr) -> Option<&mut Vec<syn::Attribute>> {
    macro_rules! each {
        ($($variant:ident)*) => {
            match expr {
                $(syn::Expr::$variant(e) => Some(&mut e.attrs),)*
                _ => None,
            }
        };
    }
    each!(
        Array Assign Async Await Binary Block Break Call Cast Closure Const Continue Field ForLoop Group If Index Infer
        Let Lit Loop Macro Match MethodCall Paren Path Range RawAddr Reference Repeat Return Struct Try TryBlock Tuple
        Unary Unsafe While Yield
    )
}

//! Probes: calls of [`COUNT`] that count how often each function, statement, side of a branch and loop body is executed.
//!
//! A probe is an effect. It keeps the condition under which its statement executes, however branches are merged and loops are
//! unrolled, so the counts are those of the source.

use super::COUNT;
use crate::diagnostic::Span;
use crate::front::token_span;
use proc_macro2::{Ident, Literal};
use quote::quote_spanned;
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};

/// A place whose executions are counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probe {
    /// The place: a function's name, the start of a statement or body, a branch or a loop.
    pub span: Span,
    /// Kind of the place.
    pub kind: ProbeKind,
}

/// Kind of a place whose executions are counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProbeKind {
    /// A function, by its path in the file.
    Function(String),
    /// A statement, or the body of a closure.
    Statement,
    /// A side of a branch, or the body of a loop.
    Side {
        /// Number of the branch or loop in the file.
        branch: u32,
        /// Number of the side in the branch; 0 for the body of a loop.
        side: u32,
    },
}

/// Inserts probes into the functions of a file that are no tests, and numbers them on from `probes`.
pub fn insert_probes(file: u32, parsed: &mut syn::File, probes: &mut Vec<Probe>) {
    let mut inserter = Inserter {
        file,
        probes,
        branches: 0,
        path: Vec::new(),
    };
    inserter.visit_file_mut(parsed);
}

struct Inserter<'p> {
    file: u32,
    probes: &'p mut Vec<Probe>,
    branches: u32,
    /// Modules and types around a function.
    path: Vec<String>,
}

impl Inserter<'_> {
    /// The call of a new probe. Its tokens have the place of a brace: inference knows literals by their places.
    fn probe(&mut self, span: proc_macro2::Span, brace: proc_macro2::Span, kind: ProbeKind) -> syn::Stmt {
        let number = Literal::u32_suffixed(self.probes.len() as u32);
        let count = Ident::new(COUNT, brace);
        self.probes.push(Probe {
            span: token_span(self.file, span),
            kind,
        });
        let call =
            syn::parse2(quote_spanned!(brace=> #count(#number))).unwrap_or(syn::Expr::Verbatim(Default::default()));
        syn::Stmt::Expr(call, Some(syn::Token![;](brace)))
    }

    fn side_probe(&mut self, at: proc_macro2::Span, brace: proc_macro2::Span, branch: u32, side: u32) -> syn::Stmt {
        self.probe(at, brace, ProbeKind::Side { branch, side })
    }

    fn visit_function(&mut self, name: &Ident, block: &mut syn::Block) {
        let path: Vec<&str> = self.path.iter().map(String::as_str).collect();
        let path = [&path[..], &[&name.to_string()]].concat().join("::");
        let probe = self.probe(name.span(), block.brace_token.span.open(), ProbeKind::Function(path));
        self.path.push(name.to_string());
        self.visit_block_mut(block);
        self.path.pop();
        block.stmts.insert(0, probe);
    }

    fn next_branch(&mut self) -> u32 {
        self.branches += 1;
        self.branches - 1
    }

    /// Visits a block that is a side of a branch or the body of a loop.
    fn visit_side(&mut self, at: proc_macro2::Span, branch: u32, side: u32, block: &mut syn::Block) {
        let probe = self.side_probe(at, block.brace_token.span.open(), branch, side);
        self.visit_block_mut(block);
        block.stmts.insert(0, probe);
    }

    /// Puts an expression into a block that begins with `probe`.
    fn put_behind(probe: syn::Stmt, expr: &mut syn::Expr) {
        let brace = match &probe {
            syn::Stmt::Expr(call, _) => call.span(),
            _ => expr.span(),
        };
        let inner = std::mem::replace(expr, syn::Expr::Verbatim(Default::default()));
        *expr = syn::Expr::Block(syn::ExprBlock {
            attrs: Vec::new(),
            label: None,
            block: syn::Block {
                brace_token: syn::token::Brace(brace),
                stmts: vec![probe, syn::Stmt::Expr(inner, None)],
            },
        });
    }
}

impl VisitMut for Inserter<'_> {
    fn visit_item_mod_mut(&mut self, module: &mut syn::ItemMod) {
        if is_of_tests(&module.attrs) {
            return;
        }
        self.path.push(module.ident.to_string());
        visit_mut::visit_item_mod_mut(self, module);
        self.path.pop();
    }

    fn visit_item_impl_mut(&mut self, block: &mut syn::ItemImpl) {
        if is_of_tests(&block.attrs) {
            return;
        }
        self.path.push(crate::front::cfg::as_written(&block.self_ty));
        for item in &mut block.items {
            if let syn::ImplItem::Fn(function) = item
                && !is_of_tests(&function.attrs)
            {
                self.visit_function(&function.sig.ident, &mut function.block);
            }
        }
        self.path.pop();
    }

    fn visit_item_trait_mut(&mut self, item: &mut syn::ItemTrait) {
        self.path.push(item.ident.to_string());
        for item in &mut item.items {
            if let syn::TraitItem::Fn(function) = item
                && let Some(block) = &mut function.default
            {
                self.visit_function(&function.sig.ident, block);
            }
        }
        self.path.pop();
    }

    fn visit_item_fn_mut(&mut self, function: &mut syn::ItemFn) {
        if !is_of_tests(&function.attrs) {
            self.visit_function(&function.sig.ident, &mut function.block);
        }
    }

    // Constants are computed once, when the shader is made.
    fn visit_item_const_mut(&mut self, _: &mut syn::ItemConst) {}
    fn visit_item_static_mut(&mut self, _: &mut syn::ItemStatic) {}
    fn visit_type_mut(&mut self, _: &mut syn::Type) {}
    fn visit_pat_mut(&mut self, _: &mut syn::Pat) {}

    fn visit_block_mut(&mut self, block: &mut syn::Block) {
        let brace = block.brace_token.span.open();
        for mut statement in std::mem::take(&mut block.stmts) {
            if !matches!(statement, syn::Stmt::Item(_)) {
                let first = quote::ToTokens::to_token_stream(&statement).into_iter().next();
                let at = first.map_or(brace, |token| token.span());
                block.stmts.push(self.probe(at, brace, ProbeKind::Statement));
            }
            self.visit_stmt_mut(&mut statement);
            block.stmts.push(statement);
        }
    }

    fn visit_expr_if_mut(&mut self, branch: &mut syn::ExprIf) {
        let (at, number) = (branch.if_token.span, self.next_branch());
        self.visit_expr_mut(&mut branch.cond);
        self.visit_side(at, number, 0, &mut branch.then_branch);
        let brace = branch.then_branch.brace_token.span.open();
        match &mut branch.else_branch {
            Some((_, otherwise)) => match &mut **otherwise {
                syn::Expr::Block(block) => self.visit_side(at, number, 1, &mut block.block),
                chained => {
                    let probe = self.side_probe(at, brace, number, 1);
                    self.visit_expr_mut(chained);
                    Inserter::put_behind(probe, chained);
                }
            },
            none => {
                let probe = self.side_probe(at, brace, number, 1);
                let block = syn::ExprBlock {
                    attrs: Vec::new(),
                    label: None,
                    block: syn::Block {
                        brace_token: syn::token::Brace(brace),
                        stmts: vec![probe],
                    },
                };
                *none = Some((syn::Token![else](brace), Box::new(syn::Expr::Block(block))));
            }
        }
    }

    fn visit_expr_match_mut(&mut self, branch: &mut syn::ExprMatch) {
        let (at, number) = (branch.match_token.span, self.next_branch());
        self.visit_expr_mut(&mut branch.expr);
        let brace = branch.brace_token.span.open();
        for (side, arm) in (0..).zip(&mut branch.arms) {
            let probe = self.side_probe(at, brace, number, side);
            // A block has probes of its own statements.
            if !matches!(*arm.body, syn::Expr::Block(_)) {
                let inner = self.probe(arm.body.span(), brace, ProbeKind::Statement);
                self.visit_expr_mut(&mut arm.body);
                Inserter::put_behind(inner, &mut arm.body);
            } else {
                self.visit_expr_mut(&mut arm.body);
            }
            Inserter::put_behind(probe, &mut arm.body);
            arm.comma.get_or_insert(syn::Token![,](brace));
        }
    }

    fn visit_expr_for_loop_mut(&mut self, looping: &mut syn::ExprForLoop) {
        let number = self.next_branch();
        self.visit_expr_mut(&mut looping.expr);
        self.visit_side(looping.for_token.span, number, 0, &mut looping.body);
    }

    fn visit_expr_while_mut(&mut self, looping: &mut syn::ExprWhile) {
        let number = self.next_branch();
        self.visit_expr_mut(&mut looping.cond);
        self.visit_side(looping.while_token.span, number, 0, &mut looping.body);
    }

    fn visit_expr_closure_mut(&mut self, closure: &mut syn::ExprClosure) {
        if matches!(*closure.body, syn::Expr::Block(_)) {
            return self.visit_expr_mut(&mut closure.body);
        }
        // A bar is no expression.
        let brace = closure.inputs_end.span;
        let probe = self.probe(closure.body.span(), brace, ProbeKind::Statement);
        self.visit_expr_mut(&mut closure.body);
        Inserter::put_behind(probe, &mut closure.body);
    }
}

/// Returns whether an item is a test or there for tests alone.
fn is_of_tests(attrs: &[syn::Attribute]) -> bool {
    attrs.iter().any(|attr| {
        let list = attr.meta.require_list().map(|list| list.tokens.to_string());
        attr.path().is_ident("test")
            || (attr.path().is_ident("cfg") && list.is_ok_and(|tokens| tokens.trim() == "test"))
    })
}

//! Visiting every part of a tree.

use super::ast::*;

/// What to do with each expression and each block, before their parts.
pub struct Walk<'f> {
    /// For each expression.
    pub expr: &'f mut dyn FnMut(&mut Expr),
    /// For each block.
    pub block: &'f mut dyn FnMut(&mut Block),
}

impl Walk<'_> {
    /// Visits a whole program.
    pub fn program(&mut self, program: &mut Program) {
        for function in &mut program.functions {
            self.block(&mut function.body);
        }
        self.block(&mut program.body);
    }

    fn block(&mut self, block: &mut Block) {
        (self.block)(block);
        for statement in &mut block.statements {
            self.statement(statement);
        }
        block.value.iter_mut().for_each(|e| self.expr(e));
    }

    fn statement(&mut self, statement: &mut Stmt) {
        match statement {
            Stmt::Let { init: e, .. } | Stmt::LetTuple(_, e) | Stmt::Return(e) => self.expr(e),
            Stmt::Assign(place, _, value) => {
                for step in &mut place.path {
                    if let Step::Index(index) = step {
                        self.expr(index);
                    }
                }
                self.expr(value);
            }
            Stmt::If(condition, then, otherwise) => {
                self.expr(condition);
                self.block(then);
                self.block(otherwise);
            }
            Stmt::For(_, range, body) => {
                self.expr(&mut range.start);
                self.expr(&mut range.end);
                self.block(body);
            }
            Stmt::ForArray(_, e, _, body) | Stmt::While(e, body) => {
                self.expr(e);
                self.block(body);
            }
            Stmt::Match(subject, arms) => {
                self.expr(subject);
                arms.iter_mut().for_each(|(_, body)| self.block(body));
            }
            Stmt::Block(block) => self.block(block),
            Stmt::Break | Stmt::Continue => {}
        }
    }

    fn expr(&mut self, e: &mut Expr) {
        (self.expr)(e);
        match &mut e.kind {
            Kind::If(condition, then, otherwise) => {
                self.expr(condition);
                self.block(then);
                self.block(otherwise);
            }
            Kind::Match(subject, arms) => {
                self.expr(subject);
                arms.iter_mut().for_each(|(_, body)| self.expr(body));
            }
            Kind::Block(block) => self.block(block),
            _ => children(e).into_iter().for_each(|child| self.expr(child)),
        }
    }
}

/// Direct parts of an expression that stand in no block.
pub fn children(e: &mut Expr) -> Vec<&mut Expr> {
    match &mut e.kind {
        Kind::Load(a)
        | Kind::Unary(_, a)
        | Kind::Swizzle(a, _)
        | Kind::Lane(a, _)
        | Kind::Part(a, _)
        | Kind::Cast(a)
        | Kind::Splat(a)
        | Kind::Repeat(a) => vec![a],
        Kind::Binary(_, a, b) | Kind::Index(a, b) => vec![a, b],
        Kind::Method(_, all) | Kind::Compose(all) | Kind::Many(all) | Kind::Call(_, all) => all.iter_mut().collect(),
        Kind::If(_, then, otherwise) => then.value.iter_mut().chain(otherwise.value.iter_mut()).collect(),
        Kind::Match(_, arms) => arms.iter_mut().map(|(_, body)| body).collect(),
        Kind::Block(block) => block.value.iter_mut().collect(),
        _ => Vec::new(),
    }
}

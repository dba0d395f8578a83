//! Arrays: elements read and written, and the variables that hold their versions.

use super::{Writer, Written, known};
use crate::emit::text::Text;
use crate::ir::{NodeId, Op, Type};

impl Writer<'_> {
    pub(super) fn array_get(&mut self, id: NodeId) -> Written {
        let graph = &self.compiled.graph;
        let (array, index) = (graph.node(id).args[0], graph.node(id).args[1]);
        if graph.node(array).op == Op::MakeArray && self.texts[array.0 as usize].is_none() {
            let name = self.names.of(graph, array, self.plan.origin(array));
            let literal = self.text(array)?;
            if known::is_table(graph, &graph.node(array).args) {
                self.tables
                    .push(self.dialect.table(&name, graph.ty(array), &literal.code));
                self.texts[array.0 as usize] = Some(Text::name(name));
            } else {
                let line = self.dialect.mutable(&name, graph.ty(array), Some(&literal.code));
                self.statement(id, line);
                // Known in this scope only: it is written again elsewhere.
                let read = self.indexed(array, &Text::name(name), index)?;
                let text = self.declare(id, &read);
                self.texts[id.0 as usize] = Some(text);
                return Ok(());
            }
        }
        let base = self.text(array)?;
        let read = self.indexed(array, &base, index)?;
        let text = self.declare(id, &read);
        self.texts[id.0 as usize] = Some(text);
        Ok(())
    }

    /// An element. An index that may lie outside is that of the last element, for reads and for writes.
    fn indexed(&mut self, array: NodeId, base: &Text, index: NodeId) -> Written<Text> {
        let graph = &self.compiled.graph;
        let mut text = self.text(index)?;
        if let Type::Array { len, .. } = graph.ty(array)
            && !known::is_inside(graph, index, len)
        {
            text = self.dialect.inside(&text, len);
        }
        Ok(Text::index(base, &text))
    }

    pub(super) fn array_set(&mut self, id: NodeId) -> Written {
        let args = self.compiled.graph.node(id).args.clone();
        self.enter_web(id, args[0])?;
        let name = Text::name(self.webs.variable(id).unwrap_or_default());
        let place = self.indexed(id, &name, args[1])?;
        let value = self.text(args[2])?;
        self.statement(id, format!("{} = {};", place.code, value.code));
        Ok(())
    }

    /// Declares the variable of a web with what it begins with.
    fn open_web(&mut self, id: NodeId, begin: NodeId) -> Written {
        let graph = &self.compiled.graph;
        let value = self.text(begin)?;
        let name = self.names.of(graph, id, self.plan.origin(id));
        let line = self.dialect.mutable(&name, graph.ty(id), Some(&value.code));
        self.statement(id, line);
        self.webs.declare(id, name, begin);
        Ok(())
    }

    /// Makes the web's variable hold `begin`, and takes it to be `version`.
    pub(super) fn enter_web(&mut self, version: NodeId, begin: NodeId) -> Written {
        match self.webs.variable(version).map(str::to_owned) {
            None => self.open_web(version, begin)?,
            Some(name) => {
                let value = self.text(begin)?;
                if value.code != name {
                    self.statement(version, format!("{name} = {};", value.code));
                }
            }
        }
        self.webs.advance(version);
        Ok(())
    }
}

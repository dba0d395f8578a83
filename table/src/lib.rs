//! Tables: columns of cells, rendered as CSV for programs, and as plain text, Markdown and HTML for readers.
//!
//! A column has one name for programs and one for readers. A cell has its value in full for programs, and rounded for
//! readers. So a result is described once, and every rendering has the same columns.
//!
//! ```
//! use straightline_table::Table;
//!
//! let times = [("looped", 3.25, 1.0), ("unrolled", 1.0, 3.25)];
//! let table = Table::of(times)
//!     .column("form", |(form, ..)| *form)
//!     .fixed(("median_ms", "ms"), 1, |(_, ms, _)| *ms)
//!     .fixed("speedup", 2, |(.., ratio)| *ratio)
//!     .finish();
//! assert_eq!(table.to_csv(), "form,median_ms,speedup\nlooped,3.25,1\nunrolled,1,3.25\n");
//! assert_eq!(table.to_markdown().lines().last(), Some("| unrolled | 1.0 | 3.25 |"));
//! ```

mod cell;
mod render;

pub use cell::Cell;

/// A table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
    /// Class of each row in HTML.
    classes: Vec<&'static str>,
}

/// A column's names, and its look.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Names for programs, one for each value of a cell; none for a column that only readers see.
    names: Vec<String>,
    /// Name for readers; `None` for a column that only programs see.
    title: Option<String>,
    is_left: bool,
    is_grouped: bool,
    is_turned: bool,
}

impl Column {
    /// A column with the same name for programs and readers.
    pub fn new(name: impl Into<String>) -> Column {
        let name = name.into();
        Column {
            names: vec![name.clone()],
            title: Some(name),
            is_left: false,
            is_grouped: false,
            is_turned: false,
        }
    }

    /// A column of [`Cell::interval`]s: programs have the columns `NAME`, `NAME_low` and `NAME_high`.
    pub fn interval(name: &str) -> Column {
        Column {
            names: vec![name.to_owned(), format!("{name}_low"), format!("{name}_high")],
            ..Column::new(name)
        }
    }

    /// A column for readers alone.
    pub fn shown(title: impl Into<String>) -> Column {
        Column {
            names: Vec::new(),
            ..Column::new(title)
        }
    }

    /// A column for programs alone.
    pub fn exact(name: impl Into<String>) -> Column {
        Column {
            title: None,
            ..Column::new(name)
        }
    }

    /// The column with another name for readers.
    pub fn titled(self, title: impl Into<String>) -> Column {
        Column {
            title: Some(title.into()),
            ..self
        }
    }

    /// The column with its cells at the left, as words are; the first column always is.
    pub fn left(self) -> Column {
        Column { is_left: true, ..self }
    }

    /// The column without repetition in text and Markdown: of equal cells below each other only the first is shown.
    pub fn grouped(self) -> Column {
        Column {
            is_grouped: true,
            ..self
        }
    }

    /// The column with its name turned by a quarter in HTML, for matrices.
    pub fn turned(self) -> Column {
        Column {
            is_turned: true,
            ..self
        }
    }
}

impl From<&str> for Column {
    fn from(name: &str) -> Column {
        Column::new(name)
    }
}

impl From<String> for Column {
    fn from(name: String) -> Column {
        Column::new(name)
    }
}

impl From<(&str, &str)> for Column {
    /// A column with a name for programs, and one for readers.
    fn from((name, title): (&str, &str)) -> Column {
        Column::new(name).titled(title)
    }
}

/// A table in the making, from a list of rows.
#[derive(Clone, Debug)]
pub struct TableBuilder<R> {
    rows: Vec<R>,
    table: Table,
}

impl Table {
    /// Begins a table with a row for each item.
    pub fn of<R>(rows: impl IntoIterator<Item = R>) -> TableBuilder<R> {
        let rows: Vec<R> = rows.into_iter().collect();
        let table = Table {
            columns: Vec::new(),
            rows: vec![Vec::new(); rows.len()],
            classes: vec![""; rows.len()],
        };
        TableBuilder { rows, table }
    }

    /// Returns whether the table has no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The table without the columns of these names.
    pub fn without(mut self, names: &[&str]) -> Table {
        let is_kept = |column: &Column| {
            let name = column.names.first().or(column.title.as_ref());
            name.is_none_or(|name| !names.contains(&name.as_str()))
        };
        let kept: Vec<bool> = self.columns.iter().map(is_kept).collect();
        for row in &mut self.rows {
            let mut kept = kept.iter();
            row.retain(|_| kept.next().is_none_or(|kept| *kept));
        }
        self.columns.retain(is_kept);
        self
    }
}

impl<R> TableBuilder<R> {
    /// Adds a column, whose cells are computed from the rows.
    pub fn column<C: Into<Cell>>(mut self, column: impl Into<Column>, cell: impl Fn(&R) -> C) -> Self {
        self.table.columns.push(column.into());
        for (row, cells) in self.rows.iter().zip(&mut self.table.rows) {
            cells.push(cell(row).into());
        }
        self
    }

    /// Adds a column of numbers, for readers with this many decimals ([`Cell::fixed`]).
    pub fn fixed<V: Into<Option<f64>>>(
        self,
        column: impl Into<Column>,
        decimals: usize,
        value: impl Fn(&R) -> V,
    ) -> Self {
        self.column(column, |row| {
            value(row).into().map(|value| Cell::fixed(value, decimals))
        })
    }

    /// Adds a column of numbers, for readers in scientific notation ([`Cell::scientific`]).
    pub fn scientific<V: Into<Option<f64>>>(
        self,
        column: impl Into<Column>,
        decimals: usize,
        value: impl Fn(&R) -> V,
    ) -> Self {
        self.column(column, |row| {
            value(row).into().map(|value| Cell::scientific(value, decimals))
        })
    }

    /// Adds a column of shares, for readers in percent ([`Cell::percent`]).
    pub fn percent<V: Into<Option<f64>>>(
        self,
        column: impl Into<Column>,
        decimals: usize,
        value: impl Fn(&R) -> V,
    ) -> Self {
        self.column(column, |row| {
            value(row).into().map(|value| Cell::percent(value, decimals))
        })
    }

    /// Adds a column for each item, which its cells are computed from too.
    pub fn columns<T, K: Into<Column>, C: Into<Cell>>(
        self,
        items: impl IntoIterator<Item = T>,
        column: impl Fn(&T) -> K,
        cell: impl Fn(&R, &T) -> C,
    ) -> Self {
        items.into_iter().fold(self, |table, item| {
            let column = column(&item).into();
            table.column(column, |row| cell(row, &item))
        })
    }

    /// Gives the rows that hold `condition` a class in HTML.
    pub fn class(mut self, class: &'static str, condition: impl Fn(&R) -> bool) -> Self {
        for (row, own) in self.rows.iter().zip(&mut self.table.classes) {
            if condition(row) {
                *own = class;
            }
        }
        self
    }

    /// Returns the table.
    pub fn finish(self) -> Table {
        self.table
    }
}

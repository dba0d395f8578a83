//! Cells: a value for programs, and for readers.

/// A cell of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// Values for programs, one for each name of the column; none if there is no value.
    pub(crate) exact: Vec<String>,
    /// Text for readers; `None` if there is no value.
    pub(crate) shown: Option<String>,
    /// Class in HTML.
    pub(crate) class: &'static str,
    /// Text in HTML that appears where the pointer rests on the cell.
    pub(crate) hint: String,
    /// `true` for source text, set in a font of equal widths.
    pub(crate) is_code: bool,
}

impl Cell {
    /// A value, and its form for readers.
    pub fn new(exact: impl Into<String>, shown: impl Into<String>) -> Cell {
        Cell {
            exact: vec![exact.into()],
            shown: Some(shown.into()),
            ..Cell::default()
        }
    }

    /// Source text, such as options.
    pub fn code(text: impl Into<String>) -> Cell {
        let mut cell = Cell::from(text.into());
        cell.is_code = true;
        cell
    }

    /// A number, for readers with this many decimals.
    pub fn fixed(value: f64, decimals: usize) -> Cell {
        Cell::new(format_exact(value), format!("{value:.decimals$}"))
    }

    /// A number, for readers in scientific notation with this many decimals.
    pub fn scientific(value: f64, decimals: usize) -> Cell {
        let shown = match value {
            0.0 => "0".to_owned(),
            value => format!("{value:.decimals$e}"),
        };
        Cell::new(format_exact(value), shown)
    }

    /// A share from 0 to 1, for readers in percent with this many decimals.
    pub fn percent(share: f64, decimals: usize) -> Cell {
        Cell::new(format_exact(share), format!("{:.decimals$} %", 100.0 * share))
    }

    /// A value with the ends of its interval, for readers as `2.00 (1.90 to 2.10)`; without the interval if it is a point.
    pub fn interval([value, low, high]: [f64; 3], decimals: usize) -> Cell {
        let shown = match low == high {
            true => format!("{value:.decimals$}"),
            false => format!("{value:.decimals$} ({low:.decimals$} to {high:.decimals$})"),
        };
        Cell {
            exact: [value, low, high].map(format_exact).to_vec(),
            shown: Some(shown),
            ..Cell::default()
        }
    }

    /// The cell with another text for readers.
    pub fn shown_as(self, shown: &str) -> Cell {
        Cell {
            shown: Some(shown.to_owned()),
            ..self
        }
    }

    /// The cell with words behind its value for readers: a unit, or a mark.
    pub fn suffixed(mut self, words: &str) -> Cell {
        if let Some(shown) = &mut self.shown {
            *shown += words;
        }
        self
    }

    /// The cell with a class in HTML.
    pub fn classed(self, class: &'static str) -> Cell {
        Cell { class, ..self }
    }

    /// The cell with a hint in HTML.
    pub fn hinted(self, hint: impl Into<String>) -> Cell {
        Cell {
            hint: hint.into(),
            ..self
        }
    }
}

/// A number in the fewest digits that give it back.
fn format_exact(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-4..1e15 => value.to_string(),
        _ => format!("{value:e}"),
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Cell {
        Cell::new(text.clone(), text)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Cell {
        Cell::new(text, text)
    }
}

impl From<&String> for Cell {
    fn from(text: &String) -> Cell {
        Cell::from(text.as_str())
    }
}

impl<C: Into<Cell>> From<Option<C>> for Cell {
    fn from(cell: Option<C>) -> Cell {
        cell.map_or_else(Cell::default, Into::into)
    }
}

macro_rules! from_whole {
    ($($ty:ty)*) => {$(
        impl From<$ty> for Cell {
            fn from(value: $ty) -> Cell {
                Cell::from(value.to_string())
            }
        }
    )*};
}
from_whole!(bool u32 u64 usize);

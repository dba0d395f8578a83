//! Section on the figures of GPU compilers.

use crate::record::{Asked, IsaRecord};
use serde::Serialize;
use straightline_isa::{Family, Figures};

#[derive(Debug, Serialize)]
pub(super) struct Isa {
    command: String,
    date: String,
    /// Names of the figures.
    figures: Vec<&'static str>,
    families: Vec<OfFamily>,
    /// Why a family has no table.
    absent: Vec<String>,
    /// Kernel, form, and why a compiler says nothing of it.
    refused: Vec<[String; 3]>,
}

/// A table of one family's figures.
#[derive(Debug, Serialize)]
struct OfFamily {
    device: String,
    rows: Vec<Vec<String>>,
}

pub(super) fn build_section(record: &IsaRecord) -> Isa {
    let row = |asked: &Asked, figures: &Figures| {
        let words = [
            asked.kernel.clone(),
            asked.form.display_name().to_owned(),
            asked.path.display_name().to_owned(),
        ];
        let figures = figures.in_short().map(|(_, figure)| figure.to_string());
        words.into_iter().chain(figures).collect()
    };
    let of_family = |(family, device): (&Family, &String)| OfFamily {
        device: format!("{family}: {device}"),
        rows: record
            .shaders
            .iter()
            .filter_map(|asked| Some(row(asked, asked.figures.get(family)?)))
            .collect(),
    };
    let refused = record.shaders.iter().filter_map(|asked| {
        let why = asked.refused.clone()?;
        Some([asked.kernel.clone(), asked.form.display_name().to_owned(), why])
    });
    Isa {
        command: record.command.clone(),
        date: record.date.clone(),
        figures: Figures::default().in_short().map(|(name, _)| name).into(),
        families: record.devices.iter().map(of_family).collect(),
        absent: record.absent.values().cloned().collect(),
        refused: refused.collect(),
    }
}

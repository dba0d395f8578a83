//! Section on the figures of GPU compilers.

use crate::record::{IsaRecord, Record};
use serde::Serialize;
use straightline_isa::Family;

#[derive(Debug, Serialize)]
pub(super) struct Isa {
    command: String,
    date: String,
    /// Each family's device, and the table of its figures.
    families: Vec<(String, String)>,
    /// Why a family has no table.
    absent: Vec<String>,
    /// Kernel, form, and why a compiler says nothing of it.
    refused: Vec<[String; 3]>,
}

pub(super) fn build_section(record: &IsaRecord) -> Isa {
    let table_of = |(family, device): (&Family, &String)| {
        let table = record.of_family(*family).to_table();
        (format!("{family}: {device}"), table.to_html())
    };
    let refused = record.shaders.iter().filter_map(|asked| {
        let why = asked.refused.clone()?;
        Some([asked.kernel.clone(), asked.form.display_name().to_owned(), why])
    });
    Isa {
        command: record.command.clone(),
        date: record.date.clone(),
        families: record.devices.iter().map(table_of).collect(),
        absent: record.absent.values().cloned().collect(),
        refused: refused.collect(),
    }
}

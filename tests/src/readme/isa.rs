//! Statistics of GPU compilers.

use super::markdown;
use straightline_isa::{Family, Figures};
use straightline_study::record::{Asked, IsaForm, IsaRecord, SpirvPath};

/// Each kernel on one family: the unrolled form in full, of looped forms cycles and branches.
pub fn cycles(record: &IsaRecord) -> Result<String, String> {
    let Some(family) = record.devices.keys().next() else {
        return Err("the record has no family".to_owned());
    };
    let head = [
        "kernel",
        "instructions",
        "memory",
        "registers",
        "**unrolled**",
        "looped",
        "bounded",
        "by glslang",
        "hand-optimised",
        "bounded",
    ];
    let mut names: Vec<&str> = record.shaders.iter().map(|asked| asked.kernel.as_str()).collect();
    names.dedup();
    let rows = names.into_iter().map(|name| row(record, *family, name));
    Ok(markdown(&head, rows.collect()))
}

/// Comparison with Slang's compiler, on one family.
pub fn rivals(record: &IsaRecord) -> Result<String, String> {
    let Some(family) = record.devices.keys().next() else {
        return Err("the record has no family".to_owned());
    };
    let head = ["kernel", "instructions", "by Slang", "**cycles**", "by Slang"];
    let of = |name: &str, form| {
        let is = |asked: &&Asked| asked.kernel == name && asked.form == form && asked.path == SpirvPath::Naga;
        record.shaders.iter().find(is)?.figures.get(family)
    };
    let by_slang = record.shaders.iter().filter(|asked| asked.form == IsaForm::Slang);
    let rows = by_slang.filter_map(|asked| {
        let (ours, theirs) = (of(&asked.kernel, IsaForm::Unrolled)?, asked.figures.get(family)?);
        Some(vec![
            asked.kernel.clone(),
            ours.instructions.to_string(),
            theirs.instructions.to_string(),
            format!("**{}**", ours.inverse_throughput),
            theirs.inverse_throughput.to_string(),
        ])
    });
    Ok(markdown(&head, rows.collect()))
}

fn row(record: &IsaRecord, family: Family, name: &str) -> Vec<String> {
    let of = |form, path| -> Option<&Figures> {
        let is = |asked: &&Asked| asked.kernel == name && asked.form == form && asked.path == path;
        record.shaders.iter().find(is)?.figures.get(&family)
    };
    let looped = |form, path| match of(form, path) {
        None => "–".to_owned(),
        Some(figures) => format!("{}, {}", figures.inverse_throughput, figures.branches),
    };
    let mut cells = vec![name.to_owned()];
    cells.extend(match of(IsaForm::Unrolled, SpirvPath::Naga) {
        None => vec!["–".to_owned(); 4],
        Some(f) => vec![
            f.instructions.to_string(),
            f.memory.to_string(),
            f.vector_registers.to_string(),
            format!("**{}**", f.inverse_throughput),
        ],
    });
    cells.extend([
        looped(IsaForm::Looped, SpirvPath::Naga),
        looped(IsaForm::Looped, SpirvPath::NagaBounded),
        looped(IsaForm::Looped, SpirvPath::Glslang),
        looped(IsaForm::ByHand, SpirvPath::Naga),
        looped(IsaForm::ByHand, SpirvPath::NagaBounded),
    ]);
    cells
}

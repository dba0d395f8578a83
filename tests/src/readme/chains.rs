//! Chains of passes, stored and fused, on several devices.

use straightline_study::record::{ChainForm, ChainsRecord};
use straightline_table::{Cell, Column, Table};

/// Each form of each chain: a column of times and one of speedups for each record.
pub fn forms(records: &[ChainsRecord]) -> Table {
    let first = records.first();
    let rows = first.into_iter().flat_map(|record| &record.chains);
    let rows = rows.flat_map(|chain| {
        // A form with the same pictures as one before it is that form again.
        let forms = chain.forms.iter().enumerate();
        let pictures = |form: &ChainForm| (form.fused.clone(), form.shared.clone());
        let is_new = move |(k, form): &(usize, &ChainForm)| {
            chain.forms[..*k]
                .iter()
                .all(|before| pictures(before) != pictures(form))
        };
        let forms = forms.filter(is_new);
        forms.map(|(_, form)| (chain.chain.as_str(), form))
    });
    let mut table = Table::of(rows)
        .column(Column::from("chain").grouped(), |(chain, _)| *chain)
        .column(Column::from("`fuse`").left(), |(_, form)| format!("`{}`", form.fuse))
        .column(Column::from("fused pictures").left(), |(_, form)| {
            let names = form.fused.iter().chain(&form.shared);
            let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
            names.join(", ")
        })
        .column("passes", |(_, form)| form.passes)
        .fixed("MB between", 1, |(_, form)| form.bytes as f64 / 1e6);
    for record in records {
        let of = |chain: &str, form: &ChainForm| {
            let same = record.chains.iter().filter(|known| known.chain == chain);
            let mut forms = same.flat_map(|known| &known.forms);
            forms.find(|known| known.fuse == form.fuse)
        };
        let name = device(&record.circumstances.adapter);
        table = table
            .column(Column::from(format!("ms, {name}")), |(chain, form)| {
                of(chain, form).map(|form| Cell::fixed(form.time.median_ms, 1))
            })
            .column(Column::from("speedup"), |(chain, form)| {
                of(chain, form).map(|form| Cell::interval(form.speedup.to_array(), 2))
            });
    }
    table
        .scientific("off 32-bit pictures", 1, |(_, form)| form.difference)
        .finish()
}

/// Short name of a device.
fn device(adapter: &str) -> &'static str {
    match adapter {
        adapter if adapter.contains("llvmpipe") => "lavapipe",
        adapter if adapter.contains("SwiftShader") => "SwiftShader",
        _ => "GPU",
    }
}

//! Output of sweeps as text.

use crate::failure::format_count;
use straightline_study::record::SweepRecord;
use straightline_study::statistics::describe_noise;
use straightline_study::sweep::Compared;
use straightline_table::{Cell, Column, Table};

/// Prints a table of all variants, and the reasons for rejected ones.
pub fn print_record(record: &SweepRecord) {
    let c = &record.circumstances;
    outln!(
        "{} on {}, {}x{}, {}, {}{}\n",
        record.kernel,
        c.adapter,
        c.size[0],
        c.size[1],
        match record.until {
            Some(until) => format!(
                "until ±{:.1} %, at most {}",
                100.0 * until,
                format_count(c.rounds as usize, "round")
            ),
            None => format_count(c.rounds as usize, "round"),
        },
        c.date,
        if c.complete { "" } else { "; interrupted" }
    );
    out!("{}", record.summarise().to_text());
    let base: Vec<String> = record
        .baseline
        .iter()
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    outln!(
        "\nspeedup: over {}, all else equal; median of the rounds, with its 95 % interval",
        base.join(" ")
    );
    outln!("{}", describe_noise(record.noise()));
    for (gpu, device) in &record.compilers {
        outln!("{gpu}: compiled for {device}, not run there");
    }
    let axes = record.varied_axes();
    for variant in &record.variants {
        if let Some(why) = &variant.refused {
            let mut what: Vec<String> = axes
                .iter()
                .filter_map(|axis| Some(format!("{}={}", axis.name, variant.settings.get(&axis.name)?)))
                .collect();
            what.extend(variant.rival.clone());
            outln!("not measured, {}: {why}", what.join(" "));
        }
        let machine = variant.measured.iter().flat_map(|measured| &measured.machine);
        for (gpu, figures) in machine {
            if let Some(why) = &figures.refused {
                outln!("{gpu} refuses {:?}: {why}", variant.settings);
            }
        }
    }
}

/// Prints the comparison of two records.
pub fn print_comparison(record: &SweepRecord, compared: &[Compared]) {
    let table = Table::of(compared)
        .columns(
            record.varied_axes(),
            |axis| axis.name.clone(),
            |of, axis| of.settings.get(&axis.name).cloned(),
        )
        .column("rival", |of| of.rival.clone())
        .fixed("first", 3, |of| of.speedup[0])
        .fixed("second", 3, |of| of.speedup[1])
        .column(Column::interval("second by first"), |of| {
            Cell::interval(of.quotient.to_array(), 2)
        })
        .column("", |of| if of.differs { "differs" } else { "" })
        .finish();
    out!("{}", table.to_text());
    outln!(
        "\nfirst, second: speedup over the baseline. Of all intervals together 95 % hold what they should, for these two runs: \
         how other runs would differ they do not say."
    );
}

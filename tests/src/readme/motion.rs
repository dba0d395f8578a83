//! Methods in motion.

use straightline_study::record::MotionRecord;
use straightline_table::Table;

/// Columns: SRAA's variants and, last, supersampling.
const COLUMNS: [&str; 5] = [
    "relative depth",
    "placed and searched",
    "history",
    "history, placed and searched",
    "supersampling",
];

/// PSNR, FLIP and flicker of each scene in each motion, with 4 samples and with 16.
pub fn methods(record: &MotionRecord) -> Table {
    let rows = record.scenes.iter();
    Table::of(rows.flat_map(|scene| [4, 16].map(|samples: u32| (scene, samples))))
        .column("scene", |(scene, _)| &scene.scene)
        .column("", |(scene, _)| scene.motion.display_name())
        .column("samples", |(_, samples)| *samples)
        .columns(
            COLUMNS,
            |column| *column,
            |(scene, samples), column| {
                let name = match *column {
                    "supersampling" => format!("{samples}x"),
                    variant => format!("SRAA {samples}, {variant}"),
                };
                let found = scene.methods.iter().find(|found| found.method == name)?;
                Some(format!("{:.2}, {:.4}, {:.4}", found.psnr, found.flip, found.flicker))
            },
        )
        .finish()
}

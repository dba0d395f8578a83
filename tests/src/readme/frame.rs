//! Time of a whole frame against its error.

use straightline_study::record::FrameRecord;
use straightline_table::Table;

/// Every method with the parts of its frame, and the frame at each cost of shading; those that no other beats in bold.
pub fn methods(record: &FrameRecord) -> Table {
    Table::of(&record.methods)
        .column("method", |method| &method.method)
        .fixed("PSNR, dB", 1, |method| method.psnr)
        .fixed("error", 4, |method| method.error)
        .fixed("geometry, ms", 0, |method| method.geometry_ms)
        .column("shading samples", |method| method.shaded)
        .fixed("filter, ms", 0, |method| method.filter_ms)
        .columns(
            record.shading_ms.iter().enumerate(),
            |(_, ms)| format!("frame, shading {ms} ms"),
            |method, (k, _)| match method.frames[*k].is_best {
                true => format!("**{:.0}**", method.frames[*k].ms),
                false => format!("{:.0}", method.frames[*k].ms),
            },
        )
        .finish()
}

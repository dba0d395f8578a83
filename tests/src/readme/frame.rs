//! Time of a whole frame against its error.

use super::markdown;
use straightline_study::record::FrameRecord;

/// Every method with the parts of its frame, and the frame at each cost of shading; those that no other beats in bold.
pub fn methods(record: &FrameRecord) -> String {
    let frames = record.shading_ms.iter().map(|ms| format!("frame, shading {ms} ms"));
    let frames: Vec<String> = frames.collect();
    let mut head = vec![
        "method",
        "PSNR, dB",
        "error",
        "geometry, ms",
        "shading samples",
        "filter, ms",
    ];
    head.extend(frames.iter().map(String::as_str));
    let rows = record.methods.iter().map(|method| {
        let mut row = vec![
            method.method.clone(),
            format!("{:.1}", method.psnr),
            format!("{:.4}", method.error),
            format!("{:.0}", method.geometry_ms),
            method.shaded.to_string(),
            format!("{:.0}", method.filter_ms),
        ];
        row.extend(method.frames.iter().map(|frame| match frame.is_best {
            true => format!("**{:.0}**", frame.ms),
            false => format!("{:.0}", frame.ms),
        }));
        row
    });
    markdown(&head, rows.collect())
}

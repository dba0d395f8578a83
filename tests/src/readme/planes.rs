//! Shading placed, searched for and done once more by planes, even regions kept.

use super::quality::{by_samples, cell, found};
use straightline_study::record::QualityRecord;
use straightline_table::Table;

/// Methods with one number of samples, N, and the names of their columns.
const METHODS: [(&str, &str); 6] = [
    ("SRAA N", "SRAA"),
    ("SRAA N, placed and searched", "placed, searched by depths"),
    ("SRAA N, placed and searched by planes", "by planes"),
    ("SRAA N, placed, searched and kept even", "and kept even"),
    ("SRAA N, placed, searched, kept even and extra", "and extra"),
    ("Nx", "supersampling"),
];

/// Methods of the table of even regions, with the names of their columns.
const EVEN: [(&str, &str); 5] = [
    ("SRAA N", "SRAA"),
    ("SRAA N, placed and searched by planes", "placed, searched by planes"),
    ("SRAA N, kept even", "kept even"),
    ("SRAA N, placed, searched and kept even", "placed, searched, kept even"),
    ("Nx", "supersampling"),
];

/// Every scene: PSNR and FLIP, and the share of the pixels that are shaded once more.
pub fn scenes(record: &QualityRecord) -> Table {
    by_samples(record, METHODS, |scene, name| {
        let extra = found(scene, name)?
            .extra
            .map(|share| format!(", {:.2} %", 100.0 * share));
        Some(cell(scene, name)? + &extra.unwrap_or_default())
    })
}

/// Every scene: PSNR of even regions, and of the whole picture, above that of no antialiasing.
pub fn even(record: &QualityRecord) -> Table {
    by_samples(record, EVEN, |scene, name| {
        let (own, none) = (found(scene, name)?, found(scene, "1x")?);
        let even = own.psnr_flat? - none.psnr_flat?;
        Some(format!("{even:+.1}, {:+.1}", own.psnr - none.psnr))
    })
}

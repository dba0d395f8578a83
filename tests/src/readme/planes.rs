//! Shading placed, searched for and done once more by planes, even regions kept.

use super::markdown;
use super::quality::{cell, found};
use straightline_study::record::{QualityRecord, SceneErrors};

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
pub fn scenes(record: &QualityRecord) -> String {
    let of = |scene: &SceneErrors, name: &str| match found(scene, name).and_then(|method| method.extra) {
        Some(share) => format!("{}, {:.2} %", cell(scene, name), 100.0 * share),
        None => cell(scene, name),
    };
    table(record, &METHODS, of)
}

/// Every scene: PSNR of even regions, and of the whole picture, above that of no antialiasing.
pub fn even(record: &QualityRecord) -> String {
    let of = |scene: &SceneErrors, name: &str| {
        let (own, none) = (found(scene, name)?, found(scene, "1x")?);
        let even = own.psnr_flat? - none.psnr_flat?;
        Some(format!("{even:+.1}, {:+.1}", own.psnr - none.psnr))
    };
    table(record, &EVEN, |scene, name| {
        of(scene, name).unwrap_or_else(|| "–".to_owned())
    })
}

fn table(record: &QualityRecord, methods: &[(&str, &str)], of: impl Fn(&SceneErrors, &str) -> String) -> String {
    let head: Vec<&str> = ["scene", "samples"]
        .into_iter()
        .chain(methods.iter().map(|(_, title)| *title))
        .collect();
    let rows = record.scenes.iter().flat_map(|scene| {
        ["4", "16"].map(|samples| {
            let cells = methods.iter().map(|(name, _)| of(scene, &name.replace('N', samples)));
            [scene.scene.clone(), samples.to_owned()]
                .into_iter()
                .chain(cells)
                .collect()
        })
    });
    markdown(&head, rows.collect())
}

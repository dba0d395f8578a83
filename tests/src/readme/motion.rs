//! Methods in motion.

use super::markdown;
use straightline_study::record::{MotionRecord, MovedMethod, MovedScene};

/// Columns: SRAA's variants and, last, supersampling.
const COLUMNS: [&str; 5] = [
    "relative depth",
    "placed and searched",
    "history",
    "history, placed and searched",
    "supersampling",
];

/// PSNR, FLIP and flicker of each scene in each motion, with 4 samples and with 16.
pub fn methods(record: &MotionRecord) -> String {
    let mut head = vec!["scene", "", "samples"];
    head.extend(COLUMNS);
    let row = |scene: &MovedScene, samples: usize| {
        let cell = |column: &&str| {
            let name = match *column {
                "supersampling" => format!("{samples}x"),
                variant => format!("SRAA {samples}, {variant}"),
            };
            let found = scene.methods.iter().find(|found| found.method == name);
            found.map_or(
                "–".to_owned(),
                |MovedMethod {
                     psnr, flip, flicker, ..
                 }| { format!("{psnr:.2}, {flip:.4}, {flicker:.4}") },
            )
        };
        let names = [
            scene.scene.clone(),
            scene.motion.display_name().to_owned(),
            samples.to_string(),
        ];
        names.into_iter().chain(COLUMNS.iter().map(cell)).collect()
    };
    let rows = record
        .scenes
        .iter()
        .flat_map(|scene| [4, 16].map(|samples| row(scene, samples)));
    markdown(&head, rows.collect())
}

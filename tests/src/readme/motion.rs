//! Methods in motion.

use straightline_study::record::{Motion, MotionRecord, MovedMethod, MovedScene};
use straightline_table::{Table, TableBuilder};

/// Columns: SRAA's variants and, last, supersampling.
const COLUMNS: [&str; 5] = [
    "relative depth",
    "placed and searched",
    "history",
    "history, placed and searched",
    "supersampling",
];

/// Columns with temporal antialiasing, each with the method, `N` for the number of samples.
const TEMPORAL: [(&str, &str); 11] = [
    ("1x", "1x"),
    ("1x + TAA", "1x + TAA"),
    ("SRAA", "SRAA N"),
    ("SRAA + TAA", "SRAA N + TAA"),
    ("edges", "SRAA N, edges"),
    ("full", "SRAA N, full"),
    ("full, history", "SRAA N, full, history"),
    ("guided", "SRAA N, guided"),
    ("guided + TAA", "SRAA N, guided + TAA"),
    ("guided, history", "SRAA N, guided, history"),
    ("supersampling", "Nx"),
];

/// PSNR, FLIP and flicker of each scene in each motion, with 4 samples and with 16.
pub fn methods(record: &MotionRecord) -> Table {
    rows(record)
        .columns(
            COLUMNS,
            |column| *column,
            |(scene, samples), column| {
                let name = match *column {
                    "supersampling" => format!("{samples}x"),
                    variant => format!("SRAA {samples}, {variant}"),
                };
                let found = find(scene, &name)?;
                Some(format!("{:.2}, {:.4}, {:.4}", found.psnr, found.flip, found.flicker))
            },
        )
        .finish()
}

/// PSNR and flicker with temporal antialiasing and without, of the same.
pub fn temporal(record: &MotionRecord) -> Table {
    rows(record)
        .columns(
            TEMPORAL,
            |(column, _)| *column,
            |(scene, samples), (_, method)| {
                let found = find(scene, &method.replace('N', &samples.to_string()))?;
                Some(format!("{:.2}, {:.4}", found.psnr, found.flicker))
            },
        )
        .finish()
}

/// Mean PSNR over the scenes, in a still, in moves of the camera and behind the board; and flicker in moves of the camera.
pub fn in_short(record: &MotionRecord) -> Table {
    let by_samples = [4, 16].map(|samples| TEMPORAL[2..].iter().map(move |column| (samples, column)));
    let named = |(samples, (_, method)): (u32, &(&str, &str))| method.replace('N', &samples.to_string());
    let once = TEMPORAL[..2].iter().map(|column| (4, column));
    let names: Vec<String> = once.chain(by_samples.into_iter().flatten()).map(named).collect();
    let mean = |name: &str, motions: &[Motion], value: fn(&MovedMethod) -> f64| {
        let scenes = record.scenes.iter().filter(|scene| motions.contains(&scene.motion));
        let values: Vec<f64> = scenes.filter_map(|scene| find(scene, name)).map(value).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    let psnr = |method: &MovedMethod| method.psnr;
    Table::of(names.iter())
        .column("method", |name| name.as_str())
        .fixed("still", 2, |name| mean(name, &[Motion::Still], psnr))
        .fixed("pan and turn", 2, |name| mean(name, &MOVES, psnr))
        .fixed("board", 2, |name| mean(name, &[Motion::Board], psnr))
        .fixed("flicker, pan and turn", 4, |name| {
            mean(name, &MOVES, |method| method.flicker)
        })
        .finish()
}

/// Moves of the camera.
const MOVES: [Motion; 2] = [Motion::Pan, Motion::Turn];

/// Begins a table with a row for each scene in each motion, with 4 samples and with 16.
fn rows(record: &MotionRecord) -> TableBuilder<(&MovedScene, u32)> {
    let rows = record.scenes.iter();
    Table::of(rows.flat_map(|scene| [4, 16].map(|samples: u32| (scene, samples))))
        .column("scene", |(scene, _)| &scene.scene)
        .column("", |(scene, _)| scene.motion.display_name())
        .column("samples", |(_, samples)| *samples)
}

fn find<'a>(scene: &'a MovedScene, name: &str) -> Option<&'a MovedMethod> {
    scene.methods.iter().find(|method| method.method == name)
}

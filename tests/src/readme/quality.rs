//! Methods of antialiasing against references.

use straightline_study::record::{MethodErrors, QualityRecord, SceneErrors};
use straightline_table::{Cell, Table};

/// Scenes whose errors are edges of geometry, for which SRAA is made.
pub const GEOMETRIC: [&str; 8] = [
    "roof", "grooves", "creases", "railings", "wires", "tubes", "sky", "terrain",
];

/// Methods that stand for the others where there is room for few.
const MAIN: [&str; 15] = [
    "1x",
    "SRAA 4",
    "SRAA 16",
    "SRAA 4, placed and searched",
    "SRAA 16, placed and searched",
    "SRAA 4, depth",
    "S.T.A.L.K.E.R.",
    "Tabula Rasa",
    "FXAA",
    "FXAA on light",
    "SMAA",
    "SMAA on light",
    "MSAA 4",
    "4x",
    "16x",
];

/// The heading of times: a record of filters that were timed on one scene alone says which.
fn timed(record: &QualityRecord) -> String {
    match &record.timed_on[..] {
        [one] if record.scenes.len() > 1 => format!("ms ({one})"),
        _ => "ms".to_owned(),
    }
}

/// The main methods: means over the geometric scenes and over the others.
pub fn in_short(record: &QualityRecord) -> Table {
    Table::of(MAIN.map(|name| Scenes::split(record, name)))
        .column("method", |row| row.name)
        .column("PSNR, edges of geometry", |row| {
            row.edges.mean(2, " dB", |m| Some(m.psnr))
        })
        .column("FLIP", |row| row.edges.mean(4, "", |m| Some(m.flip)))
        .column("gap closed", |row| {
            row.edges.mean(0, " %", |m| Some(100.0 * m.gap_closed?))
        })
        .column("PSNR, other scenes", |row| row.others.mean(2, " dB", |m| Some(m.psnr)))
        .column("FLIP", |row| row.others.mean(4, "", |m| Some(m.flip)))
        .column(timed(record), |row| row.all.mean(1, "", MethodErrors::median_ms))
        .column("MB", |row| row.all.mean(1, "", MethodErrors::megabytes))
        .finish()
}

/// Errors of a method on a scene.
pub(super) fn found<'a>(scene: &'a SceneErrors, name: &str) -> Option<&'a MethodErrors> {
    scene.methods.iter().find(|method| method.method == name)
}

/// Filters of the picture beside SRAA, scene by scene: PSNR, and the times of MLAA and SRAA 4.
pub fn pictures(record: &QualityRecord) -> Table {
    Table::of(&record.scenes)
        .column("scene", |scene| &scene.scene)
        .columns(
            ["1x", "FXAA", "SMAA", "MLAA", "SRAA 4", "SRAA 4 and MLAA"],
            |name| *name,
            |scene, name| found(scene, name).map(|m| Cell::fixed(m.psnr, 2)),
        )
        .columns(
            ["MLAA", "SRAA 4"],
            |name| format!("ms, {name}"),
            |scene, name| found(scene, name)?.median_ms().map(|ms| Cell::fixed(ms, 1)),
        )
        .finish()
}

/// SRAA with taps up to one pixel away, and up to more, scene by scene: PSNR, and the error that one pixel in a thousand exceeds.
pub fn radii(record: &QualityRecord) -> Table {
    errors(
        record,
        &[
            "SRAA 4",
            "SRAA 4, radius 1.5",
            "SRAA 4, radius 2",
            "SRAA 16",
            "SRAA 16, radius 2",
        ],
    )
}

/// Filters of SRAA's samples, scene by scene: PSNR, and the error that one pixel in a thousand exceeds.
pub fn resolves(record: &QualityRecord) -> Table {
    errors(
        record,
        &[
            "SRAA 4",
            "SRAA 4, tent 0.75",
            "SRAA 4, tent",
            "SRAA 4, tent 1.5",
            "SRAA 4, gaussian",
            "SRAA 4, mitchell 1.5",
            "SRAA 4, lanczos 1.5",
        ],
    )
}

/// A row for each scene, and one of median times.
fn errors(record: &QualityRecord, methods: &[&str]) -> Table {
    let median = |name: &str| {
        let times = record.scenes.iter();
        let mut times: Vec<f64> = times.filter_map(|scene| found(scene, name)?.median_ms()).collect();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).map(|time| format!("{time:.1}"))
    };
    Table::of(record.scenes.iter().map(Some).chain([None]))
        .column("scene", |scene| {
            scene.map_or("ms, median", |scene| scene.scene.as_str())
        })
        .columns(
            methods,
            |name| **name,
            |scene, name| match scene {
                Some(scene) => {
                    let method = found(scene, name)?;
                    Some(format!("{:.2}, {:.3}", method.psnr, method.worst?))
                }
                None => median(name),
            },
        )
        .finish()
}

/// Methods that shade or cover more samples, beside SRAA, scene by scene: PSNR, and the cost of the filter or the resolve.
pub fn samplings(record: &QualityRecord) -> Table {
    const METHODS: [&str; 11] = [
        "1x",
        "SRAA 4",
        "MSAA 4",
        "MSAA 4, directional",
        "MSAA 4, deferred",
        "4x",
        "SRAA 16",
        "CSAA 16",
        "AGAA 4",
        "AGAA 16",
        "16x",
    ];
    Table::of(&record.scenes)
        .column("scene", |scene| &scene.scene)
        .columns(
            METHODS,
            |name| *name,
            |scene, name| {
                let errors = found(scene, name)?;
                let time = errors.median_ms().map(|ms| format!(", {ms:.1} ms"));
                Some(format!("{:.2}{}", errors.psnr, time.unwrap_or_default()))
            },
        )
        .finish()
}

/// Every method: the same means, over kinds of pixels too, and over the pan.
pub fn methods(record: &QualityRecord) -> Table {
    let mut names: Vec<&str> = Vec::new();
    for method in record.scenes.iter().flat_map(|scene| &scene.methods) {
        if !names.contains(&method.method.as_str()) {
            names.push(&method.method);
        }
    }
    Table::of(names.into_iter().map(|name| Scenes::split(record, name)))
        .column("method", |row| row.name)
        .column("PSNR, edges of geometry", |row| row.edges.mean(2, "", |m| Some(m.psnr)))
        .column("SSIM", |row| row.edges.mean(4, "", |m| Some(m.ssim)))
        .column("FLIP", |row| row.edges.mean(4, "", |m| Some(m.flip)))
        .column("gap closed", |row| {
            row.edges.mean(0, " %", |m| Some(100.0 * m.gap_closed?))
        })
        .column("pan", |row| row.edges.mean(4, "", |m| m.temporal))
        .column("PSNR, other scenes", |row| row.others.mean(2, "", |m| Some(m.psnr)))
        .column("FLIP", |row| row.others.mean(4, "", |m| Some(m.flip)))
        .column("at edges of geometry", |row| row.all.mean(1, "", |m| m.psnr_geometry))
        .column("at edges of shading", |row| row.all.mean(1, "", |m| m.psnr_shading))
        .column("flat", |row| row.all.mean(1, "", |m| m.psnr_flat))
        .column(timed(record), |row| row.all.mean(1, "", MethodErrors::median_ms))
        .column("MB", |row| row.all.mean(1, "", MethodErrors::megabytes))
        .finish()
}

/// Methods on edges of paint and shadow, with the names of their columns: demodulated variants between SRAA and supersampling.
const DEMODULATED: [(&str, &str); 7] = [
    ("SRAA N, relative depth", "SRAA"),
    ("SRAA N, demodulated by albedo", "`albedo`"),
    ("SRAA N, demodulated", "`albedo-shadow`"),
    ("SRAA N, placed and searched", "placed, searched"),
    ("SRAA N, placed, searched and demodulated", "and `albedo-shadow`"),
    (
        "SRAA N, placed, searched, demodulated and rest apart",
        "and `rest=true`",
    ),
    ("Nx", "supersampling"),
];

/// Every scene by the number of samples: PSNR and FLIP of what takes light apart.
pub fn demodulated(record: &QualityRecord) -> Table {
    by_samples(record, DEMODULATED, cell)
}

/// Every scene with 4 and with 16 samples: a column for each method, whose name has N where its number of samples goes.
pub(super) fn by_samples<'m, C: Into<Cell>>(
    record: &QualityRecord,
    methods: impl IntoIterator<Item = (&'m str, &'m str)>,
    cell: impl Fn(&SceneErrors, &str) -> C,
) -> Table {
    let rows = record.scenes.iter();
    Table::of(rows.flat_map(|scene| ["4", "16"].map(|samples| (scene, samples))))
        .column("scene", |(scene, _)| &scene.scene)
        .column("samples", |(_, samples)| *samples)
        .columns(
            methods,
            |(_, title)| *title,
            |(scene, samples), (name, _)| cell(scene, &name.replace('N', samples)),
        )
        .finish()
}

/// Every scene: PSNR and FLIP of the main methods.
pub fn scenes(record: &QualityRecord) -> Table {
    Table::of(&record.scenes)
        .column("scene", |scene| &scene.scene)
        .columns(MAIN, |name| *name, |scene, name| cell(scene, name))
        .finish()
}

/// PSNR and FLIP of a method on a scene.
pub(super) fn cell(scene: &SceneErrors, name: &str) -> Option<String> {
    let method = found(scene, name)?;
    Some(format!("{:.2}, {:.4}", method.psnr, method.flip))
}

/// A method on the scenes for which SRAA is made, on the others, and on all.
struct Split<'a> {
    name: &'a str,
    edges: Scenes<'a>,
    others: Scenes<'a>,
    all: Scenes<'a>,
}

/// Errors of a method on some scenes.
struct Scenes<'a>(Vec<&'a MethodErrors>);

impl<'a> Scenes<'a> {
    fn split(record: &'a QualityRecord, name: &'a str) -> Split<'a> {
        let of = |is_shown: &dyn Fn(bool) -> bool| {
            let scenes = record.scenes.iter();
            let own = scenes.filter(|scene| is_shown(GEOMETRIC.contains(&scene.scene.as_str())));
            Scenes(own.filter_map(|scene| found(scene, name)).collect())
        };
        Split {
            name,
            edges: of(&|geometric| geometric),
            others: of(&|geometric| !geometric),
            all: of(&|_| true),
        }
    }

    /// The mean of a figure over the scenes that have it.
    fn mean(&self, digits: usize, unit: &str, figure: impl Fn(&MethodErrors) -> Option<f64>) -> Option<String> {
        let values: Vec<f64> = self.0.iter().filter_map(|method| figure(method)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (!values.is_empty()).then(|| format!("{mean:.digits$}{unit}"))
    }
}

/// Distance of SRAA from supersampling on every scene that has gaps, with its parts.
pub fn gaps(record: &QualityRecord) -> Table {
    let rows: Vec<&SceneErrors> = record.scenes.iter().filter(|scene| !scene.gaps.is_empty()).collect();
    let first = rows.first().map(|scene| scene.gaps.as_slice()).unwrap_or_default();
    let parts = first.iter().enumerate().flat_map(|(k, gap)| {
        let whole = format!("{} − {}", gap.method, gap.bound);
        let titles = [whole, "unseen surfaces".to_owned(), "borrowed colours".to_owned()];
        titles
            .into_iter()
            .enumerate()
            .map(move |(part, title)| (k, part, title))
    });
    let parts: Vec<_> = parts.collect();
    Table::of(rows)
        .column("scene", |scene| &scene.scene)
        .columns(
            parts,
            |(.., title)| title.clone(),
            |scene, (k, part, _)| {
                let gap = scene.gaps.get(*k)?;
                let parts = [
                    gap.psnr - gap.bound_psnr,
                    gap.ideal_psnr - gap.bound_psnr,
                    gap.psnr - gap.ideal_psnr,
                ];
                Some(format!("{:+.2}", parts[*part]))
            },
        )
        .finish()
}

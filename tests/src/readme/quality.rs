//! Methods of antialiasing against references.

use super::markdown;
use straightline_study::record::{MethodErrors, QualityRecord, SceneErrors};

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
pub fn in_short(record: &QualityRecord) -> String {
    let timed = timed(record);
    let head = [
        "method",
        "PSNR, edges of geometry",
        "FLIP",
        "gap closed",
        "PSNR, other scenes",
        "FLIP",
        &timed,
        "MB",
    ];
    let row = |name: &&str| {
        let (edges, others) = (Scenes::of(record, name, true), Scenes::of(record, name, false));
        let all = edges.and(&others);
        vec![
            (*name).to_owned(),
            edges.mean(2, " dB", |m| Some(m.psnr)),
            edges.mean(4, "", |m| Some(m.flip)),
            edges.mean(0, " %", |m| Some(100.0 * m.gap_closed?)),
            others.mean(2, " dB", |m| Some(m.psnr)),
            others.mean(4, "", |m| Some(m.flip)),
            all.mean(1, "", |m| Some(m.time?.median_ms)),
            all.mean(1, "", |m| Some(m.bytes as f64 / 1e6)),
        ]
    };
    markdown(&head, MAIN.iter().map(row).collect())
}

/// Errors of a method on a scene.
pub(super) fn found<'a>(scene: &'a SceneErrors, name: &str) -> Option<&'a MethodErrors> {
    scene.methods.iter().find(|method| method.method == name)
}

/// Filters of the picture beside SRAA, scene by scene: PSNR, and the times of MLAA and SRAA 4.
pub fn pictures(record: &QualityRecord) -> String {
    const METHODS: [&str; 6] = ["1x", "FXAA", "SMAA", "MLAA", "SRAA 4", "SRAA 4 and MLAA"];
    let head = [
        "scene",
        "1x",
        "FXAA",
        "SMAA",
        "MLAA",
        "SRAA 4",
        "SRAA 4 and MLAA",
        "ms, MLAA",
        "ms, SRAA 4",
    ];
    let row = |scene: &SceneErrors| {
        let psnr = |name: &str| found(scene, name).map_or("–".to_owned(), |m| format!("{:.2}", m.psnr));
        let time = |name: &str| {
            found(scene, name)
                .and_then(|m| m.time)
                .map_or("–".to_owned(), |t| format!("{:.1}", t.median_ms))
        };
        let psnrs = METHODS.map(psnr).into_iter();
        std::iter::once(scene.scene.clone())
            .chain(psnrs)
            .chain(["MLAA", "SRAA 4"].map(time))
            .collect()
    };
    markdown(&head, record.scenes.iter().map(row).collect())
}

/// SRAA with taps up to one pixel away, and up to more, scene by scene: PSNR, and the error that one pixel in a thousand exceeds.
pub fn radii(record: &QualityRecord) -> String {
    errors(
        record,
        [
            "SRAA 4",
            "SRAA 4, radius 1.5",
            "SRAA 4, radius 2",
            "SRAA 16",
            "SRAA 16, radius 2",
        ],
    )
}

/// Filters of SRAA's samples, scene by scene: PSNR, and the error that one pixel in a thousand exceeds.
pub fn resolves(record: &QualityRecord) -> String {
    errors(
        record,
        [
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

fn errors<const N: usize>(record: &QualityRecord, methods: [&str; N]) -> String {
    let row = |scene: &SceneErrors| {
        let cell = |name: &str| {
            let errors = found(scene, name).and_then(|m| Some((m.psnr, m.worst?)));
            errors.map_or("–".to_owned(), |(psnr, worst)| format!("{psnr:.2}, {worst:.3}"))
        };
        std::iter::once(scene.scene.clone()).chain(methods.map(cell)).collect()
    };
    let median = |name: &str| {
        let times = record
            .scenes
            .iter()
            .filter_map(|scene| Some(found(scene, name)?.time?.median_ms));
        let mut times: Vec<f64> = times.collect();
        times.sort_by(f64::total_cmp);
        times
            .get(times.len() / 2)
            .map_or("–".to_owned(), |time| format!("{time:.1}"))
    };
    let mut rows: Vec<Vec<String>> = record.scenes.iter().map(row).collect();
    rows.push(
        std::iter::once("ms, median".to_owned())
            .chain(methods.map(median))
            .collect(),
    );
    let head: Vec<&str> = std::iter::once("scene").chain(methods).collect();
    markdown(&head, rows)
}

/// Methods that shade or cover more samples, beside SRAA, scene by scene: PSNR, and the cost of the filter or the resolve.
pub fn samplings(record: &QualityRecord) -> String {
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
    let row = |scene: &SceneErrors| {
        let cell = |name: &str| {
            let Some(errors) = found(scene, name) else {
                return "–".to_owned();
            };
            let time = errors.time.map(|time| format!(", {:.1} ms", time.median_ms));
            format!("{:.2}{}", errors.psnr, time.unwrap_or_default())
        };
        std::iter::once(scene.scene.clone()).chain(METHODS.map(cell)).collect()
    };
    let head: Vec<&str> = std::iter::once("scene").chain(METHODS).collect();
    markdown(&head, record.scenes.iter().map(row).collect())
}

/// Every method: the same means, over kinds of pixels too, and over the pan.
pub fn methods(record: &QualityRecord) -> String {
    let timed = timed(record);
    let head = [
        "method",
        "PSNR, edges of geometry",
        "SSIM",
        "FLIP",
        "gap closed",
        "pan",
        "PSNR, other scenes",
        "FLIP",
        "at edges of geometry",
        "at edges of shading",
        "flat",
        &timed,
        "MB",
    ];
    let mut names: Vec<&str> = Vec::new();
    for method in record.scenes.iter().flat_map(|scene| &scene.methods) {
        if !names.contains(&method.method.as_str()) {
            names.push(&method.method);
        }
    }
    let row = |name: &&str| {
        let (edges, others) = (Scenes::of(record, name, true), Scenes::of(record, name, false));
        let all = edges.and(&others);
        vec![
            (*name).to_owned(),
            edges.mean(2, "", |m| Some(m.psnr)),
            edges.mean(4, "", |m| Some(m.ssim)),
            edges.mean(4, "", |m| Some(m.flip)),
            edges.mean(0, " %", |m| Some(100.0 * m.gap_closed?)),
            edges.mean(4, "", |m| m.temporal),
            others.mean(2, "", |m| Some(m.psnr)),
            others.mean(4, "", |m| Some(m.flip)),
            all.mean(1, "", |m| m.psnr_geometry),
            all.mean(1, "", |m| m.psnr_shading),
            all.mean(1, "", |m| m.psnr_flat),
            all.mean(1, "", |m| Some(m.time?.median_ms)),
            all.mean(1, "", |m| Some(m.bytes as f64 / 1e6)),
        ]
    };
    markdown(&head, names.iter().map(row).collect())
}

/// Methods on edges of paint and shadow: demodulated variants between SRAA and supersampling.
const DEMODULATED: [&str; 7] = [
    "SRAA N, relative depth",
    "SRAA N, demodulated by albedo",
    "SRAA N, demodulated",
    "SRAA N, placed and searched",
    "SRAA N, placed, searched and demodulated",
    "SRAA N, placed, searched, demodulated and rest apart",
    "Nx",
];

/// Every scene by the number of samples: PSNR and FLIP of what takes light apart.
pub fn demodulated(record: &QualityRecord) -> String {
    let head = [
        "scene",
        "samples",
        "SRAA",
        "`albedo`",
        "`albedo-shadow`",
        "placed, searched",
        "and `albedo-shadow`",
        "and `rest=true`",
        "supersampling",
    ];
    let rows = record.scenes.iter().flat_map(|scene| {
        ["4", "16"].map(|samples| {
            let cells = DEMODULATED.map(|name| cell(scene, &name.replace('N', samples)));
            [scene.scene.clone(), samples.to_owned()]
                .into_iter()
                .chain(cells)
                .collect()
        })
    });
    markdown(&head, rows.collect())
}

/// Every scene: PSNR and FLIP of the main methods.
pub fn scenes(record: &QualityRecord) -> String {
    of_scenes(record, &MAIN)
}

fn of_scenes(record: &QualityRecord, methods: &[&str]) -> String {
    let mut head = vec!["scene"];
    head.extend(methods);
    let row = |scene: &SceneErrors| {
        std::iter::once(scene.scene.clone())
            .chain(methods.iter().map(|name| cell(scene, name)))
            .collect()
    };
    markdown(&head, record.scenes.iter().map(row).collect())
}

/// PSNR and FLIP of a method on a scene.
pub(super) fn cell(scene: &SceneErrors, name: &str) -> String {
    match found(scene, name) {
        Some(method) => format!("{:.2}, {:.4}", method.psnr, method.flip),
        None => "–".to_owned(),
    }
}

/// Errors of a method on some scenes.
struct Scenes<'a>(Vec<&'a MethodErrors>);

impl<'a> Scenes<'a> {
    fn of(record: &'a QualityRecord, name: &str, geometric: bool) -> Scenes<'a> {
        let scenes = record.scenes.iter();
        let own = scenes.filter(|s| GEOMETRIC.contains(&s.scene.as_str()) == geometric);
        Scenes(own.filter_map(|s| found(s, name)).collect())
    }

    fn and(&self, others: &Scenes<'a>) -> Scenes<'a> {
        Scenes(self.0.iter().chain(&others.0).copied().collect())
    }

    /// The mean of a figure over the scenes that have it.
    fn mean(&self, digits: usize, unit: &str, figure: impl Fn(&MethodErrors) -> Option<f64>) -> String {
        let values: Vec<f64> = self.0.iter().filter_map(|method| figure(method)).collect();
        match values.is_empty() {
            true => "–".to_owned(),
            false => format!("{:.digits$}{unit}", values.iter().sum::<f64>() / values.len() as f64),
        }
    }
}

/// Distance of SRAA from supersampling on every scene that has gaps, with its parts.
pub fn gaps(record: &QualityRecord) -> String {
    let mut head = vec!["scene".to_owned()];
    let first = record.scenes.iter().find(|scene| !scene.gaps.is_empty());
    for gap in first.map(|scene| scene.gaps.as_slice()).unwrap_or_default() {
        head.push(format!("{} − {}", gap.method, gap.bound));
        head.extend(["unseen surfaces", "borrowed colours"].map(str::to_owned));
    }
    let rows = record
        .scenes
        .iter()
        .filter(|scene| !scene.gaps.is_empty())
        .map(|scene| {
            let figures = scene.gaps.iter().flat_map(|gap| {
                let parts = [
                    gap.psnr - gap.bound_psnr,
                    gap.ideal_psnr - gap.bound_psnr,
                    gap.psnr - gap.ideal_psnr,
                ];
                parts.map(|part| format!("{part:+.2}"))
            });
            std::iter::once(scene.scene.clone()).chain(figures).collect()
        });
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    markdown(&head, rows.collect())
}

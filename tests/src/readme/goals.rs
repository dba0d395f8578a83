//! Goals for speed, and their state in the records.

use super::quality::GEOMETRIC;
use super::{read, read_all};
use std::path::Path;
use straightline_isa::Figures;
use straightline_study::record::{
    FormKind, IsaRecord, KernelForms, LoopsRecord, QualityRecord, SpirvPath, SweepRecord, Swept,
};
use straightline_table::Table;

/// The small kernels of others.
const EXAMPLES: [&str; 10] = [
    "gaussian",
    "bilateral",
    "median",
    "sobel",
    "catmull rom",
    "kuwahara",
    "fxaa",
    "ssao",
    "joint bilateral upsampling",
    "convolution",
];

/// A goal: the measure, its value when the goal was set, the goal, and its current value.
pub(super) struct Goal {
    pub what: String,
    pub was: &'static str,
    pub goal: String,
    pub now: String,
    pub is_met: bool,
}

impl Goal {
    fn at_most(what: &str, was: &'static str, most: f64, digits: usize, now: f64) -> Goal {
        Goal {
            what: what.to_owned(),
            was,
            goal: format!("at most {most}"),
            now: format!("{now:.digits$}"),
            is_met: now <= most,
        }
    }

    fn at_least(what: &str, was: &'static str, least: &[f64], now: Vec<f64>) -> Goal {
        let join = |values: Vec<String>| values.join("; ");
        Goal {
            what: what.to_owned(),
            was,
            goal: format!("at least {}", join(least.iter().map(f64::to_string).collect())),
            is_met: now.iter().zip(least.iter().cycle()).all(|(now, least)| now >= least),
            now: join(now.iter().map(|now| format!("{now:.2}")).collect()),
        }
    }
}

/// Table of goals.
pub(super) fn goals_table(goals: Vec<Goal>) -> Table {
    let has_past = goals.iter().any(|goal| !goal.was.is_empty());
    let table = Table::of(&goals)
        .column("what", |goal| &goal.what)
        .column("when set", |goal| goal.was)
        .column("goal", |goal| &goal.goal)
        .column("now", |goal| format!("**{}**", goal.now))
        .column("met", |goal| if goal.is_met { "yes" } else { "no" })
        .finish();
    if has_past { table } else { table.without(&["when set"]) }
}

/// The table of the records that are named in this order: cycles, tiles, times of forms and of Slang's text on two drivers, and
/// methods.
pub fn table(files: &[&Path]) -> Result<Table, String> {
    let [
        isa,
        tiles,
        lavapipe,
        swiftshader,
        slang_lavapipe,
        slang_swiftshader,
        error,
    ] = files
    else {
        return Err("the table `goals` needs seven records".to_owned());
    };
    let (isa, tiles): (IsaRecord, IsaRecord) = (read(&[isa], 0)?, read(&[tiles], 0)?);
    let loops: Vec<LoopsRecord> = read_all(&[lavapipe, swiftshader])?;
    let rivals: Vec<SweepRecord> = read_all(&[slang_lavapipe, slang_swiftshader])?;
    let error: QualityRecord = read(&[error], 0)?;
    let cycles = |name: &str| figures(&isa, name, FormKind::Full).map(|figures| figures.inverse_throughput as f64);
    let images =
        |name: &str| figures(&tiles, name, FormKind::FullTile).map(|figures| (figures.memory - figures.shared) as f64);
    let both = |of: &dyn Fn(&LoopsRecord) -> Result<f64, String>| loops.iter().map(of).collect::<Result<Vec<_>, _>>();
    let goals = [
        Goal::at_most(
            "same work as Slang's text, which takes 562: cycles",
            "1009",
            480.0,
            0,
            cycles("SRAA 4, as in Slang")?,
        ),
        Goal::at_most("SRAA 4, the default: cycles", "800", 400.0, 0, cycles("SRAA 4")?),
        Goal::at_most(
            "SRAA 4, `guards=fallback`: cycles of the path that is taken",
            "800",
            400.0,
            0,
            cycles("SRAA 4, fallback, the path taken")?,
        ),
        Goal::at_most("SRAA 16, the default: cycles", "2086", 1000.0, 0, cycles("SRAA 16")?),
        Goal::at_most(
            "SRAA 16, `guards=fallback`: cycles of the path that is taken",
            "2086",
            1000.0,
            0,
            cycles("SRAA 16, fallback, the path taken")?,
        ),
        Goal::at_most(
            "SRAA 4 by workgroups: image instructions",
            "35",
            12.0,
            0,
            images("sraa")?,
        ),
        Goal::at_most(
            "bilateral 7×7 by workgroups: the same",
            "49",
            4.0,
            0,
            images("bilateral")?,
        ),
        Goal::at_least(
            "SRAA 4, speedup over its loop by naga: lavapipe; SwiftShader",
            "2.7; 5.4",
            &[5.0, 8.0],
            both(&|record| speedup(record, "SRAA 4"))?,
        ),
        Goal::at_least(
            "SRAA 16, the same",
            "5.3; 6.4",
            &[8.0, 12.0],
            both(&|record| speedup(record, "SRAA 16"))?,
        ),
        Goal::at_least(
            "same work as Slang's text, speedup over that, with 4 and with 16 samples: lavapipe; SwiftShader",
            "0.91, 1.6; 1.33, 2.3",
            &[1.3],
            rivals.iter().map(over_rivals).collect::<Result<Vec<_>, _>>()?.concat(),
        ),
        Goal::at_least(
            "SRAA 4, speedup over SMAA, whose PSNR is lower",
            "1.8",
            &[3.0],
            vec![over_smaa(&error)?],
        ),
        Goal::at_most(
            "median of the ten example kernels: time by that of their floor",
            "–",
            1.2,
            2,
            by_floor(&loops[0])?,
        ),
    ];
    Ok(goals_table(goals.into()))
}

fn figures<'r>(record: &'r IsaRecord, name: &str, form: FormKind) -> Result<&'r Figures, String> {
    let found = record.figures(name, form, SpirvPath::Naga);
    found.ok_or_else(|| format!("the record has no figures of {name}"))
}

fn kernel<'r>(record: &'r LoopsRecord, name: &str) -> Result<&'r KernelForms, String> {
    let found = record.kernels.iter().find(|kernel| kernel.kernel == name);
    found.ok_or_else(|| format!("the record has no kernel {name}"))
}

/// Of the fastest form without loops over the loop as wgpu compiles it.
fn speedup(record: &LoopsRecord, name: &str) -> Result<f64, String> {
    let kernel = kernel(record, name)?;
    let forms = [FormKind::Full, FormKind::FullBlock, FormKind::FullTile];
    let ratios = forms
        .into_iter()
        .filter_map(|kind| Some(kernel.form(kind)?.ratio.median));
    ratios
        .reduce(f64::max)
        .ok_or_else(|| format!("{name} has no form without loops"))
}

/// Ratio of emitted shaders to those of Slang's compiler, pattern by pattern: medians of the rounds' ratios.
fn over_rivals(record: &SweepRecord) -> Result<Vec<f64>, String> {
    let of = |pattern: &&str| {
        let is = |swept: &&Swept| swept.rival.is_some() && swept.settings.get("pattern").is_some_and(|p| p == pattern);
        let measured = record
            .variants
            .iter()
            .find(is)
            .and_then(|swept| swept.measured.as_ref());
        let ratio = measured.and_then(|measured| measured.speedup.as_ref());
        ratio
            .map(|ratio| 1.0 / ratio.median)
            .ok_or_else(|| format!("nothing is measured of {pattern}"))
    };
    ["ordered4", "ordered16"].iter().map(of).collect()
}

/// Time of SMAA by that of SRAA 4, on the scenes for which both are made.
fn over_smaa(record: &QualityRecord) -> Result<f64, String> {
    let mean = |name: &str| {
        let scenes = record
            .scenes
            .iter()
            .filter(|scene| GEOMETRIC.contains(&scene.scene.as_str()));
        let methods = scenes.filter_map(|scene| scene.methods.iter().find(|method| method.method == name));
        let times: Vec<f64> = methods.filter_map(|method| method.median_ms()).collect();
        match times.is_empty() {
            true => Err(format!("the record has no times of {name}")),
            false => Ok(times.iter().sum::<f64>() / times.len() as f64),
        }
    };
    Ok(mean("SMAA")? / mean("SRAA 4")?)
}

fn by_floor(record: &LoopsRecord) -> Result<f64, String> {
    let mut ratios = EXAMPLES
        .iter()
        .map(|name| {
            let kernel = kernel(record, name)?;
            let ms = |kind| kernel.form(kind).map(|form| form.time.median_ms);
            let ratio = ms(FormKind::Full)
                .zip(ms(FormKind::Floor))
                .map(|(own, floor)| own / floor);
            ratio.ok_or_else(|| format!("{name} has no floor"))
        })
        .collect::<Result<Vec<f64>, String>>()?;
    ratios.sort_by(f64::total_cmp);
    let middle = ratios.len() / 2;
    Ok((ratios[middle - 1] + ratios[middle]) / 2.0)
}

//! Goals for speed, and their state in the records.

use super::markdown;
use super::quality::GEOMETRIC;
use std::path::Path;
use straightline_isa::Figures;
use straightline_study::record::{
    FormKind, IsaForm, IsaRecord, KernelForms, LoopsRecord, QualityRecord, Record, SpirvPath, SweepRecord, Swept,
};

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
struct Goal {
    what: String,
    was: &'static str,
    goal: String,
    now: Vec<f64>,
    is_met: bool,
    digits: usize,
}

impl Goal {
    fn at_most(what: &str, was: &'static str, most: f64, digits: usize, now: f64) -> Goal {
        Goal {
            what: what.to_owned(),
            was,
            goal: format!("at most {most}"),
            now: vec![now],
            is_met: now <= most,
            digits,
        }
    }

    fn at_least(what: &str, was: &'static str, least: &[f64], now: Vec<f64>) -> Goal {
        let words: Vec<String> = least.iter().map(f64::to_string).collect();
        Goal {
            what: what.to_owned(),
            was,
            goal: format!("at least {}", words.join("; ")),
            is_met: now.iter().zip(least.iter().cycle()).all(|(now, least)| now >= least),
            now,
            digits: 2,
        }
    }

    fn row(self) -> Vec<String> {
        let now: Vec<String> = self.now.iter().map(|now| format!("{now:.*}", self.digits)).collect();
        let is_met = if self.is_met { "yes" } else { "no" };
        vec![
            self.what,
            self.was.to_owned(),
            self.goal,
            format!("**{}**", now.join("; ")),
            is_met.to_owned(),
        ]
    }
}

/// The table of the records that are named in this order: cycles, tiles, times of forms and of Slang's text on two drivers, and
/// methods.
pub fn table(files: &[&Path]) -> Result<String, String> {
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
    let why = |error: straightline_study::record::RecordError| error.to_string();
    let (isa, tiles) = (IsaRecord::read(isa).map_err(why)?, IsaRecord::read(tiles).map_err(why)?);
    let loops = [
        LoopsRecord::read(lavapipe).map_err(why)?,
        LoopsRecord::read(swiftshader).map_err(why)?,
    ];
    let rivals = [
        SweepRecord::read(slang_lavapipe).map_err(why)?,
        SweepRecord::read(slang_swiftshader).map_err(why)?,
    ];
    let error = QualityRecord::read(error).map_err(why)?;
    let cycles = |name: &str| figures(&isa, name, IsaForm::Unrolled).map(|figures| figures.inverse_throughput as f64);
    let images =
        |name: &str| figures(&tiles, name, IsaForm::Tile).map(|figures| (figures.memory - figures.shared) as f64);
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
    let head = ["what", "when set", "goal", "now", "met"];
    Ok(markdown(&head, goals.into_iter().map(Goal::row).collect()))
}

fn figures<'r>(record: &'r IsaRecord, name: &str, form: IsaForm) -> Result<&'r Figures, String> {
    let is = |asked: &&straightline_study::record::Asked| {
        asked.kernel == name && asked.form == form && asked.path == SpirvPath::Naga
    };
    let found = record
        .shaders
        .iter()
        .find(is)
        .and_then(|asked| asked.figures.values().next());
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
        let times: Vec<f64> = methods.filter_map(|method| Some(method.time?.median_ms)).collect();
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

//! `quads`: what sharing work over pixel quads is worth, filter by filter and transport by transport.

mod families;
mod pictures;

use super::study::command;
use crate::args::QuadsArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::{scene, table};
use families::{FAMILIES, Family};
use glam::{Vec4, vec3};
use serde::Serialize;
use std::time::SystemTime;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Settings, Transport, files};
use straightline_kernels::prelude::Frame;
use straightline_manifest::Stage;
use straightline_runtime::{Pass, Quads};
use straightline_testbed::execute::{Bench, Clock, Forward, Inputs, Job, Shadowed, Times, Uploaded};
use straightline_testbed::render::{GpuRenderer, Renderer};

/// One way to compute a filter.
#[derive(Clone, Debug, Serialize)]
struct Row {
    family: &'static str,
    way: String,
    transport: String,
    /// Of a pixel, by one invocation; of a block, by one invocation for its four pixels.
    reads: u32,
    messages: u32,
    statements: u32,
    time: Times,
    clock: Clock,
    /// How many times as fast as the family's first row; in a forward family, as the first that is drawn, or dispatched, as
    /// this one is: what is dispatched reads coordinates that another pass has drawn.
    ratio: f64,
    /// Difference to the family's first row: mean and largest, over all components.
    mean_difference: f64,
    largest_difference: f64,
}

/// A run and its circumstances.
#[derive(Clone, Debug, Serialize)]
struct Record {
    command: String,
    date: String,
    adapter: String,
    size: [u32; 2],
    rounds: u32,
    quads: String,
    rows: Vec<Row>,
}

/// A way with a transport, ready to run.
struct Subject {
    family: &'static str,
    way: &'static str,
    transport: String,
    counts: straightline_manifest::Counts,
    drawn: Drawn,
    image: Frame<Vec4>,
}

enum Drawn {
    Pass(Box<Pass>, Uploaded),
    Forward(Forward),
}

/// Occlusion as far as the scene's walls and steps, dark enough to be judged.
const OCCLUSION: [(&str, &str); 3] = [("pixel-angle", "uniform"), ("radius", "1.2"), ("strength", "4")];

/// Measures every way of every filter on a rendered frame, in one run.
pub fn run(args: &QuadsArgs) -> Result<(), Failure> {
    if let Some(path) = &args.record {
        files::try_file(path, true).map_err(Failure::of)?;
    }
    if let Some(folder) = &args.pictures {
        files::try_folder(folder).map_err(Failure::of)?;
    }
    let gpu = Gpu::require(&args.adapter)?;
    let bench = gpu.bench();
    let quads = Quads::detect(&gpu.device, &gpu.queue).map_err(Failure::of)?;
    let chosen = match quads.choose() {
        Ok(transport) => format!("{transport:?}").to_lowercase(),
        Err(why) => why,
    };
    let scene = scene::load(args.mesh.as_deref(), "roof")?;
    let shadowed = Shadowed::new(&bench, &scene, args.size, args.texels, 9.0).map_err(Failure::of)?;
    let forward_inputs = shadowed.inputs(&bench).map_err(Failure::of)?;
    let screen_inputs = screen(&gpu, &bench, &scene, args)?;
    let mut subjects = Vec::new();
    for family in FAMILIES {
        for (way, options) in family.ways {
            // What shares nothing sends nothing: one fragment shader, and one compute shader, stand for it.
            let transports: &[Transport] = match way.starts_with("naive") || *way == "bilinear" {
                true => &[Transport::Subgroup, Transport::Block],
                false => &Transport::ALL,
            };
            for transport in transports {
                if *transport == Transport::Subgroup && quads.subgroup.is_none() {
                    continue;
                }
                let inputs = if family.forward {
                    &forward_inputs
                } else {
                    &screen_inputs
                };
                subjects.push(prepare(&bench, family, way, options, *transport, inputs, &shadowed)?);
            }
        }
    }
    // A forward pass draws the pixels that the scene's triangles cover, and says nothing of the others.
    let drawn = forward_inputs.images.iter().find(|(name, _)| name == "coord");
    let covered: Option<Vec<bool>> =
        drawn.map(|(_, layers)| layers[0].texels().iter().map(|place| *place != Vec4::ZERO).collect());
    let rows = measure(&bench, args, &subjects, covered.as_deref())?;
    if let Some(folder) = &args.pictures {
        pictures::write(&bench, folder, &subjects, &shadowed, &screen_inputs)?;
    }
    let record = Record {
        command: command(),
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        adapter: gpu.describe(),
        size: args.size.to_array(),
        rounds: args.rounds,
        quads: format!(
            "derivatives {:?}, origin {:?}; chosen: {chosen}",
            quads.kind, quads.origin
        ),
        rows,
    };
    print(args, &record)
}

/// A rendered frame as the full-screen filters read it: its colours, geometry, and occlusion at half the resolution.
fn screen(
    gpu: &Gpu,
    bench: &Bench,
    scene: &straightline_testbed::scene::Scene,
    args: &QuadsArgs,
) -> Result<Inputs, Failure> {
    let renderer = GpuRenderer::new(&gpu.device, &gpu.queue, scene, args.size).map_err(Failure::of)?;
    let color = renderer.shaded(glam::Vec2::ZERO).map_err(Failure::of)?;
    let (depth, normal) = renderer.geometry(glam::Vec2::ZERO).map_err(Failure::of)?;
    let with_depth = color
        .texels()
        .iter()
        .zip(depth.texels())
        .map(|(c, z)| c.truncate().extend(*z));
    let image = Frame::new(args.size, with_depth.collect());
    let depth = Frame::new(args.size, depth.texels().iter().map(|z| Vec4::splat(*z)).collect());
    // The testbed looks along -z with y up, the kernel along z with y down.
    let turned = normal.texels().iter().map(|n| vec3(n.x, -n.y, -n.z).extend(0.0));
    let normal = Frame::new(args.size, turned.collect());
    let angle = 2.0 * scene.camera.half_extent(args.size).y / args.size.y as f32;
    let full = Inputs::new(args.size)
        .image("image", image)
        .image("depth", depth)
        .image("normal", normal)
        .uniform("pixel_angle", &[f64::from(angle)]);
    // Occlusion as it would be computed at half the resolution, here taken from the full one.
    let occlusion = compile("quad_ssao", &[&[("sharing", "alone")], &OCCLUSION[..]].concat(), None)?;
    let occlusion = bench.run(&occlusion, Stage::Compute, &full).map_err(Failure::of)?;
    let low_size = args.size.map(|n| n.div_ceil(2) + 1);
    let mut low = full.clone().image("image", occlusion);
    low.size = low_size;
    let down = |gives: &str| -> Result<Frame<Vec4>, Failure> {
        let compiled = compile("downsampling", &[("gives", gives)], None)?;
        bench.run(&compiled, Stage::Compute, &low).map_err(Failure::of)
    };
    let (packed, surface) = (down("packed")?, down("surface")?);
    Ok(full.image("low", packed).image("low_surface", surface))
}

fn compile(kernel: &str, options: &[(&str, &str)], transport: Option<Transport>) -> Result<Compiled, Failure> {
    let settings = Settings {
        options: options
            .iter()
            .map(|(k, v)| ((*k).to_owned(), (*v).to_owned()))
            .collect(),
        transport,
        ..Settings::default()
    };
    Ok(Kernel::builtin(kernel)?.compile(&settings)?)
}

fn prepare(
    bench: &Bench,
    family: &Family,
    way: &'static str,
    options: &[(&str, &str)],
    transport: Transport,
    inputs: &Inputs,
    shadowed: &Shadowed,
) -> Result<Subject, Failure> {
    let mut options = options.to_vec();
    if family.kernel == "quad_ssao" {
        options.extend(OCCLUSION);
    }
    let compiled = compile(family.kernel, &options, Some(transport))?;
    let stage = match transport {
        Transport::Block => Stage::Compute,
        _ => Stage::Fragment,
    };
    let (drawn, image, counts) = if family.forward && stage == Stage::Fragment {
        let forward = bench.forward(&compiled, inputs, &shadowed.corners, None, |text| text);
        let forward = forward.map_err(Failure::of)?;
        let image = bench.picture(&forward).map_err(Failure::of)?;
        let emitted = compiled.emit(&EmitOptions::new().stage(stage).targets([]));
        let counts = emitted.map_err(Failure::of)?.manifest.counts;
        (Drawn::Forward(forward), image, counts)
    } else {
        let (pass, manifest) = bench.pass(&compiled, stage).map_err(Failure::of)?;
        let uploaded = bench.upload(&manifest, inputs).map_err(Failure::of)?;
        let image = bench.run(&compiled, stage, inputs).map_err(Failure::of)?;
        (Drawn::Pass(Box::new(pass), uploaded), image, manifest.counts)
    };
    let sends = counts.messages > 0 || transport == Transport::Block;
    Ok(Subject {
        family: family.name,
        way,
        transport: match (sends, transport) {
            (false, _) => "none, fragment".to_owned(),
            (_, Transport::Block) => "block, compute".to_owned(),
            (_, other) => other.to_string(),
        },
        counts,
        drawn,
        image,
    })
}

fn measure(
    bench: &Bench,
    args: &QuadsArgs,
    subjects: &[Subject],
    covered: Option<&[bool]>,
) -> Result<Vec<Row>, Failure> {
    let (mut jobs, mut forwards) = (Vec::new(), Vec::new());
    for subject in subjects {
        match &subject.drawn {
            Drawn::Pass(pass, uploaded) => jobs.push(Job {
                pass,
                uploaded,
                size: args.size,
            }),
            Drawn::Forward(forward) => forwards.push(forward),
        }
    }
    let bar = scene::bar(&format!("timing {} shaders", jobs.len()));
    bar.set_length(u64::from(args.rounds) + 1);
    let timed = bench.interleaved(&jobs, args.rounds, |k| bar.set_position(u64::from(k)));
    let (times, clock) = timed.map_err(Failure::of)?;
    let forward_times = bench.draw_in_turn(&forwards, args.rounds).map_err(Failure::of)?;
    bar.finish_and_clear();
    let (mut times, mut forward_times) = (times.into_iter(), forward_times.into_iter());
    let mut rows: Vec<Row> = Vec::new();
    for subject in subjects {
        let (time, clock) = match subject.drawn {
            Drawn::Pass(..) => (times.next(), clock),
            Drawn::Forward(_) => (forward_times.next(), Clock::WallClock),
        };
        let Some(time) = time else { continue };
        let first = subjects.iter().find(|s| s.family == subject.family).unwrap_or(subject);
        let forward = FAMILIES.iter().any(|f| f.name == subject.family && f.forward);
        let dispatched = matches!(subject.drawn, Drawn::Pass(..));
        let like = |(of, _): &(&Subject, &Row)| {
            of.family == subject.family && (!forward || matches!(of.drawn, Drawn::Pass(..)) == dispatched)
        };
        let baseline = subjects.iter().zip(&rows).find(like).map_or(time, |(_, row)| row.time);
        let (mean, largest) = differences(&subject.image, &first.image, covered.filter(|_| forward));
        rows.push(Row {
            family: subject.family,
            way: subject.way.to_owned(),
            transport: subject.transport.clone(),
            reads: subject.counts.texture_reads,
            messages: subject.counts.messages,
            statements: subject.counts.statements,
            time,
            clock,
            ratio: baseline.median_ms / time.median_ms,
            mean_difference: mean,
            largest_difference: largest,
        });
    }
    Ok(rows)
}

/// Mean and largest difference over all colours, of the pixels that are covered; of all pixels, if nothing says which are. A
/// pixel in full shadow is covered, and its colour is 0.
fn differences(a: &Frame<Vec4>, b: &Frame<Vec4>, covered: Option<&[bool]>) -> (f64, f64) {
    let pairs = a.texels().iter().zip(b.texels()).enumerate();
    let counted = pairs.filter(|(k, _)| covered.is_none_or(|covered| covered[*k]));
    let (mut sum, mut largest, mut count) = (0.0, 0.0f64, 0.0);
    for (_, (a, b)) in counted {
        let off = f64::from((a.truncate() - b.truncate()).abs().max_element());
        sum += off;
        count += 1.0;
        largest = largest.max(off);
    }
    (sum / f64::max(count, 1.0), largest)
}

fn print(args: &QuadsArgs, record: &Record) -> Result<(), Failure> {
    let json = serde_json::to_string_pretty(record).map_err(Failure::of)? + "\n";
    if let Some(path) = &args.record {
        files::write(path, json.as_bytes()).map_err(Failure::of)?;
    }
    if args.json {
        out!("{json}");
        return Ok(());
    }
    let [width, height] = record.size;
    outln!(
        "{}, {width}x{height}, {} rounds in turn, {}\n{}\n",
        record.adapter,
        record.rounds,
        record.date,
        record.quads
    );
    let cells = |row: &Row| {
        vec![
            row.family.to_owned(),
            row.way.clone(),
            row.transport.clone(),
            row.reads.to_string(),
            row.messages.to_string(),
            format!(
                "{:.2} ({:.2} to {:.2})",
                row.time.median_ms, row.time.min_ms, row.time.max_ms
            ),
            format!("{:.2}{}", row.ratio, if row.ratio < 1.0 { " slower" } else { "" }),
            format!("{:.1e}", row.mean_difference),
            format!("{:.1e}", row.largest_difference),
        ]
    };
    let rows: Vec<Vec<String>> = record.rows.iter().map(cells).collect();
    let head = [
        "filter",
        "way",
        "messages by",
        "reads",
        "messages",
        "ms",
        "times as fast",
        "mean off",
        "largest",
    ];
    out!("{}", table::render(&head, &rows));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shadows_count_and_what_is_not_drawn_does_not() {
        let frame = |values: [f32; 4]| Frame::new(glam::uvec2(4, 1), values.map(Vec4::splat).to_vec());
        // In the umbra one is 0 and the other is not; the last pixel is sky.
        let (a, b) = (frame([0.0, 0.5, 1.0, 0.0]), frame([0.25, 0.5, 1.0, 1.0]));
        let covered = [true, true, true, false];
        assert_eq!(differences(&a, &b, Some(&covered)), (0.25 / 3.0, 0.25));
        assert_eq!(differences(&a, &b, None), (1.25 / 4.0, 1.0));
    }
}

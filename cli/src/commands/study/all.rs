//! `study all`: every record of the documents, taken again, each by a process of its own.

use super::ProgressBars;
use crate::args::{AdapterArgs, AllArgs, CommonArgs};
use crate::failure::{Failure, format_count};
use crate::gpu::Gpu;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use straightline_codegen::shorten;
use straightline_study::progress::Progress;
use straightline_study::record::read_file;
use straightline_study::steps::{Folders, Step, Steps};

/// A step with its folder and its command.
struct Planned {
    step: &'static Step,
    folder: PathBuf,
    command: Vec<String>,
    seconds: u32,
}

/// Takes every record that is not complete in the folder, and says how long it takes.
pub fn take_records(common: &CommonArgs, args: &AllArgs, progress: &ProgressBars) -> Result<(), Failure> {
    let chosen = choose_steps(&args.only)?;
    check_request(common, args, &chosen)?;
    let plan: Vec<Planned> = chosen.iter().map(|step| plan_step(step, common)).collect();
    let (done, rest): (Vec<_>, Vec<_>) = plan.into_iter().partition(|planned| is_complete(planned, common));
    let mut adapters = BTreeMap::new();
    let (skipped, rest): (Vec<_>, Vec<_>) = rest
        .into_iter()
        .map(|planned| (find_obstacle(planned.step, &mut adapters), planned))
        .partition(|(obstacle, _)| obstacle.is_some());
    let mut left: u32 = rest.iter().map(|(_, planned)| planned.seconds).sum();
    outln!(
        "{}, about {} on two cores; {} complete already, {} skipped",
        format_count(rest.len(), "record"),
        format_seconds(f64::from(left)),
        done.len(),
        skipped.len()
    );
    for (obstacle, planned) in &skipped {
        outln!(
            "skipped: {}: {}",
            planned.step.record,
            obstacle.as_deref().unwrap_or_default()
        );
    }
    if args.only.is_empty() {
        for other in &Steps::list().others {
            outln!("by another program: {}: {}", other.record, other.command);
        }
    }
    let (mut failed, mut expected, began) = (Vec::new(), 0, Instant::now());
    for (k, (_, planned)) in rest.iter().enumerate() {
        let name = &planned.step.record;
        outln!(
            "\n{}/{} {name}: about {}",
            k + 1,
            rest.len(),
            format_seconds(planned.seconds.into())
        );
        outln!("straightline {}", quote_words(&planned.command));
        crate::output::flush_output()?;
        let start = Instant::now();
        let outcome = run_step(planned, common);
        if progress.is_stopped() && !is_complete(planned, common) {
            return Err(Failure::Interrupted(format!(
                "{name} was interrupted; the same command again goes on with it"
            )));
        }
        left -= planned.seconds;
        expected += planned.seconds;
        // The speed of this machine, by the steps until now.
        let pace = began.elapsed().as_secs_f64() / f64::from(expected.max(1));
        outln!(
            "took {}; about {} left",
            format_seconds(start.elapsed().as_secs_f64()),
            format_seconds(f64::from(left) * pace)
        );
        if let Err(why) = outcome {
            errln!("{name} failed: {why}");
            failed.push(name.as_str());
        }
        if progress.is_stopped() {
            return Err(Failure::Interrupted(
                "stopped; the same command again goes on".to_owned(),
            ));
        }
    }
    match failed.is_empty() {
        true => Ok(()),
        false => Err(Failure::Failed(format!(
            "{} failed: {}; the same command again takes them alone",
            format_count(failed.len(), "record"),
            failed.join(", ")
        ))),
    }
}

/// Returns the requested steps, or all of them.
fn choose_steps(only: &[String]) -> Result<Vec<&'static Step>, Failure> {
    let all = &Steps::list().steps;
    let names: Vec<&str> = all.iter().map(|step| step.record.as_str()).collect();
    if let Some(unknown) = only.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(Failure::Usage(format!(
            "no record is called `{}`; there are {}",
            shorten(unknown),
            names.join(", ")
        )));
    }
    let is_chosen = |step: &&Step| only.is_empty() || only.contains(&step.record);
    Ok(all.iter().filter(is_chosen).collect())
}

/// Refuses a request that does not say how long it may take, or contradicts the steps.
fn check_request(common: &CommonArgs, args: &AllArgs, chosen: &[&Step]) -> Result<(), Failure> {
    if common.size.is_some() || common.rounds.is_some() || common.adapter.adapter.is_some() {
        return Err(Failure::Usage(
            "each record has its own size, rounds and adapter: leave out --size, --rounds and --adapter".to_owned(),
        ));
    }
    if common.quick != args.full {
        return Ok(());
    }
    let about = |quick: bool| {
        let seconds: u32 = chosen.iter().map(|step| step.expected_seconds(quick)).sum();
        format_seconds(seconds.into())
    };
    Err(Failure::Usage(format!(
        "add --quick (about {}) or --full (about {})",
        about(true),
        about(false)
    )))
}

fn plan_step(step: &'static Step, common: &CommonArgs) -> Planned {
    let folder = common.out.join("steps").join(&step.record);
    let folders = Folders {
        records: &common.out,
        own: &folder,
    };
    Planned {
        step,
        command: step.command(common.quick, folders),
        seconds: step.expected_seconds(common.quick),
        folder,
    }
}

/// Returns whether the folder has the record, not interrupted and of this command.
fn is_complete(planned: &Planned, common: &CommonArgs) -> bool {
    let path = common.out.join(format!("{}.json", planned.step.record));
    is_record_of(&path, &planned.command)
}

/// Returns whether a file is a complete record of a command. Only the names of files count, not their folders.
fn is_record_of(path: &Path, command: &[String]) -> bool {
    let record = read_file(path).ok();
    let Some(record) = record.and_then(|text| serde_json::from_slice::<serde_json::Value>(&text).ok()) else {
        return false;
    };
    let last = |word: &str| word.rsplit('/').next().unwrap_or(word).to_owned();
    let words = |text: &str| text.split(' ').map(last).collect::<Vec<_>>();
    let own = words(&format!("straightline {}", command.join(" ")));
    record["complete"] != false && record["command"].as_str().map(words) == Some(own)
}

/// Returns the reason why a step cannot run here. `adapters` has the answers of earlier calls.
fn find_obstacle(step: &Step, adapters: &mut BTreeMap<String, Option<String>>) -> Option<String> {
    if let Some(file) = step.files().find(|file| !Path::new(file).exists()) {
        return Some(format!("there is no {file} in this folder"));
    }
    let adapter = step.option("--adapter")?;
    let open = || {
        let args = AdapterArgs {
            adapter: Some(adapter.to_owned()),
        };
        Gpu::require(&args)
            .err()
            .map(|_| format!("there is no adapter `{adapter}`"))
    };
    adapters.entry(adapter.to_owned()).or_insert_with(open).clone()
}

/// Runs a step in its folder, and moves the record to its place. Printed lines go to `output.txt`.
fn run_step(planned: &Planned, common: &CommonArgs) -> Result<(), String> {
    let text = |error: &dyn std::fmt::Display| error.to_string();
    std::fs::create_dir_all(&planned.folder).map_err(|error| text(&error))?;
    let program = std::env::current_exe().map_err(|error| text(&error))?;
    let folders = Folders {
        records: &common.out,
        own: &planned.folder,
    };
    let mut commands = planned.step.inputs(folders);
    commands.push([&["straightline".to_owned()], planned.command.as_slice()].concat());
    let output = planned.folder.join("output.txt");
    let output = std::fs::File::create(&output).map_err(|error| text(&error))?;
    for command in &commands {
        let name = match command[0].as_str() {
            "straightline" => program.as_os_str(),
            other => other.as_ref(),
        };
        let output = output.try_clone().map_err(|error| text(&error))?;
        let mut run = Command::new(name);
        run.args(&command[1..]).stdin(Stdio::null()).stdout(output);
        let status = run.status().map_err(|error| format!("`{}`: {error}", command[0]))?;
        if !status.success() {
            return Err(format!("`{}` ended with {status}", command.join(" ")));
        }
    }
    let written = |extension: &str| planned.folder.join(&planned.step.writes).with_extension(extension);
    if !is_record_of(&written("json"), &planned.command) {
        return Err("its record is not complete".to_owned());
    }
    // The CSV first: a record that is there is complete.
    for extension in ["csv", "json"] {
        let to = common.out.join(format!("{}.{extension}", planned.step.record));
        if written(extension).exists() {
            std::fs::rename(written(extension), to).map_err(|error| text(&error))?;
        }
    }
    Ok(())
}

/// Joins words as a shell reads them.
fn quote_words(words: &[String]) -> String {
    let is_plain = |word: &str| word.chars().all(|c| c.is_alphanumeric() || "-_=,./:+".contains(c));
    let quote = |word: &String| match is_plain(word) {
        true => word.clone(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    };
    words.iter().map(quote).collect::<Vec<_>>().join(" ")
}

/// Formats a duration: `40 s`, `12 min`, `2 h 5 min`.
fn format_seconds(seconds: f64) -> String {
    let whole = Duration::from_secs_f64(seconds.max(0.0)).as_secs_f64().round() as u64;
    match whole {
        0..=119 => format!("{whole} s"),
        120..=7199 => format!("{} min", (whole + 30) / 60),
        _ => format!("{} h {} min", whole / 3600, whole % 3600 / 60),
    }
}

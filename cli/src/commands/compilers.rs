//! `isa`: GPUs that this machine can compile for, without having them.

use super::study::isa::start_compiler;
use crate::args::{CompilersArgs, Gpus};
use crate::failure::Failure;
use serde_json::json;
use straightline_isa::{Gpu, IsaError};
use straightline_table::{Column, Table};

/// A GPU, and the driver's name for it or the reason why it cannot be compiled for.
type Answer = (Gpu, Result<String, IsaError>);

/// Starts the compiler for every GPU, and prints which of them answered.
pub fn list_compilers(args: &CompilersArgs) -> Result<(), Failure> {
    let mut gpus = Gpus::distinct(&args.gpu);
    if gpus.is_empty() {
        gpus = Gpu::all().chain([Gpu::DEVICE]).collect();
    }
    let ask = |gpu| start_compiler(gpu).map(|compiler| compiler.device().to_owned());
    let answers: Vec<Answer> = gpus.into_iter().map(|gpu| (gpu, ask(gpu))).collect();
    match args.json {
        true => print_json(&answers),
        false => print_tables(&answers),
    }
    Ok(())
}

fn print_json(answers: &[Answer]) {
    let each = answers.iter().map(|(gpu, answer)| {
        json!({
            "gpu": gpu,
            "about": gpu.about(),
            "device": answer.as_ref().ok(),
            "refused": answer.as_ref().err().map(IsaError::to_string),
        })
    });
    outln!("{:#}", json!({ "gpus": each.collect::<Vec<_>>() }));
}

fn print_tables(answers: &[Answer]) {
    let can = answers
        .iter()
        .filter_map(|(gpu, answer)| Some((gpu, answer.as_ref().ok()?)));
    let table = Table::of(can)
        .column(Column::from("GPU").left(), |(gpu, _)| gpu.to_string())
        .column(Column::from("about").left(), |(gpu, _)| gpu.about())
        .column(Column::from("driver's name for it").left(), |(_, device)| {
            device.as_str()
        })
        .finish();
    outln!("{}", table.to_text());
    let mut said_of = None;
    for (gpu, answer) in answers {
        let Err(why) = answer else { continue };
        // A vendor without a driver is one line, not one for each of its GPUs.
        if !why.is_of_vendor() || said_of != Some(gpu.vendor_name()) {
            outln!("{why}");
        }
        said_of = why.is_of_vendor().then_some(gpu.vendor_name());
    }
}

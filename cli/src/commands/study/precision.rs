//! `study precision`: values of a kernel that may be computed in half precision.

use super::isa::start_compiler;
use super::sweep::given::Given;
use super::{ProgressBars, on_processor};
use crate::args::{CommonArgs, Gpus, PrecisionArgs};
use crate::failure::Failure;
use glam::UVec2;
use straightline_study::precision::{PrecisionError, Question, search_precision};
use straightline_study::record::{PrecisionRecord, Record};

/// Size of the test card: an interpreter computes each choice.
const SIZE: UVec2 = UVec2::new(96, 54);

/// Searches, prints the table and the proposal, and writes the record.
pub fn find_precision(common: &CommonArgs, args: &PrecisionArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let kernel = args.kernel.locate_kernel().map_err(Failure::Kernel)?;
    let settings = args.kernel.options.settings();
    let whole = kernel.compile(&settings).map_err(Failure::Kernel)?;
    let size = common.size.unwrap_or(SIZE);
    let given = Given::new(common, &args.inputs, size, std::slice::from_ref(&whole));
    let inputs = given.variant_inputs(&whole)?;
    let compilers = Gpus::distinct(&args.isa).into_iter().map(start_compiler);
    let mut compilers: Vec<_> = compilers.collect::<Result<_, _>>().map_err(Failure::from_error)?;
    let question = Question {
        kernel: &kernel,
        settings: &settings,
        inputs: &inputs,
        max_error: args.max_error,
    };
    let found = search_precision(&question, &mut compilers, progress);
    progress.clear_bar();
    let (found, judged) = found.map_err(|error| match error {
        PrecisionError::Interrupted => Failure::Interrupted(error.to_string()),
        other => Failure::from_error(other),
    })?;
    let record = PrecisionRecord {
        circumstances: on_processor(inputs.size, 0),
        kernel: kernel.name().to_owned(),
        options: settings.option_texts(),
        input: given.to_string(),
        max_error: args.max_error,
        devices: compilers
            .iter()
            .map(|compiler| (compiler.gpu().to_string(), compiler.device().to_owned()))
            .collect(),
        choices: found.choices,
        proposals: found.proposals,
        judged,
    };
    record.write(&common.out).map_err(Failure::from_error)?;
    print(&record);
    Ok(())
}

fn print(record: &PrecisionRecord) {
    outln!("{}", record.to_table().to_text());
    outln!(
        "error: largest difference from f64 on {} at {}x{}, without the thousandth of the pixels that differ most",
        record.input,
        record.circumstances.size[0],
        record.circumstances.size[1]
    );
    outln!("cost: cycles, else instructions, over those of full precision");
    outln!(
        "\nThe cheapest of {} choices with an error of at most {}:",
        record.judged,
        record.max_error
    );
    for proposal in &record.proposals {
        let names = Vec::from_iter(proposal.lowered.half.iter().cloned()).join(",");
        let choice = match names.is_empty() {
            true => "full precision".to_owned(),
            false => format!("--half {names}"),
        };
        outln!("  {}: {choice}", proposal.gpus.join(", "));
    }
}

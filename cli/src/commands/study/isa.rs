//! `study isa`: statistics of GPU compilers for shaders, without the GPUs.

use super::{ProgressBars, command_line, current_time, loops};
use crate::args::{CommonArgs, Gpus, IsaArgs};
use crate::failure::Failure;
use std::path::PathBuf;
use straightline_isa::{Compiler, Gpu, IsaError};
use straightline_study::isa::{self, Asking, IsaStudyError, Question};
use straightline_study::record::{IsaRecord, Record};

/// Name of the hidden command that runs in a compiler's process.
pub const SERVE: &str = "serve-isa";

/// Starts a compiler: this program, called as [`SERVE`].
pub fn start_compiler(gpu: Gpu) -> Result<Compiler, IsaError> {
    let program = std::env::current_exe().map_err(|error| IsaError::Process(gpu, error))?;
    Compiler::start(&program, &[SERVE], gpu)
}

/// Compiles, prints, and writes the record.
pub fn measure_isa(common: &CommonArgs, args: &IsaArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let subjects = loops::choose_subjects(common, &args.from, &args.by_hand)?;
    let mut askings: Vec<Asking> = subjects.into_iter().map(Asking::from).collect();
    if args.from.is_empty() {
        askings.extend(isa::further_askings().map_err(Failure::Kernel)?);
    }
    let glslang = find_glslang();
    if glslang.is_none() {
        errln!("there is no glslangValidator, so GLSL is not asked about; on Debian: apt-get install glslang-tools");
    }
    let question = Question {
        gpus: Gpus::distinct(&args.gpu),
        program: (
            std::env::current_exe().map_err(Failure::from_error)?,
            vec![SERVE.to_owned()],
        ),
        glslang,
    };
    let asked = isa::ask_compilers(&question, &askings, command_line(), current_time(), progress);
    progress.clear_bar();
    let record = asked.map_err(|error| match error {
        IsaStudyError::Kernel { errors, .. } => Failure::Kernel(errors),
        other => Failure::from_error(other),
    })?;
    record.write(&common.out).map_err(Failure::from_error)?;
    print(&record);
    Ok(())
}

/// Returns the path of glslang's executable.
fn find_glslang() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let programs = std::env::split_paths(&path).map(|folder| folder.join("glslangValidator"));
    programs.into_iter().find(|program| program.is_file())
}

fn print(record: &IsaRecord) {
    for (gpu, device) in &record.devices {
        outln!("{gpu}: {device}\n\n{}", record.of_gpu(*gpu).to_table().to_text());
    }
    for why in record.absent.values() {
        outln!("{why}");
    }
    for asked in &record.shaders {
        if let Some(why) = &asked.refused {
            outln!(
                "{}, {}, {}: {why}",
                asked.kernel,
                asked.form.display_name(),
                asked.path.display_name()
            );
        }
    }
}

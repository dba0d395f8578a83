//! The command that `check` runs first, so that an editor needs one command for all diagnostics.

use crate::args::MessageFormat;
use crate::failure::Failure;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

/// Runs the command to its end and passes on its output. The inner result holds the exit status as an error if the command
/// failed.
///
/// # Errors
///
/// If the command cannot be started.
pub fn run_command(command: &[String], format: MessageFormat) -> Result<Result<(), String>, Failure> {
    let Some((program, arguments)) = command.split_first() else {
        return Ok(Ok(()));
    };
    let refused = |error| Failure::Failed(format!("cannot run `{program}`: {error}"));
    let mut started = Command::new(program);
    started.args(arguments);
    if format == MessageFormat::Json {
        started.stdout(Stdio::piped());
    }
    let mut child = started.spawn().map_err(refused)?;
    pass_on(&mut child).map_err(refused)?;
    let status = child.wait().map_err(refused)?;
    Ok(match status.success() {
        true => Ok(()),
        false => Err(format!("`{}` failed: {status}", command.join(" "))),
    })
}

/// Passes on the lines of the command except cargo's final `build-finished` message: more messages follow.
fn pass_on(child: &mut Child) -> std::io::Result<()> {
    let Some(stdout) = child.stdout.take() else {
        return Ok(());
    };
    let mut stdout = BufReader::new(stdout);
    let mut line = Vec::new();
    while stdout.read_until(b'\n', &mut line)? > 0 {
        let text = String::from_utf8_lossy(&line);
        if !text.starts_with(r#"{"reason":"build-finished""#) {
            outln!("{}", text.trim_end_matches(['\n', '\r']));
        }
        line.clear();
    }
    Ok(())
}

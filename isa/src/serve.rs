//! The process that the driver is loaded into: requests in, figures out, a line each.

use super::device::Device;
use super::figures::Report;
use serde::{Deserialize, Serialize};
use std::io::{BufRead, Write};

/// A shader to compile.
#[derive(Serialize, Deserialize)]
pub(crate) struct Request {
    /// The SPIR-V.
    pub words: Vec<u32>,
    /// Name of the entry point.
    pub entry: String,
}

/// Output of the process: first its device's name, then the figures of each request.
#[derive(Serialize, Deserialize)]
pub(crate) enum Answer {
    /// The GPU that is compiled for, and the driver's version.
    Device(String),
    /// Report on the requested shader.
    Report(Report),
    /// Reason why there is no result.
    Error(String),
}

/// Serves the requests of a [`Compiler`](super::Compiler) in the parent process, until there are no more.
///
/// # Errors
///
/// If the parent process cannot be read from or written to.
pub fn serve() -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    let mut say = |answer: Answer| {
        writeln!(out, "{}", serde_json::to_string(&answer)?)?;
        out.flush()
    };
    let device = match Device::open() {
        Ok(device) => device,
        Err(why) => return say(Answer::Error(why)),
    };
    say(Answer::Device(device.name.clone()))?;
    for line in std::io::stdin().lock().lines() {
        let request: Request = serde_json::from_str(&line?)?;
        say(match device.compile(&request.words, &request.entry) {
            Ok(report) => Answer::Report(report),
            Err(why) => Answer::Error(why),
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_read_as_they_were_written() {
        let report = Report::default();
        let text = serde_json::to_string(&Answer::Report(report.clone())).unwrap();
        assert!(matches!(serde_json::from_str(&text).unwrap(), Answer::Report(found) if found == report));
    }
}

//! The only module that writes to standard output and standard error. Neither ever makes the program panic.
//!
//! A closed pipe is not an error: later output is dropped, and the work goes on. Any other failure of standard output
//! becomes an error at the end of the program.

use crate::failure::Failure;
use std::fmt::Arguments;
use std::io::{self, ErrorKind, Write};
use std::sync::Mutex;

/// First error of standard output.
static REFUSED: Mutex<Option<io::Error>> = Mutex::new(None);

/// Maximum length of a line of an error message, in characters.
const LONGEST: usize = 1000;

/// Prints to standard output.
pub fn print(text: Arguments<'_>) {
    write_unless_refused(|| io::stdout().write_fmt(text));
}

/// Prints to standard error.
pub fn note(text: Arguments<'_>) {
    // Nothing is left to do if even errors cannot be written.
    let _ = io::stderr().write_fmt(text);
}

/// Flushes standard output. Fails if a write failed earlier, except for a closed pipe.
pub fn flush_output() -> Result<(), Failure> {
    write_unless_refused(|| io::stdout().flush());
    let refused = REFUSED.lock().ok().and_then(|mut refused| refused.take());
    match refused {
        Some(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Failed(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Returns whether a write to standard output failed. A program that prints until stopped then has no reader.
pub fn is_refused() -> bool {
    REFUSED.lock().map_or(true, |refused| refused.is_some())
}

fn write_unless_refused(write: impl FnOnce() -> io::Result<()>) {
    let Ok(mut refused) = REFUSED.lock() else { return };
    if refused.is_none()
        && let Err(error) = write()
    {
        *refused = Some(error);
    }
}

/// Returns the message with overlong lines shortened in the middle.
pub fn limit_lines(message: &str) -> String {
    let shortened = |line: &str| {
        let count = line.chars().count();
        if count <= LONGEST {
            return line.to_owned();
        }
        let head: String = line.chars().take(LONGEST / 2).collect();
        let tail: String = line.chars().skip(count - LONGEST / 2).collect();
        format!("{head}[{} characters]{tail}", count - 2 * (LONGEST / 2))
    };
    message.split('\n').map(shortened).collect::<Vec<_>>().join("\n")
}

/// `print!` through [`print()`].
macro_rules! out {
    ($($text:tt)*) => { $crate::output::print(format_args!($($text)*)) };
}

/// `println!` through [`print()`].
macro_rules! outln {
    () => { $crate::output::print(format_args!("\n")) };
    ($($text:tt)*) => { $crate::output::print(format_args!("{}\n", format_args!($($text)*))) };
}

/// `eprintln!` through [`note`].
macro_rules! errln {
    ($($text:tt)*) => { $crate::output::note(format_args!("{}\n", format_args!($($text)*))) };
}

#[cfg(test)]
mod tests {
    use super::limit_lines;

    #[test]
    fn long_lines_are_shortened() {
        let text = limit_lines(&format!("error: `{}` is no size\nuse 1x1\n", "9".repeat(100_000)));
        assert!(text.len() < 1100 && text.starts_with("error: `9999") && text.ends_with("` is no size\nuse 1x1\n"));
        assert_eq!(limit_lines("a\nb\n"), "a\nb\n");
    }
}

//! Choices as a text, one a line.

use super::{Choice, Choices};
use crate::Error;
use std::fmt;
use std::str::FromStr;

/// First line of a text.
const HEAD: &str = "# straightline choices 1";

/// A line for each choice, its fields separated by tabs: kernel, hash of the candidates, device, name, times.
impl fmt::Display for Choices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{HEAD}")?;
        for Choice {
            kernel,
            hash,
            device,
            name,
            times,
        } in &self.entries
        {
            writeln!(f, "{kernel}\t{hash}\t{device}\t{name}\t{times}")?;
        }
        Ok(())
    }
}

/// Reads the text of [`Display`](fmt::Display). Empty lines, and lines that start with `#`, are passed over after the first.
impl FromStr for Choices {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let refused = |line: usize, problem: &str| Error::Choices {
            line,
            problem: problem.to_owned(),
        };
        if text.lines().next().map(str::trim_end) != Some(HEAD) {
            return Err(refused(1, &format!("it has to be `{HEAD}`")));
        }
        let mut choices = Choices::new();
        for (line, number) in text.lines().zip(1..) {
            if line.trim().is_empty() || line.starts_with('#') {
                continue;
            }
            let fields: Vec<&str> = line.split('\t').collect();
            let [kernel, hash, device, name, times] = fields[..] else {
                return Err(refused(number, "it needs five fields, separated by tabs"));
            };
            if hash.len() != 16 || !hash.bytes().all(|byte| byte.is_ascii_hexdigit()) {
                return Err(refused(number, "its second field is no hash of 16 hexadecimal digits"));
            }
            let [kernel, hash, device, name, times] = [kernel, hash, device, name, times].map(str::to_owned);
            choices.remember(Choice {
                kernel,
                hash,
                device,
                name,
                times,
            });
        }
        Ok(choices)
    }
}

/// Lists median times in milliseconds, such as `default 0.213 ms, looped 0.410 ms`.
pub(super) fn list_times<'a>(names: impl Iterator<Item = &'a str>, rounds: &[Vec<f64>]) -> String {
    let each = names
        .zip(rounds)
        .map(|(name, times)| format!("{name} {:.3} ms", super::timing::median(times)));
    each.collect::<Vec<_>>().join(", ")
}

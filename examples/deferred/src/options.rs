//! Drawing options from the command line or from the address of a page.

use crate::{Failure, Size};
use std::fmt;

pub struct Options {
    /// File to save a picture as.
    pub out: Option<String>,
    pub size: Size,
    /// Fixed time in seconds. Without it time advances, and a saved picture is of second 2.
    pub time: Option<f32>,
    pub parts: Parts,
    /// Enables the timestamps of software drivers as well.
    pub timestamps: bool,
}

/// Enabled parts: SRAA and its extensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    pub sraa: bool,
    /// Shades a pixel where it has a surface that no pixel centre shows.
    pub placing: bool,
    /// Searches farther for surfaces that no nearby shading sample shows.
    pub searching: bool,
    /// Borrows light without the albedo of the lit surface.
    pub demodulating: bool,
    /// Shades each frame at a different position in its pixels, and borrows from earlier frames.
    pub history: bool,
}

impl Parts {
    pub const ALL: Parts = Parts { sraa: true, placing: true, searching: true, demodulating: true, history: true };

    /// Returns each part with its name and its key.
    fn each(&mut self) -> [(&mut bool, &'static str, &'static str); 5] {
        [
            (&mut self.sraa, "SRAA", "Space"),
            (&mut self.placing, "placing", "P"),
            (&mut self.searching, "searching", "S"),
            (&mut self.demodulating, "demodulating", "D"),
            (&mut self.history, "history", "H"),
        ]
    }

    /// Toggles the part assigned to a key. Returns `false` if there is none.
    #[cfg(any(feature = "window", target_arch = "wasm32", test))]
    pub fn press(&mut self, key: &str) -> bool {
        let found = self.each().into_iter().find(|(_, _, own)| own.eq_ignore_ascii_case(key));
        found.map(|(on, ..)| *on = !*on).is_some()
    }

    fn turn_off(&mut self, name: &str) -> bool {
        let found = self.each().into_iter().find(|(_, own, _)| own.eq_ignore_ascii_case(name));
        found.map(|(on, ..)| *on = false).is_some()
    }
}

impl fmt::Display for Parts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = *self;
        for (k, (on, name, key)) in parts.each().into_iter().enumerate() {
            let (comma, state) = (if k == 0 { "" } else { ", " }, if *on { "on" } else { "off" });
            write!(f, "{comma}{name} {state} ({key})")?;
        }
        Ok(())
    }
}

impl Options {
    /// Parses `--name value`.
    pub fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Options, Failure> {
        let mut options = Options { out: None, size: [960, 540], time: None, parts: Parts::ALL, timestamps: false };
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--out" => options.out = Some(value()?),
                "--size" => options.size = parse_size(&value()?)?,
                "--time" => options.time = Some(value()?.parse()?),
                "--timestamps" => options.timestamps = true,
                _ if argument.strip_prefix("--without-").is_some_and(|part| options.parts.turn_off(part)) => {}
                _ => {
                    let there = "--out, --size, --time, --timestamps, and --without-sraa, -placing, -searching, -demodulating and -history";
                    return Err(format!("no option {argument}: there are {there}").into());
                }
            }
        }
        Ok(options)
    }

    /// Parses `?name=value&name`.
    #[cfg(any(target_arch = "wasm32", test))]
    pub fn of_address(query: &str) -> Result<Options, Failure> {
        let parts = query.trim_start_matches('?').split('&').filter(|part| !part.is_empty());
        let arguments = parts.flat_map(|part| {
            let (name, value) = part.split_once('=').map_or((part, None), |(name, value)| (name, Some(value)));
            std::iter::once(format!("--{name}")).chain(value.map(str::to_owned))
        });
        Options::parse(arguments)
    }
}

fn parse_size(text: &str) -> Result<Size, Failure> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match sides {
        Some(size) if size.iter().all(|side| (1..=8192).contains(side)) => Ok(size),
        _ => Err(format!("{text} is not a size such as 1280x720, up to 8192x8192").into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_says_what_the_command_line_does() {
        let options = Options::of_address("?size=320x180&time=2.5&without-sraa").unwrap();
        assert_eq!((options.size, options.time, options.parts.sraa), ([320, 180], Some(2.5), false));
        let options = Options::of_address("").unwrap();
        assert_eq!((options.size, options.time, options.parts), ([960, 540], None, Parts::ALL));
        let options = Options::of_address("?without-placing&without-searching&without-demodulating&without-history").unwrap();
        let alone = Parts { sraa: true, placing: false, searching: false, demodulating: false, history: false };
        assert_eq!(options.parts, alone);
        for wrong in ["?size=0x4", "?size", "?colour=red", "?time=noon", "?without-shadows", "?without-"] {
            assert!(Options::of_address(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn each_part_has_a_key() {
        let mut parts = Parts::ALL;
        for key in ["Space", "p", "S", "D", "h"] {
            assert!(parts.press(key), "{key}");
        }
        assert_eq!(parts.to_string(), "SRAA off (Space), placing off (P), searching off (S), demodulating off (D), history off (H)");
        assert!(!parts.press("x") && parts.press("d") && parts.demodulating);
    }
}

//! Options from the command line or from the address of a page.

use crate::antialiasing::{Antialiasing, Preset};
use crate::{Failure, Size};

pub struct Options {
    /// File to save a picture as.
    pub out: Option<String>,
    /// Compares all choices, without a window.
    pub table: bool,
    pub antialiasing: Antialiasing,
    pub size: Size,
    /// Fixed time in seconds. Without it time advances, and a saved picture is of second 2.
    pub time: Option<f32>,
    /// Enables the timestamps of software drivers as well.
    pub timestamps: bool,
}

impl Options {
    /// Parses `--name value`.
    pub fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Options, Failure> {
        let mut options = Options {
            out: None,
            table: false,
            antialiasing: Antialiasing::Sraa(Preset::Guided),
            size: [960, 540],
            time: None,
            timestamps: false,
        };
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--out" => options.out = Some(value()?),
                "--table" => options.table = true,
                "--preset" => options.antialiasing = value()?.parse()?,
                "--size" => options.size = parse_size(&value()?)?,
                "--time" => options.time = Some(value()?.parse()?),
                "--timestamps" => options.timestamps = true,
                _ => {
                    let there = "--preset, --out, --table, --size, --time and --timestamps";
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
        let options = Options::of_address("?size=320x180&time=2.5&preset=full").unwrap();
        assert_eq!((options.size, options.time), ([320, 180], Some(2.5)));
        assert_eq!(options.antialiasing, Antialiasing::Sraa(Preset::Full));
        let options = Options::of_address("").unwrap();
        assert_eq!((options.size, options.time), ([960, 540], None));
        assert_eq!(options.antialiasing, Antialiasing::Sraa(Preset::Guided));
        for wrong in ["?size=0x4", "?size", "?colour=red", "?time=noon", "?preset", "?preset=best"] {
            assert!(Options::of_address(wrong).is_err(), "{wrong}");
        }
    }
}

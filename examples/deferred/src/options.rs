//! What to draw, as the command line or the address of a page says.

use crate::{Failure, Size};

pub struct Options {
    /// A file to save a picture as.
    pub out: Option<String>,
    pub size: Size,
    /// The moment in seconds; otherwise time goes on, and a picture is of second 2.
    pub time: Option<f32>,
    pub sraa: bool,
    /// Whether the timestamps of software drivers are used too.
    pub timestamps: bool,
}

impl Options {
    /// Reads `--name value`.
    pub fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Options, Failure> {
        let mut options = Options { out: None, size: [960, 540], time: None, sraa: true, timestamps: false };
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--out" => options.out = Some(value()?),
                "--size" => options.size = parse_size(&value()?)?,
                "--time" => options.time = Some(value()?.parse()?),
                "--without-sraa" => options.sraa = false,
                "--timestamps" => options.timestamps = true,
                _ => {
                    let there = "--out, --size, --time, --without-sraa and --timestamps";
                    return Err(format!("no option {argument}: there are {there}").into());
                }
            }
        }
        Ok(options)
    }

    /// Reads `?name=value&name`.
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
        assert_eq!((options.size, options.time, options.sraa), ([320, 180], Some(2.5), false));
        let options = Options::of_address("").unwrap();
        assert_eq!((options.size, options.time, options.sraa), ([960, 540], None, true));
        for wrong in ["?size=0x4", "?size", "?colour=red", "?time=noon"] {
            assert!(Options::of_address(wrong).is_err(), "{wrong}");
        }
    }
}

//! A line of a shader, or of a kernel's source.

use std::str::FromStr;
use straightline_codegen::emit::Target;

/// A line whose counterpart is to be found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum At {
    /// A line of the text in a language, from 1.
    Text(Target, u32),
    /// A line of a source file, from 1.
    Source(String, u32),
}

impl FromStr for At {
    type Err = String;

    fn from_str(text: &str) -> Result<At, String> {
        let form = || format!("`{text}` is not a line: write 42, hlsl:42 or FILE.rs:12");
        let (before, line) = text.rsplit_once(':').unwrap_or(("", text));
        let line = line.parse().ok().filter(|line| *line > 0).ok_or_else(form)?;
        Ok(match before {
            "" if text.contains(':') => return Err(form()),
            "" => At::Text(Target::Wgsl, line),
            // A language's name has no dot, and a file has one.
            file if file.contains('.') => At::Source(file.to_owned(), line),
            target => At::Text(target.parse()?, line),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tells_texts_from_files() {
        let source = |file: &str, line| At::Source(file.to_owned(), line);
        for (text, at) in [
            ("42", At::Text(Target::Wgsl, 42)),
            ("hlsl:7", At::Text(Target::Hlsl, 7)),
            ("kernels/blur.rs:12", source("kernels/blur.rs", 12)),
        ] {
            assert_eq!(text.parse(), Ok(at), "{text}");
        }
        for text in ["", "0", "-1", ":4", "hlsl:", "perl:4", "blur.rs", "4294967296"] {
            assert!(text.parse::<At>().is_err(), "{text}");
        }
    }
}

//! Values of knobs as text: the spelling of the command line, `engine.toml` and the page's messages.

use super::{DebugInfo, Parameters, Register, Target, Texels};
use std::collections::BTreeSet;
use std::time::Duration;
use straightline_evaluator::policy::{Branches, LoopPolicy, Math, ReadOrder, Share, Transport, Unroll};
use straightline_evaluator::shorten;
use straightline_kernels::OptionText;
use straightline_manifest::{Form, Format, Origin, Precision, Stage};

/// Number of texts that a knob takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arity {
    /// No value: the knob is either set or not. As text, `true` or `false`.
    Flag,
    /// A single value.
    One,
    /// Any number of values, each in a separate text.
    Many,
}

/// Type of a knob.
pub(super) trait KnobValue: Sized {
    /// Number of texts of a value.
    const ARITY: Arity = Arity::One;

    /// Parses a value.
    ///
    /// # Errors
    ///
    /// If a text is not a valid value, with an example of one.
    fn from_texts(texts: &[&str]) -> Result<Self, String>;

    /// Returns texts that [`KnobValue::from_texts`] parses as this value; empty if it is not set.
    fn texts(&self) -> Vec<String>;
}

/// Returns the single text of a knob that takes one.
fn only<'a>(texts: &[&'a str]) -> Result<&'a str, String> {
    match texts {
        [text] => Ok(text),
        _ => Err(format!("it takes one value, and {} are given", texts.len())),
    }
}

/// Implements the trait for types that `Display` formats and `FromStr` parses.
macro_rules! spelled {
    ($($ty:ty),*) => {
        $(
            impl KnobValue for $ty {
                fn from_texts(texts: &[&str]) -> Result<Self, String> {
                    only(texts)?.parse()
                }

                fn texts(&self) -> Vec<String> {
                    vec![self.to_string()]
                }
            }
        )*
    };
}

spelled!(
    Unroll, Branches, ReadOrder, Share, Math, Transport, Stage, Form, Format, Origin, Precision, Texels, DebugInfo,
    Parameters
);

/// An optional value.
impl<T: KnobValue> KnobValue for Option<T> {
    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        match texts {
            [] => Ok(None),
            texts => T::from_texts(texts).map(Some),
        }
    }

    fn texts(&self) -> Vec<String> {
        self.as_ref().map_or_else(Vec::new, T::texts)
    }
}

impl KnobValue for bool {
    const ARITY: Arity = Arity::Flag;

    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        match only(texts)? {
            "true" => Ok(true),
            "false" => Ok(false),
            other => Err(format!("`{}` is neither `true` nor `false`", shorten(other))),
        }
    }

    fn texts(&self) -> Vec<String> {
        vec![self.to_string()]
    }
}

impl KnobValue for u32 {
    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        let text = only(texts)?;
        let digits = text.bytes().all(|byte| byte.is_ascii_digit());
        let number = digits.then(|| text.parse().ok()).flatten();
        number.ok_or_else(|| format!("`{}` is no number from 0 to {}", shorten(text), u32::MAX))
    }

    fn texts(&self) -> Vec<String> {
        vec![self.to_string()]
    }
}

/// Bytes in a unit of the memory limit.
const MEGABYTE: u64 = 1_000_000;

/// Largest memory limit, in millions of bytes.
const MOST_MEGABYTES: u64 = 1_000_000;

/// The memory limit, in bytes; as text in millions of bytes.
impl KnobValue for u64 {
    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        let text = only(texts)?;
        let megabytes = text.parse::<u64>().ok();
        let megabytes = megabytes.filter(|megabytes| (1..=MOST_MEGABYTES).contains(megabytes));
        let bytes = megabytes.map(|megabytes| megabytes * MEGABYTE);
        bytes.ok_or_else(|| {
            let text = shorten(text);
            format!("`{text}` is no number of megabytes from 1 to {MOST_MEGABYTES}")
        })
    }

    fn texts(&self) -> Vec<String> {
        vec![(self / MEGABYTE).to_string()]
    }
}

/// Seconds.
impl KnobValue for Duration {
    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        let text = only(texts)?;
        let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
        let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        time.ok_or_else(|| {
            let text = shorten(text);
            format!("`{text}` is no time: give a positive number of seconds, such as 60 or 0.5")
        })
    }

    fn texts(&self) -> Vec<String> {
        vec![self.as_secs_f64().to_string()]
    }
}

/// A name.
impl KnobValue for String {
    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        only(texts).map(str::to_owned)
    }

    fn texts(&self) -> Vec<String> {
        vec![self.clone()]
    }
}

/// Largest side of a block or workgroup that is parsed. Devices permit less, which is checked later.
const MOST_ACROSS: u32 = 8192;

/// Width and height: `8x4`.
impl KnobValue for [u32; 2] {
    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        let text = only(texts)?;
        let parsed = text
            .split_once('x')
            .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        let size = parsed.filter(|size| size.iter().all(|side| (1..=MOST_ACROSS).contains(side)));
        size.ok_or_else(|| {
            let text = shorten(text);
            format!("`{text}` is not a size such as 8x4, from 1x1 to {MOST_ACROSS}x{MOST_ACROSS}")
        })
    }

    fn texts(&self) -> Vec<String> {
        vec![format!("{}x{}", self[0], self[1])]
    }
}

/// Splits texts into words, separated by commas.
fn split_words<'a>(texts: &[&'a str]) -> impl Iterator<Item = &'a str> {
    texts.iter().flat_map(|text| text.split(','))
}

impl KnobValue for BTreeSet<Target> {
    const ARITY: Arity = Arity::Many;

    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        split_words(texts).map(str::parse).collect()
    }

    fn texts(&self) -> Vec<String> {
        self.iter().map(Target::to_string).collect()
    }
}

impl KnobValue for BTreeSet<String> {
    const ARITY: Arity = Arity::Many;

    fn from_texts(texts: &[&str]) -> Result<Self, String> {
        let word = |word: &str| match word.is_empty() {
            true => Err("an empty word: separate words by one comma".to_owned()),
            false => Ok(word.to_owned()),
        };
        split_words(texts).map(word).collect()
    }

    fn texts(&self) -> Vec<String> {
        self.iter().cloned().collect()
    }
}

/// Implements the trait for lists of names with values, each text `NAME=VALUE`.
macro_rules! named {
    ($($ty:ty, $form:literal, $such:literal, |$text:ident| $parse:expr;)*) => {
        $(
            impl KnobValue for Vec<$ty> {
                const ARITY: Arity = Arity::Many;

                fn from_texts(texts: &[&str]) -> Result<Self, String> {
                    let each = texts.iter().map(|text| {
                        let misshapen = || {
                            let text = shorten(text);
                            format!("`{text}` is not of the form {}, such as {}", $form, $such)
                        };
                        let named = text.split_once('=').filter(|(name, value)| !name.is_empty() && !value.is_empty());
                        let (name, $text) = named.ok_or_else(misshapen)?;
                        Ok((name.to_owned(), $parse.map_err(|why: Option<String>| why.unwrap_or_else(misshapen))?))
                    });
                    each.collect()
                }

                fn texts(&self) -> Vec<String> {
                    self.iter().map(|(name, value)| format!("{name}={value}")).collect()
                }
            }
        )*
    };
}

named! {
    OptionText, "OPTION=VALUE", "pattern=ordered16", |text| Ok(text.to_owned());
    LoopPolicy, "LOOP=POLICY", "sraa.tap=none", |text| text.parse().map_err(Some);
    (String, u32), "NAME=NUMBER", "depth=3", |text| text.parse().map_err(|_| None);
    (String, Register), "NAME=REGISTER", "depth=t3 or depth=t3,space1", |text| text.parse().map_err(Some);
}

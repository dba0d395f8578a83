//! Parsing of option values by their declarations.

use super::{Numeric, OptionInfo, OptionKind, canonical_number};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Scalar;
use crate::{is_close, shorten};
use straightline_kernels::{OptionText, OptionValue, OptionValues};

/// Keyword for an option that is set at run time.
const UNIFORM: &str = "uniform";

/// Keyword for an option that is set when the pipeline is created; its default may follow in parentheses.
const OVERRIDE: &str = "override";

/// Returns the text that makes an option an override, with the default `value` if one is set.
pub fn override_text(value: Option<&str>) -> String {
    match value {
        Some(value) if override_default(value).is_some() => value.to_owned(),
        value => format!("{OVERRIDE}({})", value.unwrap_or_default()),
    }
}

/// Default in the text of an override, empty for that of the declaration; `None` for any other text.
fn override_default(text: &str) -> Option<&str> {
    match text.strip_prefix(OVERRIDE)? {
        "" => Some(""),
        rest => rest.strip_prefix('(')?.strip_suffix(')'),
    }
}

/// Values of all options under `settings`, pairs of name and text.
///
/// # Errors
///
/// A diagnostic for each unknown or repeated name, and for each text that is not a valid value of its option.
pub fn parse_settings(
    kernel: &str,
    infos: &[OptionInfo],
    settings: &[OptionText],
) -> Result<OptionValues, Vec<Diagnostic>> {
    let mut errors = Vec::new();
    let mut values = OptionValues::default();
    for info in infos {
        match setting_value(info, settings) {
            Ok(value) => values.insert(info.name.clone(), value),
            Err(found) => errors.extend(found),
        }
    }
    let mut names: Vec<&str> = infos.iter().map(|info| info.name.as_str()).collect();
    names.sort_unstable();
    errors.extend(unknown_settings(kernel, &names, settings));
    match errors.is_empty() {
        true => Ok(values),
        false => Err(errors),
    }
}

/// Errors for settings that name none of the options `names`.
pub(in crate::eval) fn unknown_settings(kernel: &str, names: &[&str], settings: &[OptionText]) -> Vec<Diagnostic> {
    let unknown = settings.iter().filter(|(name, _)| !names.contains(&name.as_str()));
    let errors = unknown.map(|(name, _)| {
        let help = match names.iter().find(|known| is_close(name, known)) {
            Some(close) => format!("did you mean `{close}`?"),
            None if names.is_empty() => "it has no options".to_owned(),
            None => format!("its options are {}", names.join(", ")),
        };
        Diagnostic::new(Code::UnknownOption, format!("`{kernel}` has no option `{name}`")).help(help)
    });
    errors.collect()
}

/// Value of one option under `settings`.
pub(super) fn setting_value(info: &OptionInfo, settings: &[OptionText]) -> Result<OptionValue, Vec<Diagnostic>> {
    let mut set = settings.iter().filter(|(name, _)| *name == info.name);
    let Some((_, first)) = set.next() else {
        return Ok(info.default_value());
    };
    let mut errors = Vec::new();
    if let Some((_, again)) = set.next() {
        let error = Diagnostic::new(
            Code::OptionValue,
            format!(
                "the option `{}` is set twice, to `{}` and to `{}`",
                info.name,
                shorten(first),
                shorten(again)
            ),
        );
        errors.push(error.help("set it once"));
    }
    match parse(info, first) {
        Ok(value) if errors.is_empty() => return Ok(value),
        Ok(_) => {}
        Err(error) => errors.push(*error),
    }
    Err(errors)
}

/// Parses the value of an option.
fn parse(info: &OptionInfo, text: &str) -> Result<OptionValue, Box<Diagnostic>> {
    let refuse = |text: &str, allowed: String| {
        let what = format!("`{}` is not a value of the option `{}`", shorten(text), info.name);
        Box::new(Diagnostic::new(Code::OptionValue, what).help(allowed))
    };
    let is_choice =
        |name: &str| matches!(&info.kind, OptionKind::Choice(all) if all.iter().any(|(known, _)| known == name));
    if let Some(default) = override_default(text).filter(|_| !is_choice(text)) {
        return parse_override(info, default);
    }
    match &info.kind {
        OptionKind::Flag => match text {
            "true" => Ok(OptionValue::Flag(true)),
            "false" => Ok(OptionValue::Flag(false)),
            _ => Err(refuse(text, "use true or false".to_owned())),
        },
        OptionKind::Choice(choices) => match choices.iter().any(|(name, _)| name == text) {
            true => Ok(OptionValue::Choice(text.to_owned())),
            false => {
                let names: Vec<&str> = choices.iter().map(|(name, _)| name.as_str()).collect();
                Err(refuse(text, format!("use one of {}", names.join(", "))))
            }
        },
        OptionKind::Number(_) if text == UNIFORM => Ok(OptionValue::Uniform),
        OptionKind::Number(of) => match of.parse(text) {
            Some(number) => Ok(OptionValue::Number(number)),
            None => Err(refuse(text, of.allowed_help())),
        },
        OptionKind::List { len, of } => {
            let mut parts: Vec<&str> = text.split(',').map(str::trim).collect();
            let many = len.map_or("any number of".to_owned(), |len| len.to_string());
            match len {
                None if text.trim().is_empty() => parts.clear(),
                Some(len) if parts.len() != *len => {
                    return Err(refuse(text, format!("give {many} numbers, separated by commas")));
                }
                _ => {}
            }
            if parts.contains(&UNIFORM) {
                let allowed = format!("give {many} numbers; a list is a compile-time constant");
                return Err(refuse(text, allowed));
            }
            let numbers = parts
                .iter()
                .map(|part| of.parse(part).ok_or_else(|| refuse(part, of.allowed_help())));
            Ok(OptionValue::Numbers(numbers.collect::<Result<_, _>>()?))
        }
    }
}

/// Parses the default of an option that is an override; empty for that of the declaration.
fn parse_override(info: &OptionInfo, default: &str) -> Result<OptionValue, Box<Diagnostic>> {
    let refuse = |why: &str, help: &str| {
        let what = format!("the option `{}` cannot be overridden: it is {why}", info.name);
        Err(Box::new(Diagnostic::new(Code::CannotOverride, what).help(help)))
    };
    let constant = "only a number or a boolean can: leave it out of `override`, and set its value with `set`";
    let default = match (&info.kind, default) {
        (OptionKind::Choice(_), _) => return refuse("an enum", constant),
        (OptionKind::List { .. }, _) => return refuse("a list", constant),
        (_, "") => info.default.clone(),
        (_, text) => parse(info, text)?,
    };
    match default {
        OptionValue::Uniform => refuse(
            "a uniform",
            "keep one of them: `uniform` for values that change from frame to frame, `override` for settings",
        ),
        default => Ok(OptionValue::Override(Box::new(default))),
    }
}

impl Numeric {
    /// Smallest and largest number allowed by the range and the type.
    fn bounds(&self) -> (f64, f64) {
        let (low, high) = match self.scalar {
            Scalar::I32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
            Scalar::U32 => (0.0, f64::from(u32::MAX)),
            _ => (f64::from(f32::MIN), f64::from(f32::MAX)),
        };
        (
            self.min.map_or(low, |min| min.max(low)),
            self.max.map_or(high, |max| max.min(high)),
        )
    }

    /// Parses a number, in its canonical form.
    fn parse(&self, text: &str) -> Option<f64> {
        let number = text.parse::<f64>().ok()?;
        // An `f32` is compared with the bounds after conversion: 0.001 is not below 0.001f32.
        let held = match self.scalar {
            Scalar::F32 => f64::from(number as f32),
            _ => number,
        };
        let (low, high) = self.bounds();
        let is_held = number.is_finite() && (!self.is_integer() || number.fract() == 0.0);
        (is_held && (low..=high).contains(&held)).then(|| canonical_number(held))
    }

    /// Help that lists the allowed numbers.
    fn allowed_help(&self) -> String {
        let what = if self.is_integer() {
            "a whole number"
        } else {
            "a number"
        };
        let range = match self {
            Numeric {
                scalar: Scalar::F32,
                min: None,
                max: None,
            } => "that an f32 can hold".to_owned(),
            _ => {
                let (low, high) = self.bounds();
                format!("from {} to {}", canonical_number(low), canonical_number(high))
            }
        };
        format!("use {what} {range}, or `{UNIFORM}` to set it at run time")
    }
}

//! Registers of HLSL.

use std::fmt;
use std::str::FromStr;

/// A register of HLSL: `t3`, or `t3,space1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Register {
    /// `t` for textures and read-only buffers, `s` for samplers, `b` for uniform buffers, `u` for written resources.
    pub class: char,
    /// Number, 0 to 999.
    pub number: u32,
    /// Register space, 0 to 31; without one, the bind group.
    pub space: Option<u32>,
}

/// The largest number of a binding or a register; WebGPU's.
pub(crate) const LAST_BINDING: u32 = 999;
/// The largest number of a bind group, a descriptor set or a register space.
pub(crate) const LAST_GROUP: u32 = 31;

impl FromStr for Register {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse = || {
            let (register, space) = match text.split_once(',') {
                None => (text, None),
                Some((register, space)) => (
                    register,
                    Some(parse_number(space.trim_start().strip_prefix("space")?, LAST_GROUP)?),
                ),
            };
            let class = register.chars().next().filter(|class| "tsbu".contains(*class))?;
            let number = parse_number(&register[1..], LAST_BINDING)?;
            Some(Register { class, number, space })
        };
        parse().ok_or_else(|| {
            format!(
                "`{}` is no register: give t, s, b or u with a number to {LAST_BINDING}, and where you want one a space to \
                 {LAST_GROUP}, such as t3 or t3,space1",
                straightline_evaluator::shorten(text)
            )
        })
    }
}

/// Parses a number that consists only of digits, up to `last`.
fn parse_number(text: &str, last: u32) -> Option<u32> {
    let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let number = digits.then(|| text.parse().ok()).flatten();
    number.filter(|number| *number <= last)
}

/// Formats the register as the argument of `register()`: `t3`, or `t3, space1`.
impl fmt::Display for Register {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.class, self.number)?;
        match self.space {
            None | Some(0) => Ok(()),
            Some(space) => write!(f, ", space{space}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_are_read_and_written() {
        for (text, shown) in [("t0", "t0"), ("u12,space0", "u12"), ("s999,space31", "s999, space31")] {
            assert_eq!(text.parse::<Register>().expect("a register").to_string(), shown);
        }
        for text in [
            "",
            "t",
            "x1",
            "t-1",
            "t+1",
            "t1000",
            "t1,",
            "t1,2",
            "t1,space32",
            "t1,space",
            "é1",
            "t1,space1,space2",
        ] {
            let error = text.parse::<Register>().expect_err(text);
            assert!(error.contains("is no register"), "{error}");
        }
    }
}

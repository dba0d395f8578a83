//! Choices of antialiasing, with their names and keys.

use crate::Failure;
use std::fmt;
use std::str::FromStr;
pub use straightline_sraa::Preset;

/// Antialiasing of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Antialiasing {
    /// Shading once a pixel, without a filter.
    None,
    /// SRAA with one of its presets.
    Sraa(Preset),
    /// Shading at each of the four geometry samples.
    Supersampling,
}

impl Antialiasing {
    /// Each choice with its name. The position of a choice is its key.
    pub const ALL: [(Antialiasing, &'static str); 7] = [
        (Antialiasing::None, "none"),
        (Antialiasing::Sraa(Preset::Paper), "paper"),
        (Antialiasing::Sraa(Preset::Fast), "fast"),
        (Antialiasing::Sraa(Preset::Edges), "edges"),
        (Antialiasing::Sraa(Preset::Full), "full"),
        (Antialiasing::Sraa(Preset::Guided), "guided"),
        (Antialiasing::Supersampling, "4x"),
    ];

    fn name(self) -> &'static str {
        Self::ALL.into_iter().find(|(own, _)| *own == self).map_or("", |(_, name)| name)
    }
}

impl fmt::Display for Antialiasing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Antialiasing {
    type Err = Failure;

    fn from_str(text: &str) -> Result<Self, Failure> {
        let names = Self::ALL.map(|(_, name)| name);
        let found = Self::ALL.into_iter().find(|(_, name)| *name == text);
        let (found, _) = found.ok_or_else(|| format!("no preset {text}: use one of {}", names.join(", ")))?;
        Ok(found)
    }
}

/// The choice on the screen, and the choice before it.
#[cfg(any(feature = "window", target_arch = "wasm32", test))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    pub now: Antialiasing,
    before: Antialiasing,
}

#[cfg(any(feature = "window", target_arch = "wasm32", test))]
impl Choice {
    /// Starts with a choice. Space compares it with a frame that is not antialiased.
    pub fn new(now: Antialiasing) -> Choice {
        Choice { now, before: Antialiasing::None }
    }

    /// Follows a key: a digit chooses, and Space returns to the choice before. Returns `false` if the key does neither.
    pub fn press(&mut self, key: &str) -> bool {
        let digit = key.parse::<usize>().ok().and_then(|k| Antialiasing::ALL.get(k));
        let next = match digit {
            Some((next, _)) => *next,
            None if key == "Space" => self.before,
            None => return false,
        };
        if next != self.now {
            (self.now, self.before) = (next, self.now);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_choose_and_space_returns() {
        let mut choice = Choice::new(Antialiasing::Sraa(Preset::Guided));
        let mut press = |key: &str| choice.press(key).then(|| choice.now.to_string());
        let keys = ["Space", "Space", "0", "1", "2", "3", "4", "5", "6", "Space", "Space", "6", "Space"];
        let seen = keys.map(|key| press(key).unwrap());
        let expected = [
            "none", "guided", "none", "paper", "fast", "edges", "full", "guided", "4x", "guided", "4x", "4x", "guided",
        ];
        assert_eq!(seen, expected);
        for other in ["7", "p", "", "-1"] {
            assert_eq!(press(other), None, "{other}");
        }
    }

    #[test]
    fn a_choice_is_found_by_its_name() {
        for (own, name) in Antialiasing::ALL {
            assert_eq!(name.parse::<Antialiasing>().unwrap(), own);
            assert_eq!(own.to_string(), name);
        }
        let refused = "best".parse::<Antialiasing>().unwrap_err().to_string();
        assert!(refused.contains("use one of none, paper, fast, edges, full, guided, 4x"), "{refused}");
    }
}

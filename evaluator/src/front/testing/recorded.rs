//! The number by which an invocation says which assertion failed.

/// Kind of a recorded value's components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // named after the types of Rust
pub enum Kind {
    F32,
    I32,
    U32,
    Bool,
}

const KINDS: [Kind; 4] = [Kind::F32, Kind::I32, Kind::U32, Kind::Bool];

/// A failed assertion, with the kinds and numbers of components of its values, if they are numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recorded {
    /// Number of the assertion among [`Tests::sites`](super::Tests::sites).
    pub site: u32,
    /// The values, left and right.
    pub of: [Option<(Kind, u8)>; 2],
}

impl Recorded {
    /// Maximum number of assertions in all files.
    pub const MOST_SITES: u32 = 1 << 18;

    /// The number: the site from 1 in the upper bits, then 6 bits for each value. Never 0.
    pub fn encode(self) -> u32 {
        let value = |of: Option<(Kind, u8)>| match of {
            Some((kind, components)) => {
                let kind = KINDS.iter().position(|other| *other == kind).unwrap_or(0) as u32;
                u32::from(components) << 2 | kind
            }
            None => 0,
        };
        (self.site + 1) << 12 | value(self.of[0]) << 6 | value(self.of[1])
    }

    /// The assertion of a number; `None` for 0.
    pub fn decode(code: u32) -> Option<Recorded> {
        let value = |bits: u32| {
            let components = (bits >> 2 & 15) as u8;
            (components > 0).then(|| (KINDS[(bits & 3) as usize], components))
        };
        Some(Recorded {
            site: (code >> 12).checked_sub(1)?,
            of: [value(code >> 6 & 63), value(code & 63)],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_back() {
        for of in [
            [None, None],
            [Some((Kind::F32, 4)), Some((Kind::Bool, 1))],
            [Some((Kind::U32, 3)), None],
        ] {
            let recorded = Recorded { site: 77, of };
            assert_eq!(Recorded::decode(recorded.encode()), Some(recorded));
        }
        assert_eq!(Recorded::decode(0), None);
    }
}

//! Possible values of a `usize`, and how far its 32 bits in a shader agree with its 64 native bits.

/// Smallest number that needs more than 32 bits.
pub const WORD: i128 = 1 << 32;

/// Bound of counts in small steps: no loop of a shader runs long enough to reach it.
pub const COUNTED: i128 = i32::MAX as i128;

/// Largest step for which [`COUNTED`] holds.
const SMALL_STEP: i128 = 255;

/// Possible values of a `usize`, and their form in the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The lower 32 bits are those of the value.
    Known {
        /// Smallest value; values from 2^63 on count as negative.
        low: i128,
        /// Largest value.
        high: i128,
        /// From this value on, the shader's number stands for any value at least as large.
        cap: Option<i128>,
        /// `true` if the largest value is [`COUNTED`], derived from the length of loops.
        counted: bool,
    },
    /// The lower 32 bits are those of the value, which is unbounded.
    Modular,
    /// The shader's number is unrelated to the value.
    Lost,
}

use Extent::{Known, Lost, Modular};

impl Extent {
    /// Values from `low` to `high`.
    pub fn range(low: i128, high: i128) -> Extent {
        Extent::capped(low, high, None)
    }

    /// Values from `low` to `high`, of which those from `cap` on share one representation.
    pub fn capped(low: i128, high: i128, cap: Option<i128>) -> Extent {
        let fits = match cap {
            None => low >= i128::from(i64::MIN) && high <= i128::from(i64::MAX),
            Some(cap) => low >= 0 && high < WORD && cap > 0,
        };
        match (fits, cap) {
            (true, _) => Known {
                low,
                high,
                cap: cap.filter(|cap| *cap <= high),
                counted: false,
            },
            (false, None) => Modular,
            (false, Some(_)) => Lost,
        }
    }

    /// Like [`Extent::range`], up to [`COUNTED`].
    pub fn counted(low: i128) -> Extent {
        Known {
            low,
            high: COUNTED,
            cap: None,
            counted: true,
        }
    }

    /// Bounds of a value without a cap.
    pub fn bounds(self) -> Option<(i128, i128)> {
        match self {
            Known {
                low, high, cap: None, ..
            } => Some((low, high)),
            _ => None,
        }
    }

    /// Returns whether the shader's number equals the value.
    pub fn is_exact(self) -> bool {
        self.bounds().is_some_and(|(low, high)| low >= 0 && high < WORD)
    }

    /// Returns whether the lower 32 bits are those of the value.
    pub fn has_bits(self) -> bool {
        matches!(self, Known { cap: None, .. } | Modular)
    }

    /// Returns whether an `i32` holds every value, negative ones included.
    pub fn is_signed(self) -> bool {
        matches!(self, Known { low, high, .. } if low >= i128::from(i32::MIN) && high <= i128::from(i32::MAX))
    }

    /// Returns whether an `i32` equals the value.
    pub fn is_natural(self) -> bool {
        self.is_signed() && matches!(self, Known { low: 0.., .. })
    }

    /// Union of two extents.
    pub fn join(self, other: Extent) -> Extent {
        match (self, other) {
            (a, b) if a == b => a,
            (
                Known {
                    low,
                    high,
                    cap,
                    counted,
                },
                Known {
                    low: low_b,
                    high: high_b,
                    cap: cap_b,
                    counted: counted_b,
                },
            ) => {
                let least = [cap, cap_b].into_iter().flatten().min();
                let both = Extent::capped(low.min(low_b), high.max(high_b), least);
                let longer = (counted && high >= high_b) || (counted_b && high_b >= high);
                both.with_counted(longer)
            }
            (Lost, _) | (_, Lost) => Lost,
            (a, b) if a.has_bits() && b.has_bits() => Modular,
            _ => Lost,
        }
    }

    fn with_counted(self, longer: bool) -> Extent {
        match self {
            Known { low, high, cap, .. } => Known {
                low,
                high,
                cap,
                counted: longer && high == COUNTED,
            },
            other => other,
        }
    }

    /// Returns whether the shader's numbers have the order of the values.
    pub fn is_ordered_with(self, other: Extent) -> bool {
        match (self, other) {
            (
                Known {
                    low, high, cap: None, ..
                },
                Known {
                    low: low_b,
                    high: high_b,
                    cap: None,
                    ..
                },
            ) => {
                let (least, most) = (low.min(low_b).min(0), high.max(high_b));
                most - least < WORD && least >= -WORD
            }
            (Known { cap: Some(cap), .. }, other) | (other, Known { cap: Some(cap), .. }) => {
                other.bounds().is_some_and(|(low, high)| low >= 0 && high < cap)
            }
            _ => false,
        }
    }

    /// `self + other`.
    pub fn plus(self, other: Extent) -> Extent {
        let (
            Known {
                low,
                high,
                cap,
                counted,
            },
            Known {
                low: low_b,
                high: high_b,
                cap: cap_b,
                counted: counted_b,
            },
        ) = (self, other)
        else {
            return self.by_bits(other);
        };
        let step = |low: i128, high: i128| low >= 0 && high <= SMALL_STEP;
        if (counted && step(low_b, high_b)) || (counted_b && step(low, high)) {
            return Extent::counted(low + low_b);
        }
        let cap = match (cap, cap_b) {
            (None, None) => None,
            (a, b) => [a.map(|a| a + low_b), b.map(|b| b + low)].into_iter().flatten().min(),
        };
        Extent::capped(low + low_b, high + high_b, cap)
    }

    /// `self - other`. A result below 0 panics natively, unless the difference `wraps`.
    pub fn minus(self, other: Extent, wraps: bool) -> Extent {
        let (
            Known { low, high, cap, .. },
            Known {
                low: low_b,
                high: high_b,
                cap: None,
                ..
            },
        ) = (self, other)
        else {
            return self.by_bits(other);
        };
        let (mut least, mut most) = (low - high_b, high - low_b);
        if !wraps && low >= 0 && low_b >= 0 {
            (least, most) = (least.max(0), most.max(0));
        }
        Extent::capped(least, most, cap.map(|cap| cap - high_b))
    }

    /// `self * other`.
    pub fn times(self, other: Extent) -> Extent {
        let (
            Known { low, high, cap, .. },
            Known {
                low: low_b,
                high: high_b,
                cap: cap_b,
                ..
            },
        ) = (self, other)
        else {
            return self.by_bits(other);
        };
        let products = [low * low_b, low * high_b, high * low_b, high * high_b];
        let (least, most) = (
            products.iter().copied().min().unwrap_or(0),
            products.iter().copied().max().unwrap_or(0),
        );
        let cap = [cap.map(|cap| cap * low_b.max(1)), cap_b.map(|cap| cap * low.max(1))];
        Extent::capped(least, most, cap.into_iter().flatten().min())
    }

    /// `self / other`; `None` if the shader's division would differ.
    pub fn divided(self, other: Extent) -> Option<Extent> {
        let (low_b, high_b) = other
            .is_exact()
            .then(|| other.bounds())
            .flatten()
            .map(|(a, b)| (a.max(1), b.max(1)))?;
        match self {
            Known { low, high, cap, .. } if low >= 0 && high < WORD => {
                Some(Extent::capped(low / high_b, high / low_b, cap.map(|cap| cap / high_b)))
            }
            _ => None,
        }
    }

    /// `self % other`; `None` if the shader's remainder would differ.
    pub fn rest(self, other: Extent) -> Option<Extent> {
        let (low_b, high_b) = other.is_exact().then(|| other.bounds()).flatten()?;
        let largest = (high_b - 1).max(0);
        if low_b == high_b && low_b > 0 && low_b & (low_b - 1) == 0 && self.has_bits() {
            return Some(Extent::range(0, largest));
        }
        let (_, high) = self.is_exact().then(|| self.bounds()).flatten()?;
        Some(Extent::range(0, largest.min(high)))
    }

    /// `self & other`.
    pub fn masked(self, other: Extent) -> Extent {
        if !self.has_bits() || !other.has_bits() {
            return Lost;
        }
        let exact = [self, other].into_iter().filter(|side| side.is_exact());
        match exact.filter_map(|side| side.bounds()).map(|(_, high)| high).min() {
            Some(high) => Extent::range(0, high),
            None => self.mixed(other),
        }
    }

    /// `self | other` or `self ^ other`.
    pub fn mixed(self, other: Extent) -> Extent {
        if self.is_exact() && other.is_exact() {
            let most = [self, other]
                .into_iter()
                .filter_map(Extent::bounds)
                .map(|(_, high)| high)
                .max();
            let bits = 128 - most.unwrap_or(0).leading_zeros();
            return Extent::range(0, (1 << bits) - 1);
        }
        match self.has_bits() && other.has_bits() && self.is_signed() && other.is_signed() {
            true => Extent::range(i32::MIN.into(), i32::MAX.into()),
            false => self.by_bits(other),
        }
    }

    /// `!self`.
    pub fn inverted(self) -> Extent {
        match self {
            Known {
                low, high, cap: None, ..
            } => Extent::range(-1 - high, -1 - low),
            Modular => Modular,
            _ => Lost,
        }
    }

    /// Minimum of two values that are ordered.
    pub fn smaller(self, other: Extent) -> Extent {
        let (
            Known { low, high, cap, .. },
            Known {
                low: low_b,
                high: high_b,
                cap: cap_b,
                ..
            },
        ) = (self, other)
        else {
            return Lost;
        };
        if low < 0 && low_b < 0 {
            return self.join(other);
        }
        // Negative values are the largest.
        let most = match (low < 0, low_b < 0) {
            (true, _) => high_b,
            (_, true) => high,
            _ => high.min(high_b),
        };
        let cap = [cap, cap_b].into_iter().flatten().min();
        Extent::capped(low.max(0).min(low_b.max(0)), most, cap)
    }

    /// Maximum of two values that are ordered.
    pub fn larger(self, other: Extent) -> Extent {
        match (self, other) {
            (
                Known {
                    low: low @ 0..,
                    high,
                    cap,
                    ..
                },
                Known {
                    low: low_b @ 0..,
                    high: high_b,
                    cap: cap_b,
                    ..
                },
            ) => {
                let cap = [cap, cap_b].into_iter().flatten().min();
                Extent::capped(low.max(low_b), high.max(high_b), cap)
            }
            _ => self.join(other),
        }
    }

    /// Extent of an operation on both that only preserves the lower bits.
    fn by_bits(self, other: Extent) -> Extent {
        match self.has_bits() && other.has_bits() {
            true => Modular,
            false => Lost,
        }
    }
}

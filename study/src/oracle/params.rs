//! What an SRAA filter is made of, by the names that the kernel's options have.

use std::fmt::Display;

/// An enumeration whose values have names.
macro_rules! choices {
    ($(#[$meta:meta])* $name:ident { $( $(#[$value_meta:meta])* $value:ident = $text:literal ),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $( $(#[$value_meta])* $value, )* }

        impl $name {
            /// Every value.
            pub const ALL: &'static [$name] = &[ $( $name::$value, )* ];

            /// The name on the command line and in manifests.
            pub fn name(self) -> &'static str {
                match self { $( $name::$value => $text, )* }
            }
        }
    };
}

choices! {
    /// Where in a pixel geometry is sampled.
    Pattern {
        /// A regular 2×2 grid, row by row.
        Ordered4 = "ordered4",
        /// Direct3D's standard pattern of 4.
        Latin4 = "latin4",
        /// A regular 4×4 grid, row by row.
        Ordered16 = "ordered16",
        /// Direct3D's standard pattern of 16.
        Latin16 = "latin16",
    }
}

choices! {
    /// Where in a pixel shading is sampled.
    Shading {
        /// At the first geometry sample.
        Sample0 = "sample0",
        /// At the pixel's centre, whose geometry is one more layer, the last.
        Centre = "centre",
    }
}

choices! {
    /// What tells two surfaces apart.
    Metric {
        /// The larger of the differences in depth and in normal.
        DepthNormals = "depth-normals",
        /// The difference in depth.
        Depth = "depth",
    }
}

choices! {
    /// How a tap's weight falls with its distance on the screen.
    Falloff {
        /// Not at all up to one pixel on each axis.
        None = "none",
        /// Linearly to zero at one pixel on each axis.
        Tent = "tent",
    }
}

choices! {
    /// How the weights of a sample are made to sum to one. The same number in exact arithmetic.
    Normalisation {
        /// w / Σw: 0/0, and so NaN, where every weight is below the smallest number.
        Paper = "paper",
        /// The same with the smallest difference subtracted first: Σw is never 0.
        Shifted = "shifted",
    }
}

/// What an SRAA filter is made of. The default is the kernel's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SraaParams {
    /// Where in a pixel geometry is sampled.
    pub pattern: Pattern,
    /// Where in a pixel shading is sampled.
    pub shading: Shading,
    /// What tells two surfaces apart.
    pub metric: Metric,
    /// How a tap's weight falls with its distance on the screen.
    pub falloff: Falloff,
    /// How the weights of a sample are made to sum to one.
    pub normalisation: Normalisation,
    /// How sharply a weight falls as surfaces differ; 0 or more.
    pub tau: f64,
    /// Difference per unit of depth; 0 or more.
    pub depth_scale: f64,
}

impl Default for SraaParams {
    fn default() -> Self {
        SraaParams {
            pattern: Pattern::Latin4,
            shading: Shading::Centre,
            metric: Metric::DepthNormals,
            falloff: Falloff::Tent,
            normalisation: Normalisation::Shifted,
            tau: 500.0,
            depth_scale: 1.0,
        }
    }
}

/// Why an option could not be set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OracleError {
    /// There is no such option.
    #[error("the oracle knows no option `{option}`: it has {known}")]
    UnknownOption {
        /// What was asked for.
        option: String,
        /// The options that there are.
        known: String,
    },
    /// The option has no such value.
    #[error("{option}={value}: expected {expected}")]
    BadValue {
        /// The option.
        option: String,
        /// What it was set to.
        value: String,
        /// What it can be set to.
        expected: String,
    },
}

impl SraaParams {
    /// Sets an option by name, both spelled as on the command line or in a manifest's `options`.
    pub fn set(&mut self, option: &str, value: &str) -> Result<(), OracleError> {
        match option {
            "pattern" => self.pattern = choice(option, value, Pattern::ALL, Pattern::name)?,
            "shading" => self.shading = choice(option, value, Shading::ALL, Shading::name)?,
            "metric" => self.metric = choice(option, value, Metric::ALL, Metric::name)?,
            "falloff" => self.falloff = choice(option, value, Falloff::ALL, Falloff::name)?,
            "normalisation" => self.normalisation = choice(option, value, Normalisation::ALL, Normalisation::name)?,
            "tau" => self.tau = number(option, value)?,
            "depth_scale" => self.depth_scale = number(option, value)?,
            _ => {
                let known = "pattern, shading, metric, falloff, normalisation, tau, depth_scale".to_owned();
                return Err(OracleError::UnknownOption {
                    option: option.to_owned(),
                    known,
                });
            }
        }
        Ok(())
    }
}

fn choice<T: Copy>(option: &str, value: &str, all: &[T], name: fn(T) -> &'static str) -> Result<T, OracleError> {
    all.iter()
        .copied()
        .find(|candidate| name(*candidate) == value)
        .ok_or_else(|| {
            let names: Vec<_> = all.iter().map(|candidate| name(*candidate)).collect();
            bad_value(option, value, names.join(", "))
        })
}

fn number(option: &str, value: &str) -> Result<f64, OracleError> {
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(number),
        _ => Err(bad_value(option, value, "a number of at least 0")),
    }
}

fn bad_value(option: &str, value: &str, expected: impl Display) -> OracleError {
    OracleError::BadValue {
        option: option.to_owned(),
        value: value.to_owned(),
        expected: expected.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_set_by_name() {
        let mut params = SraaParams::default();
        for (option, value) in [
            ("pattern", "ordered16"),
            ("shading", "sample0"),
            ("metric", "depth"),
            ("falloff", "none"),
            ("normalisation", "paper"),
            ("tau", "12.5"),
            ("depth_scale", "0"),
        ] {
            params.set(option, value).unwrap();
        }
        let expected = SraaParams {
            pattern: Pattern::Ordered16,
            shading: Shading::Sample0,
            metric: Metric::Depth,
            falloff: Falloff::None,
            normalisation: Normalisation::Paper,
            tau: 12.5,
            depth_scale: 0.0,
        };
        assert_eq!(params, expected);
    }

    #[test]
    fn bad_options_are_refused_with_what_would_do() {
        let mut params = SraaParams::default();
        assert!(
            params
                .set("patern", "latin4")
                .unwrap_err()
                .to_string()
                .contains("pattern, shading")
        );
        let error = params.set("falloff", "gauss").unwrap_err();
        assert_eq!(error.to_string(), "falloff=gauss: expected none, tent");
        for bad in ["-1", "NaN", "inf", "many"] {
            assert!(params.set("tau", bad).is_err(), "{bad}");
        }
        assert_eq!(params, SraaParams::default());
    }
}

//! Cost of a variant: time on the device, or cycles by the compiler of a GPU that need not be there.

use std::fmt;
use std::str::FromStr;
use straightline_isa::{Compiler, Gpu};

/// By what variants are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cost {
    /// Time on the device that draws the pictures.
    #[default]
    Time,
    /// Cycles of a wave and pixel of its invocations, as Mesa's compiler gives them for AMD's GPUs; instructions for other
    /// GPUs. Cycles of loops are guesses, instructions of loops are refused; what stands behind branches counts in full.
    Isa(Gpu),
}

/// Source of the cost of variants.
#[derive(Debug)]
pub enum Gauge {
    /// The device's clock.
    Device,
    /// A compiler, which is asked.
    Compiler(Box<Compiler>),
}

impl Cost {
    /// Unit of the cost.
    pub fn unit(self) -> &'static str {
        match self {
            Cost::Time => "ms",
            Cost::Isa(gpu) => gpu.cost_unit(),
        }
    }
}

impl Gauge {
    /// As records and the command line call it.
    pub fn cost(&self) -> Cost {
        match self {
            Gauge::Device => Cost::Time,
            Gauge::Compiler(compiler) => Cost::Isa(compiler.gpu()),
        }
    }

    /// The GPU that is compiled for, and the compiler's version.
    pub fn compiled_for(&self) -> Option<&str> {
        match self {
            Gauge::Device => None,
            Gauge::Compiler(compiler) => Some(compiler.device()),
        }
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cost::Time => f.write_str("time"),
            Cost::Isa(gpu) => write!(f, "isa:{gpu}"),
        }
    }
}

impl FromStr for Cost {
    type Err = String;

    fn from_str(text: &str) -> Result<Cost, String> {
        match text.split_once(':') {
            None if text == "time" => Ok(Cost::Time),
            Some(("isa", "device")) => Err(
                "this machine's own driver states no cycles: use `time`, or a GPU such as isa:amd:navi21".to_owned(),
            ),
            Some(("isa", gpu)) => Ok(Cost::Isa(gpu.parse()?)),
            _ => Err("use `time`, or `isa:VENDOR:GPU` such as isa:amd:navi21".to_owned()),
        }
    }
}

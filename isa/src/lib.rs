//! Machine code and figures of a shader by a GPU's compiler, without the GPU.
//!
//! Mesa's RADV compiles for AMD GPUs that are not there: instances, devices and pipelines are made as for the real one, and only
//! submissions are lost. Its compiler reports instructions, registers, occupancy and cycles, and the machine code itself. The
//! driver learns which GPU it shall be from its environment, when it is loaded: so each family is asked in a process of its own
//! (see [`Compiler`] and [`serve`]). A GPU that is there is asked by its own driver ([`Family::Device`]).
//!
//! ```no_run
//! use straightline_isa::{Compiler, Family};
//!
//! # let spirv: Vec<u8> = Vec::new();
//! let mut compiler = Compiler::start(&std::env::current_exe()?, &["serve"], Family::Navi21)?;
//! let figures = compiler.compile(&spirv, "main")?.figures;
//! println!("{} instructions, {} cycles", figures.instructions, figures.inverse_throughput);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod ask;
mod device;
mod figures;
mod interface;
mod pipeline;
mod serve;
mod vertex;

pub use ask::{Compiler, IsaError};
pub use figures::{Figures, Report};
pub use serve::serve;

use serde::{Deserialize, Serialize};

/// A family of AMD GPUs, or the GPU of this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// GCN 4, 2016: Radeon RX 470, 480.
    Polaris10,
    /// GCN 5, 2017: Radeon RX Vega.
    Vega10,
    /// RDNA 1, 2019: Radeon RX 5700.
    Navi10,
    /// RDNA 2, 2020: Radeon RX 6800, 6900; PlayStation 5, Xbox Series and Steam Deck have its kind.
    Navi21,
    /// RDNA 3, 2022: Radeon RX 7900. Mesa has it from 22.3 on.
    Navi31,
    /// The GPU of this machine by its own driver, if the driver reports on what it compiles: NVIDIA's does.
    Device,
}

impl Family {
    /// All that Mesa compiles for without the GPU, oldest first.
    pub const ALL: [Family; 5] = [
        Family::Polaris10,
        Family::Vega10,
        Family::Navi10,
        Family::Navi21,
        Family::Navi31,
    ];

    /// As Mesa calls it; `device` for the GPU of this machine.
    pub fn name(self) -> &'static str {
        match self {
            Family::Polaris10 => "polaris10",
            Family::Vega10 => "vega10",
            Family::Navi10 => "navi10",
            Family::Navi21 => "navi21",
            Family::Navi31 => "navi31",
            Family::Device => "device",
        }
    }
}

impl std::fmt::Display for Family {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Family {
    type Err = String;

    fn from_str(text: &str) -> Result<Family, String> {
        let all = || Family::ALL.into_iter().chain([Family::Device]);
        all().find(|family| family.name() == text).ok_or_else(|| {
            let names: Vec<_> = all().map(Family::name).collect();
            format!("no such family; there are {}", names.join(", "))
        })
    }
}

//! Machine code and figures of a shader by a GPU's compiler, without the GPU.
//!
//! Mesa's drivers compile for GPUs that are not there: instances, devices and pipelines are made as for the real one, and only
//! submissions are lost, in a small library (a *shim*) that stands in for the kernel's part of the driver. The compilers report
//! instructions, registers and how much runs at once; some report cycles, spills, loops, and the machine code itself. A driver
//! learns which GPU it shall be from its environment, when it is loaded: so each GPU is asked about in a process of its own (see
//! [`Compiler`] and [`serve`]). A GPU that is there is asked by its own driver ([`Gpu::DEVICE`]).
//!
//! Drivers and shims are Debian's packages `mesa-vulkan-drivers` and `mesa-drm-shim`, installed or extracted to a folder
//! ([`Drivers`]). Nothing of them is part of this crate, which sets environment variables and calls Vulkan.
//!
//! ```no_run
//! use straightline_isa::{Compiler, Gpu};
//!
//! # let spirv: Vec<u8> = Vec::new();
//! let mut compiler = Compiler::start(&std::env::current_exe()?, &["serve"], "amd:navi21".parse::<Gpu>()?)?;
//! let figures = compiler.compile(&spirv, "main")?.figures;
//! println!("{} instructions, {} cycles", figures.instructions, figures.inverse_throughput);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod ask;
mod device;
mod drivers;
mod figures;
mod gpu;
mod interface;
mod names;
mod pipeline;
mod serve;
#[cfg(test)]
mod tests;
mod vendors;
mod vertex;

pub use ask::{Compiler, IsaError};
pub use drivers::{Drivers, FOLDER_VARIABLE};
pub use figures::{Figures, Report};
pub use gpu::Gpu;
pub use serve::serve;

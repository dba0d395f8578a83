//! Names of drivers for the figures that they have in common.

use ash::vk::DriverId;

/// Figures that drivers have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Common {
    Instructions,
    Registers,
    ScalarRegisters,
    Spilled,
    AtOnce,
    CodeSize,
    SharedMemory,
    Latency,
    InverseThroughput,
    Loops,
}

/// Drivers, and their names for the common figures.
type NamesOf = (&'static [DriverId], &'static [(&'static str, Common)]);

/// Mesa's driver for Apple's GPUs, which `ash` does not name.
pub(crate) const HONEYKRISP: DriverId = DriverId::from_raw(26);

/// Names of drivers for the common figures, in small letters: versions of Mesa differ in capitals and words.
const NAMES: [NamesOf; 7] = [
    (
        &[DriverId::MESA_RADV],
        &[
            ("instructions", Common::Instructions),
            ("vgprs", Common::Registers),
            ("sgprs", Common::ScalarRegisters),
            ("spilled vgprs", Common::Spilled),
            ("spilled sgprs", Common::Spilled),
            ("subgroups per simd", Common::AtOnce),
            ("code size", Common::CodeSize),
            ("lds size", Common::SharedMemory),
            ("latency", Common::Latency),
            ("inverse throughput", Common::InverseThroughput),
        ],
    ),
    (
        &[DriverId::MESA_NVK],
        &[
            ("instructions", Common::Instructions),
            ("instruction count", Common::Instructions),
            ("gprs", Common::Registers),
            ("number of gprs", Common::Registers),
            ("spills to memory", Common::Spilled),
            ("max warps/sm", Common::AtOnce),
            ("code size", Common::CodeSize),
            ("cycles", Common::Latency),
            ("static cycle count", Common::Latency),
        ],
    ),
    (
        &[DriverId::INTEL_OPEN_SOURCE_MESA],
        &[
            ("instructions", Common::Instructions),
            ("instruction count", Common::Instructions),
            ("max live registers", Common::Registers),
            ("spills", Common::Spilled),
            ("spill count", Common::Spilled),
            ("max dispatch width", Common::AtOnce),
            ("workgroup memory size", Common::SharedMemory),
            ("cycles", Common::Latency),
            ("cycle count", Common::Latency),
            ("loops", Common::Loops),
            ("loop count", Common::Loops),
        ],
    ),
    (
        &[DriverId::MESA_TURNIP],
        &[
            ("instructions", Common::Instructions),
            ("instruction count", Common::Instructions),
            ("registers used", Common::Registers),
            ("stp count", Common::Spilled),
            ("max waves per core", Common::AtOnce),
            ("code size", Common::CodeSize),
            ("loops", Common::Loops),
        ],
    ),
    (
        &[HONEYKRISP, DriverId::MESA_PANVK],
        &[
            ("instructions", Common::Instructions),
            ("instruction count", Common::Instructions),
            ("gprs", Common::Registers),
            ("registers", Common::Registers),
            ("spills", Common::Spilled),
            ("threads", Common::AtOnce),
            ("code size", Common::CodeSize),
            ("loops", Common::Loops),
        ],
    ),
    (
        &[DriverId::MESA_V3DV, DriverId::IMAGINATION_OPEN_SOURCE_MESA],
        &[
            ("instructions", Common::Instructions),
            ("instruction count", Common::Instructions),
            ("temps", Common::Registers),
            ("spills", Common::Spilled),
            ("tmu spills", Common::Spilled),
            ("threads", Common::AtOnce),
            ("thread count", Common::AtOnce),
            ("loops", Common::Loops),
        ],
    ),
    (
        &[DriverId::NVIDIA_PROPRIETARY],
        &[("register count", Common::Registers), ("binary size", Common::CodeSize)],
    ),
];

impl Common {
    /// Returns the common figure that a driver calls so.
    pub(crate) fn find(driver: DriverId, name: &str) -> Option<Common> {
        let lower = name.to_lowercase();
        let names = NAMES.iter().filter(|(drivers, _)| drivers.contains(&driver));
        let mut names = names.flat_map(|(_, names)| names.iter());
        names.find(|(known, _)| *known == lower).map(|(_, common)| *common)
    }
}

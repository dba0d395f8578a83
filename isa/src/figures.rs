//! Figures that the compiler reports, and counts of its machine code.

use super::names::Common;
use ash::vk::DriverId;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A compiler's output for one shader.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Report {
    /// Figures of the shader.
    pub figures: Figures,
    /// The machine code as text; empty where the driver was built without a disassembler.
    pub assembly: String,
}

/// A compiler's figures of one shader. Those that a driver does not report are 0; [`Figures::known_figures`] leaves them out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Figures {
    /// All instructions.
    pub instructions: u64,
    /// Instructions on vector registers, a lane each. This and the next four are counted in AMD's machine code.
    pub vector: u64,
    /// Instructions on scalar registers, one for the wave; branches and waits are not among them.
    pub scalar: u64,
    /// Instructions that read or write images, buffers or shared memory a lane each.
    pub memory: u64,
    /// Memory instructions on shared memory.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub shared: u64,
    /// Jumps, taken or not.
    pub branches: u64,
    /// Registers of a lane: AMD's vector registers, or the most values that are alive at once (Intel).
    pub vector_registers: u64,
    /// Scalar registers.
    pub scalar_registers: u64,
    /// Registers of both kinds that did not fit and lie in memory.
    pub spilled: u64,
    /// Waves, warps, threads or lanes at once, in the unit of [`Gpu::occupancy_unit`](crate::Gpu::occupancy_unit): the more, the
    /// better waits are hidden.
    pub occupancy: u64,
    /// Bytes of machine code.
    pub code_size: u64,
    /// Bytes of shared memory a workgroup.
    pub shared_memory: u64,
    /// Cycles from the first to the last instruction of a wave that is alone on its unit. Those of loops are guesses.
    pub latency: u64,
    /// Cycles of a wave where enough of them hide each other's waits: the shader's cost. Those of loops are guesses.
    pub inverse_throughput: u64,
    /// Loops in the compiled shader; `None` where the driver says nothing of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loops: Option<u64>,
    /// All other figures, by the driver's own names for them.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub own: BTreeMap<String, u64>,
}

fn is_zero(n: &u64) -> bool {
    *n == 0
}

impl Figures {
    /// Names each figure for readers, in the order of the fields; `shared` comes last.
    pub fn named_figures(&self) -> [(&'static str, u64); 14] {
        [
            ("instructions", self.instructions),
            ("vector", self.vector),
            ("scalar", self.scalar),
            ("memory", self.memory),
            ("branches", self.branches),
            ("vector registers", self.vector_registers),
            ("scalar registers", self.scalar_registers),
            ("spilled", self.spilled),
            ("occupancy", self.occupancy),
            ("code size", self.code_size),
            ("shared memory", self.shared_memory),
            ("latency", self.latency),
            ("cycles", self.inverse_throughput),
            ("memory, shared", self.shared),
        ]
    }

    /// Names each figure, as [`Figures::named_figures`]; `None` where the driver reports none. Nothing else can have no
    /// instruction, register, byte or cycle.
    pub fn known_figures(&self) -> [(&'static str, Option<u64>); 14] {
        let has_code = self.vector + self.scalar + self.memory > 0;
        self.named_figures().map(|(name, figure)| {
            let is_known = match name {
                "vector" | "scalar" | "memory" | "branches" | "memory, shared" => has_code,
                "scalar registers" | "shared memory" => has_code || figure > 0,
                "spilled" => self.instructions > 0,
                _ => figure > 0,
            };
            (name, is_known.then_some(figure))
        })
    }

    /// Returns the names of the figures that fit on one line.
    pub fn names_in_short() -> [&'static str; 8] {
        let all = Figures::default().named_figures();
        [0, 1, 3, 4, 5, 8, 11, 12].map(|k| all[k].0)
    }

    /// Returns the cost that variants are compared by: cycles of a wave among many if the driver states them, else instructions.
    /// Instructions say nothing of loops: `None` if some are left.
    pub fn cost(&self) -> Option<u64> {
        match self.inverse_throughput {
            0 if self.keeps_loops() => None,
            0 => Some(self.instructions),
            cycles => Some(cycles),
        }
    }

    /// Returns whether a loop is left in the compiled shader, as far as the driver says.
    pub fn keeps_loops(&self) -> bool {
        self.loops.is_some_and(|loops| loops > 0)
    }

    /// Takes one of a driver's figures, by its own name for it.
    pub(crate) fn record_figure(&mut self, driver: DriverId, name: &str, value: u64) {
        let Some(common) = Common::find(driver, name) else {
            // A hash is no figure.
            if !name.to_lowercase().contains("hash") {
                self.own.insert(name.to_owned(), value);
            }
            return;
        };
        match common {
            Common::Instructions => self.instructions = value,
            Common::Registers => self.vector_registers = value,
            Common::ScalarRegisters => self.scalar_registers = value,
            Common::Spilled => self.spilled += value,
            Common::AtOnce => self.occupancy = value,
            Common::CodeSize => self.code_size = value,
            Common::SharedMemory => self.shared_memory = value,
            Common::Latency => self.latency = value,
            Common::InverseThroughput => self.inverse_throughput = value,
            Common::Loops => self.loops = Some(value),
        }
    }

    /// Counts loops in Mesa's intermediate text (NIR), for drivers that do not.
    pub(crate) fn count_loops(&mut self, nir: &str) {
        let loops = nir.lines().filter(|line| line.ends_with("loop {")).count();
        // NVIDIA's has jumps for loops: those to a block from one that is not before it.
        let jumps = || nir.lines().filter(|line| is_loop_header(line)).count();
        self.loops
            .get_or_insert_with(|| if loops > 0 { loops } else { jumps() } as u64);
    }

    /// Counts instructions by kind in AMD's machine code as text.
    pub(crate) fn count_instructions(&mut self, assembly: &str) {
        for line in assembly.lines() {
            let Some(word) = line.split_whitespace().next() else {
                continue;
            };
            match word.split('_').next() {
                _ if word.starts_with("s_cbranch") || word == "s_branch" => self.branches += 1,
                _ if word.starts_with("s_wait") || matches!(word, "s_nop" | "s_endpgm" | "s_code_end") => {}
                Some("v") => self.vector += 1,
                Some("s") => self.scalar += 1,
                Some("image" | "buffer" | "global" | "flat" | "scratch" | "tbuffer") => self.memory += 1,
                Some("ds") => {
                    self.memory += 1;
                    self.shared += 1;
                }
                _ => {}
            }
        }
    }
}

/// Tells whether a line such as `div block b2:   // preds: b1 b214` begins a block that a later one jumps to.
fn is_loop_header(line: &str) -> bool {
    let number = |word: &str| word.trim_matches([':', ',']).strip_prefix('b')?.parse::<u32>().ok();
    let Some((block, predecessors)) = line.split_once("// preds:") else {
        return false;
    };
    let own = block.split_whitespace().find_map(number);
    let predecessors = predecessors.split(", succs:").next().unwrap_or_default();
    let mut before = predecessors.split_whitespace().filter_map(number);
    own.is_some_and(|own| before.any(|other| other >= own))
}

#[cfg(test)]
mod tests {
    use super::super::names::HONEYKRISP;
    use super::*;

    #[test]
    fn counts_machine_code_by_kind() {
        let mut figures = Figures::default();
        figures.count_instructions(
            "BB0:\n\ts_mov_b32 s0, s1 ; be800301\n\tv_add_f32_e32 v0, v1, v2\n\timage_load v[0:3], v[0:1], s[0:7]\n\
             \ts_waitcnt vmcnt(0)\n\ts_cbranch_execz BB2\n\tds_read_b32 v0, v1\n\ts_endpgm\n",
        );
        let found = [
            figures.scalar,
            figures.vector,
            figures.memory,
            figures.shared,
            figures.branches,
        ];
        assert_eq!(found, [1, 1, 2, 1, 1]);
    }

    /// A driver's names and values.
    type Reply = &'static [(&'static str, u64)];

    /// Figures of a recorded reply.
    fn record(driver: DriverId, reply: &[(&str, u64)]) -> Figures {
        let mut figures = Figures::default();
        reply
            .iter()
            .for_each(|(name, value)| figures.record_figure(driver, name, *value));
        figures
    }

    #[test]
    fn spilled_registers_of_both_kinds_are_one_figure() {
        let reply = [("Spilled VGPRs", 2), ("Spilled SGPRs", 3), ("Driver pipeline hash", 99)];
        let expected = Figures {
            spilled: 5,
            ..Figures::default()
        };
        assert_eq!(record(DriverId::MESA_RADV, &reply), expected);
    }

    /// Mesa 22.3.6, 25.0.7 and 26.2.6 for AMD, 26.2.6 for the others, asked about SRAA 4.
    #[test]
    fn common_figures_are_found_in_every_drivers_reply() {
        let replies: [(DriverId, Reply, [u64; 5]); 6] = [
            (
                DriverId::MESA_RADV,
                &[
                    ("VGPRs", 48),
                    ("Subgroups per SIMD", 20),
                    ("Instructions", 553),
                    ("Latency", 2271),
                    ("Inverse Throughput", 670),
                    ("VMEM Clause", 19),
                ],
                [553, 48, 20, 2271, 670],
            ),
            (
                DriverId::MESA_RADV,
                &[
                    ("VGPRs", 48),
                    ("Subgroups per SIMD", 20),
                    ("Combined inputs", 0),
                    ("Instructions", 555),
                    ("Latency", 1955),
                    ("Inverse Throughput", 680),
                    ("VALU", 452),
                ],
                [555, 48, 20, 1955, 680],
            ),
            (
                DriverId::MESA_RADV,
                &[
                    ("VGPRs", 40),
                    ("Subgroups per SIMD", 24),
                    ("Instructions", 543),
                    ("Latency", 2682),
                    ("Inverse Throughput", 651),
                    ("VALU", 433),
                ],
                [543, 40, 24, 2682, 651],
            ),
            (
                DriverId::MESA_NVK,
                &[
                    ("Instruction count", 525),
                    ("Static cycle count", 1770),
                    ("Max warps/SM", 48),
                    ("Spills to reg", 4),
                    ("Number of GPRs", 40),
                ],
                [525, 40, 48, 1770, 0],
            ),
            (
                DriverId::MESA_TURNIP,
                &[
                    ("Instruction Count", 552),
                    ("Registers used", 16),
                    ("Max Waves Per Core", 12),
                    ("cat2 instructions", 239),
                ],
                [552, 16, 12, 0, 0],
            ),
            (
                HONEYKRISP,
                &[("Instructions", 624), ("ALU", 543), ("GPRs", 103), ("Threads", 1024)],
                [624, 103, 1024, 0, 0],
            ),
        ];
        for (driver, reply, common) in replies {
            let figures = record(driver, reply);
            let found = [
                figures.instructions,
                figures.vector_registers,
                figures.occupancy,
                figures.latency,
                figures.inverse_throughput,
            ];
            assert_eq!(found, common, "{reply:?}");
            assert_eq!(figures.spilled, 0, "a spill to another register is none to memory");
        }
    }

    #[test]
    fn what_a_driver_does_not_report_is_not_zero() {
        let figures = record(HONEYKRISP, &[("Instructions", 624), ("GPRs", 103), ("Spills", 0)]);
        let known = figures.known_figures();
        let of = |name| {
            known
                .iter()
                .find(|(known, _)| *known == name)
                .and_then(|(_, figure)| *figure)
        };
        assert_eq!(
            [of("instructions"), of("vector registers"), of("spilled")],
            [Some(624), Some(103), Some(0)]
        );
        assert_eq!([of("cycles"), of("branches"), of("latency")], [None; 3]);
    }

    #[test]
    fn loops_are_counted_where_the_driver_does_not() {
        let mut figures = Figures::default();
        figures.count_loops("block b0:\n    con loop {\n        loop {\n    }\n}\n");
        assert_eq!(figures.loops, Some(2));
        let mut figures = Figures::default();
        figures.count_loops(
            "con block b0:  // preds:\n  div block b2:   // preds: b1 b7\n  div block b3:  // preds: b2, succs: b4\n",
        );
        assert_eq!(figures.loops, Some(1));
        let mut figures = Figures::default();
        figures.count_loops("block b0:  // preds:\n");
        assert_eq!(figures.loops, Some(0));
    }
}

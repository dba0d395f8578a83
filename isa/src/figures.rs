//! Figures that the compiler reports, and counts of its machine code.

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

/// A compiler's figures of one shader. Registers and cycles are of a wave.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Figures {
    /// All instructions.
    pub instructions: u64,
    /// Instructions on vector registers, a lane each.
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
    /// Vector registers.
    pub vector_registers: u64,
    /// Scalar registers.
    pub scalar_registers: u64,
    /// Registers of both kinds that did not fit and lie in memory.
    pub spilled: u64,
    /// Waves that a SIMD unit can hold at once: the more, the better waits are hidden.
    pub occupancy: u64,
    /// Bytes of machine code.
    pub code_size: u64,
    /// Bytes of shared memory a workgroup.
    pub shared_memory: u64,
    /// Cycles from a wave's first to its last instruction, alone on its unit. Those of loops are guesses.
    pub latency: u64,
    /// Cycles of a wave where enough of them hide each other's waits: the shader's cost. Those of loops are guesses.
    pub inverse_throughput: u64,
    /// Figures by the driver's own names for them, where it is not Mesa's for AMD GPUs.
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

    /// Returns the figures that fit on one line.
    pub fn in_short(&self) -> [(&'static str, u64); 8] {
        let all = self.named_figures();
        [0, 1, 3, 4, 5, 8, 11, 12].map(|k| all[k])
    }

    /// Takes one of the compiler's own figures, by its own name for it.
    pub(crate) fn record_figure(&mut self, name: &str, value: u64) {
        match name {
            "Instructions" => self.instructions = value,
            "VGPRs" | "Register Count" => self.vector_registers = value,
            "SGPRs" => self.scalar_registers = value,
            "Spilled VGPRs" | "Spilled SGPRs" => self.spilled += value,
            "Subgroups per SIMD" => self.occupancy = value,
            "Code size" | "Binary Size" => self.code_size = value,
            "LDS size" => self.shared_memory = value,
            "Latency" => self.latency = value,
            "Inverse Throughput" => self.inverse_throughput = value,
            // Branches are counted in the machine code, which knows jumps that this does not.
            _ => {}
        }
    }

    /// Counts instructions by kind in the machine code as text.
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

#[cfg(test)]
mod tests {
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

    #[test]
    fn spilled_registers_of_both_kinds_are_one_figure() {
        let mut figures = Figures::default();
        figures.record_figure("Spilled VGPRs", 2);
        figures.record_figure("Spilled SGPRs", 3);
        figures.record_figure("Driver pipeline hash", 99);
        assert_eq!(
            figures,
            Figures {
                spilled: 5,
                ..Figures::default()
            }
        );
    }
}

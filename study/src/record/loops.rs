//! Record of unrolled against looped forms.

use super::{Circumstances, FormKind, Record};
use crate::statistics::{Interval, Noise, mark_ratio};
use serde::{Deserialize, Serialize};
use straightline_bench::execute::Times;
use straightline_kernels::OptionText;
use straightline_table::{Cell, Column, Table};

/// A kernel in one form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FormRecord {
    /// Kind of the form.
    pub kind: FormKind,
    /// Hash of its WGSL: FNV-1a of 64 bits; `None` in records from before it was introduced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hash: Option<String>,
    /// Number of loops left.
    pub loops: u32,
    /// Statements of the emitted text.
    pub statements: u32,
    /// Texture and buffer reads of one invocation.
    pub reads: u32,
    /// Bytes of SPIR-V as emitted, names included.
    pub spirv_bytes: usize,
    /// Milliseconds until the shader was ready. Includes pipeline creation, with wgpu's translation of the checked shader
    /// and the driver's compilation, and the excess of the first frame over later ones. The text is unique, so that no
    /// driver has it in a cache; naga's parsing and validation are excluded.
    pub pipeline_ms: f64,
    /// Time of a frame.
    pub time: Times,
    /// Speedup over `Looped`.
    pub ratio: Interval,
    /// Largest difference to the same kernel in `f64`, without the thousandth of the pixels that differ most; `None` for
    /// the floor, which computes nothing.
    pub difference_999: Option<f64>,
    /// Largest difference over all pixels.
    pub difference: Option<f64>,
}

/// A kernel in every form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KernelForms {
    /// Display name: the kernel's, with its distinguishing options.
    pub kernel: String,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// Input of the runs.
    pub input: String,
    /// Forms of the kernel, `Looped` first. Missing forms are omitted.
    pub forms: Vec<FormRecord>,
    /// Missing forms, with the reasons.
    pub absent: Vec<(FormKind, String)>,
}

impl KernelForms {
    /// Returns the form of that kind, if the kernel has it.
    pub fn form(&self, kind: FormKind) -> Option<&FormRecord> {
        self.forms.iter().find(|form| form.kind == kind)
    }
}

/// Benefit of unrolling.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoopsRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// All kernels.
    pub kernels: Vec<KernelForms>,
}

impl Record for LoopsRecord {
    const STEM: &'static str = "loops";

    fn to_table(&self) -> Table {
        self.tabulate(&self.kernels)
    }
}

impl LoopsRecord {
    /// Returns the table of some of the kernels.
    pub fn tabulate<'r>(&self, kernels: impl IntoIterator<Item = &'r KernelForms>) -> Table {
        let noise = self.noise();
        let rows = kernels.into_iter();
        let rows = rows.flat_map(|kernel| kernel.forms.iter().map(move |form| (&kernel.kernel, form)));
        let off = |value: Option<f64>| value.map(|value| Cell::scientific(value, 1));
        Table::of(rows)
            .column(Column::from("kernel").grouped(), |(kernel, _)| *kernel)
            .column(Column::from("form").left(), |(_, form)| {
                Cell::new(super::json_name(&form.kind), form.kind.display_name())
            })
            .column("loops", |(_, form)| form.loops)
            .column("statements", |(_, form)| form.statements)
            .column("reads", |(_, form)| form.reads)
            .column(("spirv_bytes", "SPIR-V, kB"), |(_, form)| {
                Cell::new(
                    form.spirv_bytes.to_string(),
                    format!("{:.1}", form.spirv_bytes as f64 / 1e3),
                )
            })
            .fixed(("pipeline_ms", "ready in, ms"), 0, |(_, form)| form.pipeline_ms)
            .fixed(("median_ms", "ms"), 2, |(_, form)| form.time.median_ms)
            .fixed(("min_ms", "least"), 2, |(_, form)| form.time.min_ms)
            .fixed(("max_ms", "most"), 2, |(_, form)| form.time.max_ms)
            .column(Column::interval("speedup"), |(_, form)| {
                Cell::interval(form.ratio.to_array(), 2).suffixed(form.mark(noise))
            })
            .column(("off_f64_999", "off f64, 99.9 %"), |(_, form)| off(form.difference_999))
            .column(("off_f64_largest", "largest"), |(_, form)| off(form.difference))
            .column(Column::exact("hash"), |(_, form)| form.hash.as_ref())
            .finish()
    }

    /// Returns the noise that equal forms show; `None` if no two are equal, or the record has no rounds.
    pub fn noise(&self) -> Option<Noise> {
        let kernels = self.kernels.iter().enumerate();
        Noise::from_run(kernels.flat_map(|(group, kernel)| {
            kernel.forms.iter().filter_map(move |form| {
                // The bound on loops is no part of the text.
                let is_unbounded = form.loops > 0 && form.kind.is_unbounded();
                let shader = format!("{group} {} {is_unbounded}", form.hash.as_ref()?);
                Some((shader, form.time.rounds_ms.as_slice()))
            })
        }))
    }
}

impl FormRecord {
    /// Returns the mark of the form's ratio, if it is within the noise.
    pub fn mark(&self, noise: Option<Noise>) -> &'static str {
        match self.kind {
            FormKind::Looped => "",
            _ => mark_ratio(noise, self.ratio.median),
        }
    }
}

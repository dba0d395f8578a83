//! Record of unrolled against looped forms.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_bench::execute::{Ratio, Times};
use straightline_kernels::OptionText;

/// Form of a kernel's loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FormKind {
    /// Loops left in the shader, as wgpu compiles them: with a bound on the iterations of each. The baseline of all
    /// comparisons.
    Looped,
    /// Loops left in the shader, without that bound.
    LoopedUnchecked,
    /// Hand-optimised loops: repeated reads are done once, into arrays.
    LoopedByHand,
    /// Hand-optimised loops without the bound, so that compilers can unroll them.
    LoopedByHandUnchecked,
    /// Loops left with two iterations in a row.
    Partial2,
    /// Loops left with four iterations in a row.
    Partial4,
    /// No loop left; each read as often as the source performs it.
    FullUnshared,
    /// No loop left; each distinct read once.
    Full,
    /// As `Full`, with 2x2 pixels per invocation.
    FullBlock,
    /// As `Full`, with reads shared by the pixels of a workgroup through its memory.
    FullTile,
    /// As `Full`, with gathers: four texels in one read, where several of them are needed.
    FullGather,
    /// As `Full`, with mathematics that may change roundings.
    FullFast,
    /// As `Full`, computed in half precision.
    FullHalf,
    /// The reads and the store of `Full`, with almost no arithmetic between: a lower bound for every form.
    Floor,
}

impl FormKind {
    /// Every form, in the order of tables.
    pub const ALL: [FormKind; 14] = [
        FormKind::Looped,
        FormKind::LoopedUnchecked,
        FormKind::LoopedByHand,
        FormKind::LoopedByHandUnchecked,
        FormKind::Partial2,
        FormKind::Partial4,
        FormKind::FullUnshared,
        FormKind::Full,
        FormKind::FullBlock,
        FormKind::FullTile,
        FormKind::FullGather,
        FormKind::FullFast,
        FormKind::FullHalf,
        FormKind::Floor,
    ];

    /// A name for people.
    pub fn display_name(self) -> &'static str {
        match self {
            FormKind::Looped => "looped",
            FormKind::LoopedUnchecked => "looped, unbounded",
            FormKind::LoopedByHand => "looped, hand-optimised",
            FormKind::LoopedByHandUnchecked => "hand-optimised, unbounded",
            FormKind::Partial2 => "partial(2)",
            FormKind::Partial4 => "partial(4)",
            FormKind::FullUnshared => "unrolled, loads not shared",
            FormKind::Full => "unrolled",
            FormKind::FullBlock => "unrolled, 2×2 pixels",
            FormKind::FullTile => "unrolled, shared by workgroups",
            FormKind::FullGather => "unrolled, gathered",
            FormKind::FullFast => "unrolled, fast mathematics",
            FormKind::FullHalf => "unrolled, f16",
            FormKind::Floor => "floor",
        }
    }
}

/// A kernel in one form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FormRecord {
    /// Kind of the form.
    pub kind: FormKind,
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
    pub ratio: Ratio,
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

    fn to_table(&self) -> (Vec<&'static str>, Vec<Vec<String>>) {
        let head = vec![
            "kernel",
            "form",
            "loops",
            "statements",
            "reads",
            "spirv_bytes",
            "pipeline_ms",
            "median_ms",
            "min_ms",
            "max_ms",
            "speedup",
            "speedup_low",
            "speedup_high",
            "off_f64_999",
            "off_f64_largest",
        ];
        let optional = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:.3e}"));
        let rows = self.kernels.iter().flat_map(|kernel| {
            kernel.forms.iter().map(move |form| {
                vec![
                    kernel.kernel.clone(),
                    super::json_name(&form.kind),
                    form.loops.to_string(),
                    form.statements.to_string(),
                    form.reads.to_string(),
                    form.spirv_bytes.to_string(),
                    format!("{:.3}", form.pipeline_ms),
                    format!("{:.4}", form.time.median_ms),
                    format!("{:.4}", form.time.min_ms),
                    format!("{:.4}", form.time.max_ms),
                    format!("{:.3}", form.ratio.median),
                    format!("{:.3}", form.ratio.low),
                    format!("{:.3}", form.ratio.high),
                    optional(form.difference_999),
                    optional(form.difference),
                ]
            })
        });
        (head, rows.collect())
    }
}

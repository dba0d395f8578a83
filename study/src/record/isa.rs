//! Figures of GPU compilers for shaders.

use super::Record;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use straightline_isa::{Family, Figures};
use straightline_kernels::OptionText;

/// A form of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IsaForm {
    /// Straight-line code.
    Unrolled,
    /// The kernel with its loops.
    Looped,
    /// Loops, hand-optimised.
    ByHand,
    /// Straight-line code for 2×2 pixels; the figures are of all four.
    Block,
    /// Straight-line code, the pixels of a workgroup sharing what they read through its memory.
    Tile,
    /// Straight-line code, four texels read at once where several of them are wanted.
    Gather,
    /// Straight-line code, with algebra that may change roundings.
    Fast,
    /// Straight-line code that Slang's compiler made of the same work.
    Slang,
}

impl IsaForm {
    /// Every form.
    pub const ALL: [IsaForm; 8] = [
        IsaForm::Unrolled,
        IsaForm::Looped,
        IsaForm::ByHand,
        IsaForm::Block,
        IsaForm::Tile,
        IsaForm::Gather,
        IsaForm::Fast,
        IsaForm::Slang,
    ];

    /// Name for readers.
    pub fn display_name(self) -> &'static str {
        match self {
            IsaForm::Unrolled => "unrolled",
            IsaForm::Looped => "looped",
            IsaForm::ByHand => "looped, hand-optimised",
            IsaForm::Block => "unrolled, 2x2 pixels",
            IsaForm::Tile => "unrolled, shared by workgroups",
            IsaForm::Gather => "unrolled, gathered",
            IsaForm::Fast => "unrolled, fast mathematics",
            IsaForm::Slang => "unrolled, by Slang",
        }
    }
}

/// Path of a shader to SPIR-V.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpirvPath {
    /// From WGSL, as wgpu does it for shaders that the runtime has shown to end.
    Naga,
    /// From WGSL, with a counter in every loop that ends it, as wgpu does it for others.
    NagaBounded,
    /// From GLSL, as most engines on Vulkan do it.
    Glslang,
}

impl SpirvPath {
    /// Every path.
    pub const ALL: [SpirvPath; 3] = [SpirvPath::Naga, SpirvPath::NagaBounded, SpirvPath::Glslang];

    /// Name for readers.
    pub fn display_name(self) -> &'static str {
        match self {
            SpirvPath::Naga => "naga",
            SpirvPath::NagaBounded => "naga, bounded",
            SpirvPath::Glslang => "glslang",
        }
    }
}

/// A form of a kernel, and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// The kernel.
    pub kernel: String,
    /// Options that are not its default.
    pub options: Vec<OptionText>,
    /// The form.
    pub form: IsaForm,
    /// Path to SPIR-V.
    pub path: SpirvPath,
    /// Scalars alive at once at most, as its manifest says; of a text that is not ours, nothing.
    #[serde(default)]
    pub alive: Option<u32>,
    /// Figures of each compiler.
    pub figures: BTreeMap<Family, Figures>,
    /// Why one of them says nothing.
    pub refused: Option<String>,
}

/// Figures of all shaders by all compilers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IsaRecord {
    /// The command that asks again.
    pub command: String,
    /// When it began: RFC 3339, UTC.
    pub date: String,
    /// Name that each compiler has for its GPU, with the driver's version.
    pub devices: BTreeMap<Family, String>,
    /// Families that this driver does not compile for, and what became of the attempt.
    pub absent: BTreeMap<Family, String>,
    /// Every form of every kernel.
    pub shaders: Vec<Asked>,
}

impl Record for IsaRecord {
    const STEM: &'static str = "isa";

    fn to_table(&self) -> (Vec<&'static str>, Vec<Vec<String>>) {
        let mut head = vec!["kernel", "options", "form", "SPIR-V by", "alive", "family"];
        head.extend(Figures::default().named_figures().map(|(name, _)| name));
        let row = |asked: &Asked, family: &Family, figures: &Figures| {
            let options: Vec<String> = asked.options.iter().map(|(k, v)| format!("{k}={v}")).collect();
            let alive = asked.alive.map_or(String::new(), |alive| alive.to_string());
            let words = [
                &*asked.kernel,
                &options.join(" "),
                asked.form.display_name(),
                asked.path.display_name(),
                &alive,
                family.name(),
            ];
            let words = words.map(str::to_owned).into_iter();
            words
                .chain(figures.named_figures().map(|(_, figure)| figure.to_string()))
                .collect()
        };
        let shaders = self.shaders.iter();
        let rows = shaders.flat_map(|asked| asked.figures.iter().map(move |(family, f)| row(asked, family, f)));
        (head, rows.collect())
    }
}

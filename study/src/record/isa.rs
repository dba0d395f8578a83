//! Record of GPU compilers' statistics for shaders.

use super::{FormKind, Record, join_options};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use straightline_isa::{Figures, Gpu};
use straightline_kernels::OptionText;
use straightline_table::{Column, Table};

/// Path of a shader to SPIR-V.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpirvPath {
    /// From WGSL, as wgpu compiles shaders that the runtime has proved to terminate.
    Naga,
    /// From WGSL, with a counter that bounds every loop, as wgpu compiles other shaders.
    NagaBounded,
    /// From WGSL without that counter, with a hint to the driver that loops shall stay.
    NagaKept,
    /// From WGSL without that counter, with a hint to the driver that loops shall be unrolled.
    NagaUnrolled,
    /// From GLSL, as most engines on Vulkan do.
    Glslang,
}

impl SpirvPath {
    /// Every path.
    pub const ALL: [SpirvPath; 5] = [
        SpirvPath::Naga,
        SpirvPath::NagaBounded,
        SpirvPath::NagaKept,
        SpirvPath::NagaUnrolled,
        SpirvPath::Glslang,
    ];

    /// Name for readers.
    pub fn display_name(self) -> &'static str {
        match self {
            SpirvPath::Naga => "naga",
            SpirvPath::NagaBounded => "naga, bounded",
            SpirvPath::NagaKept => "naga, not to be unrolled",
            SpirvPath::NagaUnrolled => "naga, to be unrolled",
            SpirvPath::Glslang => "glslang",
        }
    }
}

/// A form of a kernel, and its compilation results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// The kernel.
    pub kernel: String,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// The form.
    pub form: FormKind,
    /// Path to SPIR-V.
    pub path: SpirvPath,
    /// Maximum number of live scalars, from its manifest; `None` for foreign text.
    #[serde(default)]
    pub alive: Option<u32>,
    /// Figures of each compiler.
    pub figures: BTreeMap<Gpu, Figures>,
    /// Reason why a compiler has no figures.
    pub refused: Option<String>,
}

/// Figures of all shaders by all compilers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IsaRecord {
    /// Command that reproduces the record.
    pub command: String,
    /// Start of the run: RFC 3339, UTC.
    pub date: String,
    /// Each compiler's name for its GPU, with the driver's version.
    pub devices: BTreeMap<Gpu, String>,
    /// GPUs that no driver at hand compiles for, with the error.
    pub absent: BTreeMap<Gpu, String>,
    /// Every form of every kernel.
    pub shaders: Vec<Asked>,
}

impl Record for IsaRecord {
    const STEM: &'static str = "isa";

    fn to_table(&self) -> Table {
        let rows = self.shaders.iter();
        let rows = rows.flat_map(|asked| asked.figures.iter().map(move |(gpu, figures)| (asked, gpu, figures)));
        let in_short = Figures::names_in_short();
        Table::of(rows)
            .column("kernel", |(asked, ..)| &asked.kernel)
            .column(Column::exact("options"), |(asked, ..)| join_options(&asked.options))
            .column(Column::from("form").left(), |(asked, ..)| asked.form.display_name())
            .column(Column::from("SPIR-V by").left(), |(asked, ..)| {
                asked.path.display_name()
            })
            .column(Column::exact("alive"), |(asked, ..)| asked.alive)
            .column(Column::exact("GPU"), |(_, gpu, _)| gpu.to_string())
            .columns(
                Figures::default().named_figures().into_iter().enumerate(),
                |(_, (name, _))| match in_short.contains(name) {
                    true => Column::from(*name),
                    false => Column::exact(*name),
                },
                |(.., figures), (k, _)| figures.known_figures()[*k].1,
            )
            .column(Column::exact("loops"), |(.., figures)| figures.loops)
            .column(Column::exact("by the driver's names"), |(.., figures)| {
                let own = figures.own.iter().map(|(name, figure)| format!("{name}: {figure}"));
                own.collect::<Vec<_>>().join("; ")
            })
            .finish()
    }
}

impl IsaRecord {
    /// Returns the names of the kernels, in the order of the record.
    pub fn kernels(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.shaders.iter().map(|asked| asked.kernel.as_str()).collect();
        names.dedup();
        names
    }

    /// Returns a form of a kernel by a path.
    pub fn shader(&self, kernel: &str, form: FormKind, path: SpirvPath) -> Option<&Asked> {
        let is = |asked: &&Asked| asked.kernel == kernel && asked.form == form && asked.path == path;
        self.shaders.iter().find(is)
    }

    /// Returns the figures of a form of a kernel by the first GPU.
    pub fn figures(&self, kernel: &str, form: FormKind, path: SpirvPath) -> Option<&Figures> {
        self.shader(kernel, form, path)?.figures.values().next()
    }

    /// Returns the figures of another form of a kernel with the same options, by naga and the first GPU.
    pub fn counterpart(&self, asked: &Asked, form: FormKind) -> Option<&Figures> {
        let is = |other: &&Asked| (&other.kernel, &other.options) == (&asked.kernel, &asked.options);
        let mut same = self.shaders.iter().filter(is);
        let found = same.find(|other| other.form == form && other.path == SpirvPath::Naga)?;
        found.figures.values().next()
    }

    /// Returns the record of one GPU alone.
    pub fn of_gpu(&self, gpu: Gpu) -> IsaRecord {
        let mut own = self.clone();
        own.shaders
            .iter_mut()
            .for_each(|asked| asked.figures.retain(|known, _| *known == gpu));
        own
    }
}

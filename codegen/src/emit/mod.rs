//! From a scheduled graph to text that reads as if written by a careful person.
//!
//! No decision about the computation is taken here: every step of the schedule becomes a statement or part of one.
//! WGSL and GLSL come from the emitter of this room; SPIR-V, HLSL and MSL are translated from the WGSL by naga,
//! which also validates every text before it is given out.

mod ast;
mod bindings;
mod check;
mod comments;
mod error;
mod half;
mod layout;
mod legalise;
mod lower;
mod manifest;
mod missing;
mod names;
mod parameters;
mod print;
mod resources;
mod spirv;
mod target;
mod text;
mod tidy;
mod translate;
mod words;

use crate::compiled::Compiled;
use crate::ir::{Graph, Invocation, Op};
use crate::passes::Schedule;
use crate::policy::Transport;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use straightline_manifest::{Counts, Format, Manifest, Precision, Stage};

pub use bindings::{Module, bindings};
pub use error::EmitError;
pub use target::Target;

/// One shader in the languages asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Emitted {
    /// What a host must know; the file names in it are set by [`Emitted::named`].
    pub manifest: Manifest,
    /// Contents by language.
    pub files: BTreeMap<Target, Vec<u8>>,
}

impl Emitted {
    /// Files by name, with the manifest that names them: `stem.wgsl`, `stem.json`, ...
    pub fn named(&self, stem: &str) -> BTreeMap<String, Vec<u8>> {
        let mut manifest = self.manifest.clone();
        let mut files = BTreeMap::new();
        for (target, bytes) in &self.files {
            let name = format!("{stem}.{}", target.extension(manifest.stage));
            manifest.files.insert(target.to_string(), name.clone());
            files.insert(name, bytes.clone());
        }
        files.insert(format!("{stem}.json"), manifest.to_json().into_bytes());
        files
    }
}

/// How a kernel is to be emitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EmitOptions {
    /// Pipeline stage.
    pub stage: Stage,
    /// Texel format of the output.
    pub format: Format,
    /// Invocations of a compute workgroup, across and down; `None` for [`EmitOptions::WORKGROUP`].
    pub workgroup: Option<[u32; 2]>,
    /// Whether the shader filters a rectangle that the host states, not all of the image: for tiles.
    pub region: bool,
    /// What the shader computes in. In half precision every float of the kernel is an `f16`: what is read is rounded once, as
    /// it comes in, and the result is an `f32` again when it is stored. Not in GLSL.
    pub precision: Precision,
    /// Languages.
    pub targets: BTreeSet<Target>,
    /// Whether WGSL with quad operations begins with `enable subgroups;`: browsers ask for it, naga and wgpu refuse it.
    pub enable_subgroups: bool,
    /// Whether naga leaves out the bound that it otherwise puts on the rounds of every loop of SPIR-V, HLSL and MSL. The
    /// loops that this generator emits end without one: each counts to an integer that is computed before it.
    pub unbounded_loops: bool,
}

impl EmitOptions {
    /// A row of pixels, as wide as WebGPU's default limits allow. On lavapipe rows were faster than squares of 8x8 or
    /// 16x16, looped and unrolled; on a GPU this has not been measured yet.
    pub const WORKGROUP: [u32; 2] = [256, 1];

    /// A compute shader in WGSL with an `rgba16float` output.
    pub fn new() -> Self {
        EmitOptions {
            stage: Stage::Compute,
            format: Format::default(),
            workgroup: None,
            region: false,
            precision: Precision::default(),
            targets: BTreeSet::from([Target::Wgsl]),
            enable_subgroups: false,
            unbounded_loops: false,
        }
    }

    /// For a stage.
    pub fn stage(mut self, stage: Stage) -> Self {
        self.stage = stage;
        self
    }

    /// With a texel format of the output.
    pub fn format(mut self, format: Format) -> Self {
        self.format = format;
        self
    }

    /// For a rectangle that the host states: one more uniform buffer says where it lies in the inputs and in the target.
    pub fn region(mut self, region: bool) -> Self {
        self.region = region;
        self
    }

    /// Computing in a precision.
    pub fn precision(mut self, precision: Precision) -> Self {
        self.precision = precision;
        self
    }

    /// Whether loops of SPIR-V, HLSL and MSL go without a bound of naga's.
    pub fn unbounded_loops(mut self, unbounded: bool) -> Self {
        self.unbounded_loops = unbounded;
        self
    }

    /// In these languages.
    pub fn targets(mut self, targets: impl IntoIterator<Item = Target>) -> Self {
        self.targets = targets.into_iter().collect();
        self
    }

    fn workgroup(&self) -> [u32; 3] {
        let [x, y] = self.workgroup.unwrap_or(Self::WORKGROUP);
        [x, y, 1]
    }
}

impl Default for EmitOptions {
    fn default() -> Self {
        Self::new()
    }
}

/// Statements of a kernel's body, the same in every language and stage.
pub fn statements(compiled: &Compiled) -> u32 {
    let kernel = kernel(compiled, Precision::F32);
    ast::count(&kernel.body) - compiled.graph.outputs().len() as u32
}

/// A number that a kernel's statements do not fall short of: quick to tell.
pub fn statements_at_least(graph: &Graph, schedule: &Schedule) -> u32 {
    let live = graph.ids().filter(|id| schedule.place[id.0 as usize].is_some());
    let costs = live.filter(|id| {
        !matches!(
            graph.node(*id).op,
            Op::Const(_) | Op::Extract(_) | Op::Splat | Op::Param(..)
        )
    });
    costs.count() as u32 / OPERATIONS
}

/// Nodes of the graph that a line of text may stand for.
const OPERATIONS: u32 = 32;

/// The kernel as invocations of the stage compute it.
fn for_stage(compiled: &Compiled, stage: Stage) -> Result<Cow<'_, Compiled>, EmitError> {
    let kernel = || compiled.kernel.clone();
    match (compiled.graph.invocation, stage) {
        (Invocation::Lane, Stage::Compute) => match compiled.transport {
            None => Ok(compiled.in_blocks()),
            Some(transport) => Err(EmitError::NoQuads {
                kernel: kernel(),
                transport: transport.to_string(),
            }),
        },
        (Invocation::Block(size), Stage::Fragment) if size != [1, 1] => Err(EmitError::OnePixel { kernel: kernel() }),
        _ => Ok(Cow::Borrowed(compiled)),
    }
}

/// The tree of a kernel's statements, with its outputs at the end.
fn kernel(compiled: &Compiled, precision: Precision) -> ast::Module<'_> {
    let half = precision == Precision::F16;
    let mut module = lower::lower(compiled, half);
    if half {
        legalise::half(&mut module);
    }
    tidy::tidy(&mut module, &compiled.graph);
    module
}

/// The tree of a shader, with comments, before a language's own rules.
fn tree<'g>(compiled: &'g Compiled, resources: &resources::Resources) -> ast::Module<'g> {
    let mut module = kernel(compiled, resources.options.precision);
    let body = std::mem::take(&mut module.body);
    module.body = comments::comment_groups(body, &compiled.graph);
    lower::entry(&mut module, resources);
    module
}

impl Compiled {
    /// The kernel as a shader, in every language asked for.
    ///
    /// # Errors
    ///
    /// It cannot be written so: what the stage or the language does not have.
    pub fn emit(&self, options: &EmitOptions) -> Result<Emitted, EmitError> {
        emit(self, options)
    }
}

/// Emits a kernel. Nothing is given out that naga does not validate.
fn emit(compiled: &Compiled, options: &EmitOptions) -> Result<Emitted, EmitError> {
    if let Some([x, y]) = options.workgroup
        && (x == 0 || y == 0 || x.saturating_mul(y) > 1024)
    {
        return Err(EmitError::Workgroup(x, y));
    }
    let compiled = &*for_stage(compiled, options.stage)?;
    let resources = resources::Resources::of(compiled, options)?;
    let tree = tree(compiled, &resources);
    // The header says how many blocks the shader has, and is a comment: what is counted is the same text.
    let mut counts = compiled.counts.clone();
    let wgsl = |counts: &Counts| {
        let mut tree = tree.clone();
        legalise::wgsl(&mut tree);
        names::assign(&mut tree, &resources, names::Words::Wgsl, &[]);
        let language = print::Wgsl { resources: &resources };
        print::module(&language, &tree, &print::header(compiled, counts, &resources))
    };
    let module = translate::Module::parse_wgsl(&compiled.kernel, &wgsl(&counts))?;
    let words = module.spirv(&resources)?;
    counts.basic_blocks = spirv::basic_blocks(&words);
    let wgsl = wgsl(&counts);
    let manifest = resources.manifest(compiled, &counts);
    let mut files = BTreeMap::new();
    for target in &options.targets {
        let bytes = match target {
            Target::Wgsl if options.enable_subgroups && resources.subgroups => {
                format!("enable subgroups;\n{}{wgsl}", gap(options.precision)).into_bytes()
            }
            Target::Wgsl => wgsl.clone().into_bytes(),
            Target::Glsl450 | Target::Glsl430 | Target::Glsl330 | Target::Essl310 | Target::Essl300 => {
                missing::check(compiled, &resources, *target)?;
                let mut tree = tree.clone();
                legalise::glsl(&mut tree, *target == Target::Glsl450);
                let language = print::Glsl::new(&resources, *target);
                names::assign(&mut tree, &resources, names::Words::Glsl, &language.names());
                let glsl = print::module(&language, &tree, &print::header(compiled, &counts, &resources));
                // naga reads no other GLSL.
                if *target == Target::Glsl450 {
                    check::check_glsl(&compiled.kernel, options.stage, &glsl, &resources.compared())?;
                }
                glsl.into_bytes()
            }
            Target::Spirv => words.iter().flat_map(|word| word.to_le_bytes()).collect(),
            Target::Hlsl => {
                let mut tree = tree.clone();
                legalise::hlsl(&mut tree);
                let resources = resources.for_hlsl();
                let language = print::Hlsl::new(&resources, &tree);
                names::assign(&mut tree, &resources, names::Words::Hlsl, &language.functions());
                print::module(&language, &tree, &print::header(compiled, &counts, &resources)).into_bytes()
            }
            Target::Msl if compiled.transport == Some(Transport::Derivatives) => {
                return Err(EmitError::Derivatives {
                    kernel: compiled.kernel.clone(),
                    target: "msl",
                });
            }
            Target::Msl => {
                let mut header = print::header(compiled, &counts, &resources);
                header.push(
                    "Translated by naga; resources are bound at the numbers of the manifest, each kind by itself."
                        .to_owned(),
                );
                format!("{}\n{}", print::commented(&header), module.msl(&resources)?).into_bytes()
            }
        };
        files.insert(*target, bytes);
    }
    Ok(Emitted { manifest, files })
}

/// What stands between a directive and a text that begins with another, or with its header.
fn gap(precision: Precision) -> &'static str {
    match precision {
        Precision::F32 => "\n",
        Precision::F16 => "",
    }
}

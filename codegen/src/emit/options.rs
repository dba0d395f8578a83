//! How a kernel is to be emitted.

use super::register::Register;
use super::target::Target;
use std::collections::BTreeSet;
use straightline_manifest::{Form, Format, Origin, Precision, Stage};

/// How a function ([`Form::Function`]) comes by the texels that it reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reads {
    /// Of textures and samplers, which are its parameters.
    #[default]
    Textures,
    /// By functions of the host's, defined before it: `load_NAME` gives the texel at a pixel, `sample_NAME` the filtered colour
    /// at a place from 0 to 1, `size_of_NAME` width and height. For hosts that give no texture, only a way to read one. In
    /// GLSL of OpenGL and HLSL; of two-dimensional textures of floats, at their finest level.
    Functions,
}

/// How a kernel is to be emitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EmitOptions {
    /// Pipeline stage. A function ([`Form::Function`]) is called by a fragment shader, whatever stands here.
    pub stage: Stage,
    /// Whether the shader is complete, or a function to be put into another.
    pub form: Form,
    /// How a function comes by its texels; of no account for a whole shader.
    pub reads: Reads,
    /// Whether a function in GLSL of OpenGL or HLSL reads uniforms by their names, which the host declares before it, and takes
    /// none. For hosts that do not let a parameter have the name of a uniform.
    pub global_uniforms: bool,
    /// Where row 0 of textures, target and positions is. From the lower left, the shader turns every row that it names, so that
    /// the kernel computes on the upright picture; shaders that cannot are refused.
    pub origin: Origin,
    /// Texel format of the output.
    pub format: Format,
    /// Invocations of a compute workgroup, across and down; `None` for [`EmitOptions::WORKGROUP`].
    pub workgroup: Option<[u32; 2]>,
    /// Whether the shader filters a rectangle that the host states, not all of the image: for tiles.
    pub region: bool,
    /// What the shader computes in. In half precision every float of the kernel is an `f16`: what is read is rounded once, as
    /// it comes in, and the result is an `f32` again when it is stored. Not in GLSL.
    pub precision: Precision,
    /// Whether a built-in kernel is written in half precision although hard cases show the loss
    /// ([`Compiled::half_precision`](crate::Compiled::half_precision)). Of one's own kernels one is the judge.
    pub accept_loss: bool,
    /// Languages.
    pub targets: BTreeSet<Target>,
    /// Bind group of everything, 0 to 31; devices promise four of them. HLSL has a register space for it.
    pub group: u32,
    /// Binding numbers, 0 to 999, by name: of textures, samplers and buffers, of `parameters`, the uniform buffer, of
    /// `destination`, the output, of `region`, and of the sampler `unfiltered` that GLSL 4.50 has. All else takes the lowest
    /// numbers that are free, in order. An output that has the name of an input is `output.NAME`; where a kernel has a use for
    /// one of the names that no kernel gives, that is `parameters_`, `region_` or `unfiltered_`.
    pub bindings: Vec<(String, u32)>,
    /// Registers of HLSL by name; by default each is numbered as its binding.
    pub registers: Vec<(String, Register)>,
    /// Words that no name in a text may be, beside those of its language: those that the text which it is put into has a use for. `gl_*` is every
    /// word that begins so, `*Sampler` every one that ends so.
    pub reserved: BTreeSet<String>,
    /// Languages whose words names stay clear of too, so that a host can have one name for several texts.
    pub clear_of: BTreeSet<Target>,
    /// Name of the entry point or function; by default the kernel's. That of a whole GLSL is `main`.
    pub entry: Option<String>,
    /// Whether WGSL with quad operations begins with `enable subgroups;`: browsers ask for it, naga and wgpu refuse it.
    pub enable_subgroups: bool,
    /// Whether naga leaves out the bound that it otherwise puts on the iterations of every loop of SPIR-V, HLSL and MSL. The
    /// loops that count end without one; a `while` whose trip count is a runtime value ends as the kernel sees to it.
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
            form: Form::default(),
            reads: Reads::default(),
            global_uniforms: false,
            origin: Origin::default(),
            format: Format::default(),
            workgroup: None,
            region: false,
            precision: Precision::default(),
            accept_loss: false,
            targets: BTreeSet::from([Target::Wgsl]),
            group: 0,
            bindings: Vec::new(),
            registers: Vec::new(),
            reserved: BTreeSet::new(),
            clear_of: BTreeSet::new(),
            entry: None,
            enable_subgroups: false,
            unbounded_loops: false,
        }
    }

    /// For a stage.
    pub fn stage(mut self, stage: Stage) -> Self {
        self.stage = stage;
        self
    }

    /// Complete, or a function.
    pub fn form(mut self, form: Form) -> Self {
        self.form = form;
        self
    }

    /// With textures as parameters, or functions of the host's.
    pub fn reads(mut self, reads: Reads) -> Self {
        self.reads = reads;
        self
    }

    /// With rows that count from above or from below.
    pub fn origin(mut self, origin: Origin) -> Self {
        self.origin = origin;
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

    /// Whatever half precision does to the picture: see [`EmitOptions::accept_loss`].
    pub fn accept_loss(mut self, accept: bool) -> Self {
        self.accept_loss = accept;
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

    /// In a bind group.
    pub fn group(mut self, group: u32) -> Self {
        self.group = group;
        self
    }

    /// With a binding number for what is called `name`: see [`EmitOptions::bindings`].
    pub fn binding(mut self, name: &str, number: u32) -> Self {
        self.bindings.push((name.to_owned(), number));
        self
    }

    /// With a register of HLSL for what is called `name`.
    pub fn register(mut self, name: &str, register: Register) -> Self {
        self.registers.push((name.to_owned(), register));
        self
    }

    /// With an entry point or function of this name.
    pub fn entry(mut self, name: &str) -> Self {
        self.entry = Some(name.to_owned());
        self
    }

    pub(super) fn workgroup(&self) -> [u32; 3] {
        let [x, y] = self.workgroup.unwrap_or(Self::WORKGROUP);
        [x, y, 1]
    }

    pub(super) fn is_function(&self) -> bool {
        self.form == Form::Function
    }

    /// Whether texels come from functions of the host's.
    pub(super) fn calls_host(&self) -> bool {
        self.is_function() && self.reads == Reads::Functions
    }

    pub(super) fn counts_from_below(&self) -> bool {
        self.origin == Origin::LowerLeft
    }

    /// Whether the entry point has a variable for the place that it writes, which is not the pixel then.
    pub(super) fn has_place(&self) -> bool {
        self.region || self.counts_from_below()
    }
}

impl Default for EmitOptions {
    fn default() -> Self {
        Self::new()
    }
}

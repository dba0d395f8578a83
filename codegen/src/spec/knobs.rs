//! Declaration of all knobs: the only place that names them, for `build.rs`, the command line, the page, `engine.toml` and
//! the studies. The doc comments are also the help of the command line, so they contain no links.

use super::declare::knobs;
use super::value::KnobValue;
use super::{DebugInfo, KernelConfig, Knob, Parameters, Part, Register, ShaderSpec, Target, Texels};
use std::collections::BTreeSet;
use std::fmt::Display;
use std::time::Duration;
use straightline_evaluator::limits::Limits;
use straightline_evaluator::policy::{Branches, LoopPolicy, Math, ReadOrder, Share, Transport, Unroll};
use straightline_kernels::OptionText;
use straightline_manifest::{Form, Format, Origin, Precision, Stage};

knobs! {
    /// Settings of a shader's computation: options of the kernel, and policies of its evaluation.
    Settings in settings {
        /// Value of an option of the kernel, in any spelling that its declaration accepts; other options keep their
        /// defaults. For a number, `uniform` lets the host set the value at run time. `override` is as
        /// `--override OPTION`.
        options: Vec<OptionText> = Vec::new(), "set" ["OPTION=VALUE"],
            set(option: &str, value: impl Display) |options| options.push((option.to_owned(), value.to_string())),
            example ("pattern", "latin16");
        /// Options of the kernel that the host may set when it creates the pipeline, separated by commas. Their values
        /// here are then defaults. For numbers and booleans that decide nothing in the text: `straightline list KERNEL`.
        overrides: BTreeSet<String> = BTreeSet::new(), "override" ["OPTIONS"],
            override_options(names: impl IntoIterator<Item = impl Into<String>>) |all| {
                all.extend(names.into_iter().map(Into::into));
            },
            example (["tau"]);
        /// Unroll policy of all loops: `full` unrolls them, `none` leaves them in the shader, and a factor such as `4`
        /// leaves loops with four iterations in a row.
        unroll: Unroll = Unroll::Full, "unroll" ["POLICY"],
            unroll(unroll: Unroll) |all| *all = unroll,
            example (Unroll::Partial(4));
        /// Unroll policy of one loop, overriding `unroll`. LOOP is `function.counter` as `explain` prints it, or just the
        /// counter.
        loops: Vec<LoopPolicy> = Vec::new(), "unroll-loop" ["LOOP=POLICY"],
            unroll_loop(path: &str, unroll: Unroll) |loops| loops.push((path.to_owned(), unroll)),
            example ("tap", Unroll::None);
        /// Code for an `if` on runtime values: `keep` emits a branch, `select` computes both sides. With `as-loops` a
        /// branch remains where loops remain.
        branches: Branches = Branches::AsLoops, "branches" ["POLICY"],
            branches(branches: Branches) |policy| *policy = branches,
            example (Branches::Keep);
        /// Order of texel reads: `source` keeps the order of the kernel's source, `rows` reads everything first, row by
        /// row. With `gather`, one read fetches the same component of four texels where several of them are needed. The
        /// picture is identical, bit for bit.
        reads: ReadOrder = ReadOrder::Source, "reads" ["ORDER"],
            reads(reads: ReadOrder) |order| *order = reads,
            example (ReadOrder::Rows);
        /// Repeat texel reads as often as the kernel's source does, instead of reading each texel once. Meant for studies
        /// of the benefit of sharing reads. The picture is identical, bit for bit.
        repeat_loads: bool = false, "repeat-loads",
            repeat_loads(repeat: bool) |repeats| *repeats = repeat,
            example (true);
        /// Maximum number of statements in the shader.
        budget: u32 = Settings::BUDGET, "budget" ["STATEMENTS"],
            budget(statements: u32) |budget| *budget = statements,
            example (500_000);
        /// Time limit for compiling and emitting, given as text in seconds. When it is exceeded, the error names the loops
        /// with the most work.
        time_limit: Duration = Limits::DEFAULT.time, "time-limit" ["SECONDS"],
            time_limit(time: Duration) |limit| *limit = time,
            example (Duration::from_secs(5));
        /// Memory limit, in bytes, for values and operations during compilation; given as text in millions of bytes.
        memory_limit: u64 = Limits::DEFAULT.memory, "memory-limit" ["MEGABYTES"],
            memory_limit(bytes: u64) |limit| *limit = bytes,
            example (500_000_000);
        /// Transport of values between the lanes of a pixel quad: `subgroup`, `derivatives` or `block`. By default,
        /// fragment shaders use subgroup operations and compute shaders use blocks. Applies only to quad kernels.
        transport: Option<Transport> = None, "transport" ["TRANSPORT"],
            transport(transport: impl Into<Option<Transport>>) |chosen| *chosen = transport.into(),
            example (Transport::Block);
        /// Sharing of texels between pixels: `invocation` shares none. With `workgroup`, a workgroup of 16x16 threads reads
        /// each texel once into its memory; `workgroup(WxH)` sets its width and height. The picture is identical, bit for
        /// bit.
        share: Share = Share::Invocation, "share" ["HOW"],
            share(share: Share) |how| *how = share,
            example (Share::WORKGROUP);
        /// Algebraic rules for floats: `exact` changes no bit of the result; `fast` may change roundings to use fewer and
        /// cheaper operations. `strict` is `exact`, and also keeps drivers from changing any rounding, at a cost.
        math: Math = Math::Exact, "math" ["HOW"],
            math(math: Math) |algebra| *algebra = math,
            example (Math::Fast);
        /// Variables, parameters and functions of the kernel whose values are computed in half precision, separated by
        /// commas; `straightline study precision` proposes some. For devices with half precision, and not for GLSL.
        half: BTreeSet<String> = BTreeSet::new(), "half" ["NAMES"],
            half(names: impl IntoIterator<Item = impl Into<String>>) |all| all.extend(names.into_iter().map(Into::into)),
            example (["sum"]);
        /// Width and height of the pixel block that one compute invocation computes, 1 to 64 pixels in total; neighbours
        /// share reads. Quad kernels need whole quads.
        block: [u32; 2] = [1, 1], "block" ["WxH"],
            block(width: u32, height: u32) |size| *size = [width, height],
            example (2, 2);
    }

    /// Settings of a shader's text: stage, languages, bindings and names.
    EmitOptions in emit {
        /// Pipeline stage: `compute` or `fragment`. With `form=function` the caller is always a fragment shader.
        stage: Stage = Stage::Compute, "stage" ["STAGE"],
            stage(stage: Stage) |chosen| *chosen = stage,
            example (Stage::Fragment);
        /// Languages to emit, separated by commas: wgsl, glsl450, glsl430, glsl330, essl310, essl300, spirv, hlsl, msl.
        targets: BTreeSet<Target> = BTreeSet::from([Target::Wgsl]), "target" ["LANGUAGES"],
            targets(targets: impl IntoIterator<Item = Target>) |all| *all = targets.into_iter().collect(),
            example ([Target::Wgsl, Target::Hlsl]);
        /// Texel format of the output: rgba8unorm, rgba16float or rgba32float.
        format: Format = Format::Rgba16Float, "format" ["FORMAT"],
            format(format: Format) |chosen| *chosen = format,
            example (Format::Rgba8Unorm);
        /// Precision of all floats in the kernel: `f32`, or `f16` on devices with half precision. With `f16`, inputs are
        /// rounded once, and the result is stored as `f32`. Not available in GLSL.
        precision: Precision = Precision::F32, "precision" ["PRECISION"],
            precision(precision: Precision) |chosen| *chosen = precision,
            example (Precision::F16);
        /// Emit a built-in kernel in f16 even if hard cases show visible errors.
        accept_loss: bool = false, "accept-loss",
            accept_loss(accept: bool) |accepted| *accepted = accept,
            example (true);
        /// Filter only a rectangle that the host sets, for tiled rendering. An additional uniform buffer holds its position
        /// in the inputs and in the target.
        region: bool = false, "region",
            region(region: bool) |given| *given = region,
            example (true);
        /// Width and height of a compute workgroup, in invocations; by default 16x16. With `share`, they share texels.
        workgroup: Option<[u32; 2]> = None, "workgroup" ["WxH"],
            workgroup(width: u32, height: u32) |size| *size = Some([width, height]),
            example (8, 8);
        /// Form of the output: `entry` for a whole shader, or `function` for a function that your fragment shader calls.
        /// The inputs of a function are its parameters.
        form: Form = Form::Entry, "form" ["FORM"],
            form(form: Form) |chosen| *chosen = form,
            example (Form::Function);
        /// Corner of row 0 of textures, target and positions: `upper-left`, or `lower-left` as in engines on OpenGL. The
        /// kernel computes on the upright picture in both cases.
        origin: Origin = Origin::UpperLeft, "origin" ["ORIGIN"],
            origin(origin: Origin) |chosen| *chosen = origin,
            example (Origin::LowerLeft);
        /// Name of the entry point or function; by default the kernel's name. The entry point of a whole GLSL shader is
        /// always `main`.
        entry: Option<String> = None, "entry" ["NAME"],
            entry(name: &str) |entry| *entry = Some(name.to_owned()),
            example ("antialias");
        /// Bind group, descriptor set or register space of all resources, 0 to 31. Devices guarantee only four groups.
        group: u32 = 0, "group" ["N"],
            group(group: u32) |number| *number = group,
            example (1);
        /// Binding number, 0 to 999, of a texture, sampler or buffer. NAME may also be `parameters` (the uniforms),
        /// `destination` (the output), `region`, or the sampler `unfiltered` of GLSL 4.50. All other resources take the
        /// lowest free numbers, in order. For an output with the name of an input, use `output.NAME`.
        bindings: Vec<(String, u32)> = Vec::new(), "binding" ["NAME=N"],
            binding(name: &str, number: u32) |bindings| bindings.push((name.to_owned(), number)),
            example ("color", 3);
        /// Register in HLSL, NAME=t3 or NAME=t3,space1; by default derived from the binding number, in the space of the
        /// group.
        registers: Vec<(String, Register)> = Vec::new(), "register" ["NAME=REGISTER"],
            register(name: &str, register: Register) |registers| registers.push((name.to_owned(), register)),
            example ("color", "t3".parse().expect("a register"));
        /// Address space of the uniforms: `uniform` puts them into a buffer, `immediate` into the commands, up to 128 bytes.
        /// These are immediates in WebGPU, push constants in Vulkan and root constants in Direct3D 12; GLSL for OpenGL has
        /// loose uniforms in both cases. For whole shaders.
        parameters: Parameters = Parameters::Uniform, "parameters" ["SPACE"],
            parameters(space: Parameters) |chosen| *chosen = space,
            example (Parameters::Immediate);
        /// Begin WGSL with quad operations with `enable subgroups;`, which browsers require and wgpu rejects.
        enable_subgroups: bool = false, "enable-subgroups",
            enable_subgroups(enable: bool) |enabled| *enabled = enable,
            example (true);
        /// Omit the bound on loop iterations that naga adds to every loop in SPIR-V, HLSL and MSL. Counted loops end
        /// without it. For a `while` on a runtime value, the kernel must ensure that the loop ends.
        unbounded_loops: bool = false, "unbounded-loops",
            unbounded_loops(unbounded: bool) |bounds| *bounds = unbounded,
            example (true);
        /// Source of a function's texels: `textures` passes textures as parameters, `functions` calls functions of the host
        /// that are defined before it. `load_NAME` returns the texel at a pixel, `sample_NAME` the filtered colour at
        /// coordinates from 0 to 1, `size_of_NAME` width and height. Host functions are available in GLSL for OpenGL and in
        /// HLSL, for the finest level of 2D float textures.
        texels: Texels = Texels::Textures, "texels" ["HOW"],
            texels(texels: Texels) |how| *how = texels,
            example (Texels::Functions);
        /// Read uniforms by name in a function in GLSL for OpenGL or HLSL, instead of taking them as parameters. The host
        /// declares them before the function.
        global_uniforms: bool = false, "global-uniforms",
            global_uniforms(global: bool) |chosen| *chosen = global,
            example (true);
        /// Words that are not allowed as names in the shader, in addition to those of its language, separated by commas.
        /// `gl_*` reserves every word with that prefix, `*Sampler` every word with that suffix.
        reserved: BTreeSet<String> = BTreeSet::new(), "reserve" ["WORDS"],
            reserve(words: impl IntoIterator<Item = String>) |reserved| reserved.extend(words),
            example (["light".to_owned()]);
        /// Omit comments, except for the first two lines of the header: the shader's description and its generator.
        strip_comments: bool = false, "strip-comments",
            strip_comments(strip: bool) |stripped| *stripped = strip,
            example (true);
        /// Debug information: `map` also writes NAME.map.json, which has the place of every statement in the kernel's
        /// source. `lines` puts these lines into the shader as well, for debuggers: `OpLine` in SPIR-V, `#line` in GLSL
        /// and HLSL.
        debug: DebugInfo = DebugInfo::None, "debug" ["WHAT"],
            debug(debug: DebugInfo) |chosen| *chosen = debug,
            example (DebugInfo::Lines);
        /// Languages whose reserved words are avoided as well, separated by commas, so that a host can use the same name in
        /// several languages.
        clear_of: BTreeSet<Target> = BTreeSet::new(), "clear-of" ["LANGUAGES"],
            clear_of(targets: impl IntoIterator<Item = Target>) |languages| languages.extend(targets),
            example ([Target::Hlsl]);
    }
}

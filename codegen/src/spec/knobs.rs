//! The declaration of every knob: the one place that names it, for `build.rs`, the command line, the page, `engine.toml` and
//! the studies. Its documentation is the help of the command line too, and so has no links.

use super::declare::knobs;
use super::value::KnobValue;
use super::{KernelConfig, Knob, Part, Register, ShaderSpec, Target, Texels};
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
        /// Value of an option of the kernel, in any spelling that its declaration takes; other options stay at their defaults.
        /// A number may be `uniform`: the host sets it at run time.
        options: Vec<OptionText> = Vec::new(), "set" ["OPTION=VALUE"],
            set(option: &str, value: impl Display) |options| options.push((option.to_owned(), value.to_string())),
            example ("pattern", "latin16");
        /// Unroll policy of all loops: `full`, `none`, or a factor such as `4`, which leaves loops with four iterations in a
        /// row.
        unroll: Unroll = Unroll::Full, "unroll" ["POLICY"],
            unroll(unroll: Unroll) |all| *all = unroll,
            example (Unroll::Partial(4));
        /// Unroll policy of one loop, in place of that of all: LOOP is `function.counter` as `explain` prints it, or the counter
        /// alone.
        loops: Vec<LoopPolicy> = Vec::new(), "unroll-loop" ["LOOP=POLICY"],
            unroll_loop(path: &str, unroll: Unroll) |loops| loops.push((path.to_owned(), unroll)),
            example ("tap", Unroll::None);
        /// Form of an `if` on runtime values: `keep` leaves a branch, `select` computes both sides, `as-loops` leaves a branch
        /// where loops are left.
        branches: Branches = Branches::AsLoops, "branches" ["POLICY"],
            branches(branches: Branches) |policy| *policy = branches,
            example (Branches::Keep);
        /// Order in which texels are read: `source` as in the kernel's text, `rows` all at first, row by row, `gather` four at
        /// once, of one component, where several of them are wanted. The picture is the same, bit for bit.
        reads: ReadOrder = ReadOrder::Source, "reads" ["ORDER"],
            reads(reads: ReadOrder) |order| *order = reads,
            example (ReadOrder::Rows);
        /// Read a texel as often as the kernel's text asks for it instead of once, for studies of what sharing reads is worth.
        /// The picture is the same, bit for bit.
        repeat_loads: bool = false, "repeat-loads",
            repeat_loads(repeat: bool) |repeats| *repeats = repeat,
            example (true);
        /// Most statements that the shader may have.
        budget: u32 = Settings::BUDGET, "budget" ["STATEMENTS"],
            budget(statements: u32) |budget| *budget = statements,
            example (500_000);
        /// Longest time that compiling and emitting may take; as text in seconds. Beyond it an error names the loops with the
        /// most work.
        time_limit: Duration = Limits::DEFAULT.time, "time-limit" ["SECONDS"],
            time_limit(time: Duration) |limit| *limit = time,
            example (Duration::from_secs(5));
        /// Most memory, in bytes, that values and operations may take during compilation; as text in millions of bytes.
        memory_limit: u64 = Limits::DEFAULT.memory, "memory-limit" ["MEGABYTES"],
            memory_limit(bytes: u64) |limit| *limit = bytes,
            example (500_000_000);
        /// Transport of values between the lanes of a pixel quad: `subgroup`, `derivatives` or `block`; by default subgroup operations
        /// in fragment shaders and blocks in compute. Of kernels of quads.
        transport: Option<Transport> = None, "transport" ["TRANSPORT"],
            transport(transport: impl Into<Option<Transport>>) |chosen| *chosen = transport.into(),
            example (Transport::Block);
        /// Texels that pixels share: with `invocation` none; with `workgroup` a workgroup of 16x16 threads, or of
        /// `workgroup(WxH)`, reads each texel once into its memory. The picture is the same, bit for bit.
        share: Share = Share::Invocation, "share" ["HOW"],
            share(share: Share) |how| *how = share,
            example (Share::WORKGROUP);
        /// Algebra with floats: `exact` changes no bit of the result, `fast` may change roundings, for fewer and cheaper
        /// operations; `strict` is `exact` and keeps drivers from changing any rounding, at a cost.
        math: Math = Math::Exact, "math" ["HOW"],
            math(math: Math) |algebra| *algebra = math,
            example (Math::Fast);
        /// Pixels that one compute invocation computes, across and down, 1 to 64 together: neighbours share reads. Of kernels
        /// of quads whole quads.
        block: [u32; 2] = [1, 1], "block" ["WxH"],
            block(width: u32, height: u32) |size| *size = [width, height],
            example (2, 2);
    }

    /// Settings of a shader's text: stage, languages, bindings and names.
    EmitOptions in emit {
        /// Pipeline stage: `compute` or `fragment`. A function (see `form`) is called by a fragment shader in any case.
        stage: Stage = Stage::Compute, "stage" ["STAGE"],
            stage(stage: Stage) |chosen| *chosen = stage,
            example (Stage::Fragment);
        /// Languages to write, separated by commas: wgsl, glsl450, glsl430, glsl330, essl310, essl300, spirv, hlsl, msl.
        targets: BTreeSet<Target> = BTreeSet::from([Target::Wgsl]), "target" ["LANGUAGES"],
            targets(targets: impl IntoIterator<Item = Target>) |all| *all = targets.into_iter().collect(),
            example ([Target::Wgsl, Target::Hlsl]);
        /// Texel format of the output: rgba8unorm, rgba16float or rgba32float.
        format: Format = Format::Rgba16Float, "format" ["FORMAT"],
            format(format: Format) |chosen| *chosen = format,
            example (Format::Rgba8Unorm);
        /// Precision of every float of the kernel: `f32`, or `f16` where the device has half precision. What is read is rounded
        /// once, the result is stored as an `f32`. Not in GLSL.
        precision: Precision = Precision::F32, "precision" ["PRECISION"],
            precision(precision: Precision) |chosen| *chosen = precision,
            example (Precision::F16);
        /// Write a built-in kernel in f16 even where hard cases show errors that can be seen.
        accept_loss: bool = false, "accept-loss",
            accept_loss(accept: bool) |accepted| *accepted = accept,
            example (true);
        /// Filter only a rectangle that the host gives, for tiles: one more uniform buffer says where it lies in the inputs and
        /// in the target.
        region: bool = false, "region",
            region(region: bool) |given| *given = region,
            example (true);
        /// Invocations of a compute workgroup, across and down, by default 256x1; with `share` those that share, by default
        /// 16x16.
        workgroup: Option<[u32; 2]> = None, "workgroup" ["WxH"],
            workgroup(width: u32, height: u32) |size| *size = Some([width, height]),
            example (8, 8);
        /// A whole shader (`entry`), or a function to call from a fragment shader of yours (`function`), whose inputs are its
        /// parameters.
        form: Form = Form::Entry, "form" ["FORM"],
            form(form: Form) |chosen| *chosen = form,
            example (Form::Function);
        /// Corner where row 0 of textures, target and positions is: `upper-left`, or `lower-left` as in engines on OpenGL. The kernel
        /// computes on the upright picture in both.
        origin: Origin = Origin::UpperLeft, "origin" ["ORIGIN"],
            origin(origin: Origin) |chosen| *chosen = origin,
            example (Origin::LowerLeft);
        /// Name of the entry point or function; by default the kernel's. That of a whole GLSL is `main`.
        entry: Option<String> = None, "entry" ["NAME"],
            entry(name: &str) |entry| *entry = Some(name.to_owned()),
            example ("antialias");
        /// Bind group, descriptor set or register space of everything, 0 to 31; devices promise four of them.
        group: u32 = 0, "group" ["N"],
            group(group: u32) |number| *number = group,
            example (1);
        /// Binding number, 0 to 999, of a texture, sampler or buffer, of `parameters` (the uniforms), `destination` (the
        /// output), `region`, or the sampler `unfiltered` of GLSL 4.50; all else takes the lowest free numbers, in order. An
        /// output that has the name of an input is `output.NAME`.
        bindings: Vec<(String, u32)> = Vec::new(), "binding" ["NAME=N"],
            binding(name: &str, number: u32) |bindings| bindings.push((name.to_owned(), number)),
            example ("color", 3);
        /// Register in HLSL, NAME=t3 or NAME=t3,space1; by default that of the binding number, in the space of the group.
        registers: Vec<(String, Register)> = Vec::new(), "register" ["NAME=REGISTER"],
            register(name: &str, register: Register) |registers| registers.push((name.to_owned(), register)),
            example ("color", "t3".parse().expect("a register"));
        /// Begin WGSL that has quad operations with `enable subgroups;`, as browsers want it and wgpu does not.
        enable_subgroups: bool = false, "enable-subgroups",
            enable_subgroups(enable: bool) |enabled| *enabled = enable,
            example (true);
        /// Leave out the bound that naga puts on the iterations of every loop of SPIR-V, HLSL and MSL. Loops that count end
        /// without one; a `while` on a runtime value ends as the kernel sees to it.
        unbounded_loops: bool = false, "unbounded-loops",
            unbounded_loops(unbounded: bool) |bounds| *bounds = unbounded,
            example (true);
        /// Source of the texels that a function reads: `textures`, its parameters, or `functions` of the host, defined before
        /// it: `load_NAME` returns the texel at a pixel, `sample_NAME` the filtered colour at a place from 0 to 1,
        /// `size_of_NAME` width and height. The latter in GLSL of OpenGL and HLSL, of 2D textures of floats, at their finest
        /// level.
        texels: Texels = Texels::Textures, "texels" ["HOW"],
            texels(texels: Texels) |how| *how = texels,
            example (Texels::Functions);
        /// Let a function in GLSL of OpenGL or HLSL read uniforms by their names, which the host declares before it, instead of
        /// taking them as parameters.
        global_uniforms: bool = false, "global-uniforms",
            global_uniforms(global: bool) |chosen| *chosen = global,
            example (true);
        /// Words that no name in the shader may be, beside those of its language, separated by commas: `gl_*` is every word
        /// that begins so, `*Sampler` every one that ends so.
        reserved: BTreeSet<String> = BTreeSet::new(), "reserve" ["WORDS"],
            reserve(words: impl IntoIterator<Item = String>) |reserved| reserved.extend(words),
            example (["light".to_owned()]);
        /// Leave out comments but for the first two lines of the header: what the shader is, and what it was generated by.
        strip_comments: bool = false, "strip-comments",
            strip_comments(strip: bool) |stripped| *stripped = strip,
            example (true);
        /// Languages whose words names stay clear of too, separated by commas, so that a host can have one name for several
        /// texts.
        clear_of: BTreeSet<Target> = BTreeSet::new(), "clear-of" ["LANGUAGES"],
            clear_of(targets: impl IntoIterator<Item = Target>) |languages| languages.extend(targets),
            example ([Target::Hlsl]);
    }
}

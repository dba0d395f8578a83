//! Bindings of a shader: only resources that are read or written.

use super::EmitOptions;
use super::comments::shown_path;
use super::derived::{self, Combined, Derived, HostFunction};
use super::layout::{layout_uniforms, value_type};
use super::outputs::BoundOutput;
use super::own_words::{DEFINE, OF_OUTPUT, OUTPUT, OUTPUTS, RESOLUTION, SAMPLER, UNIFORMS};
use super::places::{Named, Places};
use super::refusal::Refusal;
use super::words::free_name;
use crate::compiled::Compiled;
use crate::spec::{Parameters, Target};
use std::collections::{BTreeMap, BTreeSet};
use straightline_evaluator::diagnostic::Code;
use straightline_evaluator::ir::{
    Access, Buffer, Element, Graph, Invocation, Memory, NodeId, Op, OutputTarget as Picture, Override, Sampler, Scalar,
    SharedArray, Structure, Texture, Type, Uniform, Varying,
};
use straightline_evaluator::passes::layers_read;
use straightline_manifest::{Precision, REGION, Stage, UniformField};

/// A texture that the shader reads.
#[derive(Clone, Debug)]
pub struct BoundTexture {
    /// Index in the graph.
    pub index: u32,
    /// Binding number.
    pub binding: u32,
    /// Number of layers, or samples of a texel, that reads can reach.
    pub layers: u32,
    /// `true` if a sampler filters it.
    pub filtered: bool,
    /// `true` if a sampler compares it.
    pub compared: bool,
}

/// An option that the host sets when it creates the pipeline.
#[derive(Clone, Debug)]
pub struct BoundOverride {
    /// The option, under its name in the text.
    pub of: Override,
    /// Macro by which a host sets it in GLSL for OpenGL, HLSL and functions in GLSL. The same in every language.
    pub define: String,
}

/// Host-facing names of resources that the kernel does not name: the defaults, unless the kernel uses them.
#[derive(Clone, Debug)]
pub struct OwnNames {
    /// The uniform buffer: [`UNIFORMS`].
    pub uniforms: String,
    /// The uniform buffer of a rectangle: [`REGION`].
    pub region: String,
    /// The sampler of GLSL 4.50 that filters nothing: [`SAMPLER`].
    pub sampler: String,
}

/// Bindings of a shader.
#[derive(Clone, Debug)]
pub struct Resources {
    /// Name of the kernel.
    pub(super) kernel: String,
    /// Name of the entry point or function.
    pub entry: String,
    /// Host-facing names of resources that the kernel does not name.
    pub own_names: OwnNames,
    /// Derived names in one language.
    pub(super) derived: BTreeMap<Derived, String>,
    /// Values of each pixel.
    pub outputs: Vec<BoundOutput>,
    /// Binding numbers and registers.
    pub places: Places,
    /// Options of the emission.
    pub options: EmitOptions,
    /// Paths of the source's files as a shader may show them, by the index that places carry.
    pub files: Vec<String>,
    /// Every texture of the kernel, used or not, by index.
    pub(super) textures: Vec<Texture>,
    pub(super) buffers: Vec<Buffer>,
    pub(super) samplers: Vec<Sampler>,
    /// Names of every uniform and varying of the kernel, by index.
    pub(super) uniform_names: Vec<String>,
    pub(super) varying_names: Vec<String>,
    /// Textures in use.
    pub read: Vec<BoundTexture>,
    /// Host functions that read the textures, if the textures are not parameters.
    pub host: Vec<HostFunction>,
    /// Combinations of texture and sampler in use.
    pub combined: Vec<Combined>,
    /// Index and binding number of each buffer in use.
    pub read_buffers: Vec<(u32, u32)>,
    /// Index and binding number of each sampler in use.
    pub used_samplers: Vec<(u32, u32)>,
    /// Uniforms in use.
    pub uniforms: Vec<Uniform>,
    /// Overrides in use, with their indices.
    pub overrides: Vec<(u32, BoundOverride)>,
    /// `true` if overrides are variables with their defaults, for translation to languages that naga writes.
    pub holds_defaults: bool,
    /// Fields of the uniform buffer, and its size.
    pub fields: Vec<UniformField>,
    /// Size of the uniform buffer in bytes.
    pub uniform_size: u32,
    /// Index of the uniform with the frame's size, which follows the kernel's own. `None` if a texture or an output in use has
    /// that size, or the shader does not need it.
    pub size_uniform: Option<u32>,
    /// `true` if the shader needs the frame's size.
    pub needs_frame: bool,
    /// `true` if lanes of quads communicate by quad operations.
    pub subgroups: bool,
    /// `true` if the shader computes in half precision, wholly or partly.
    pub half: bool,
    /// Interpolated values in use, by their locations.
    pub varyings: Vec<Varying>,
    /// Width and height of the block of pixels that one invocation computes.
    pub block: [u32; 2],
    /// Width and height of a workgroup, if the kernel specifies it.
    pub group: Option<[u32; 2]>,
    /// `true` if the shader reads the invocation's position in its workgroup.
    pub asks_local: bool,
    /// `true` if the shader reads its workgroup's position in the dispatch.
    pub asks_group: bool,
    /// Workgroup memory, used or not, by index.
    pub(super) shared: Vec<SharedArray>,
    /// Storage images with writes at arbitrary places, by index: the last of `outputs`.
    pub(super) images: Vec<Picture>,
    /// Index of each workgroup array in use.
    pub used_shared: Vec<u32>,
    /// `true` if runtime values only index tiles of texels, and no read leaves them.
    pub indexes_tiles_alone: bool,
}

impl Resources {
    /// Collects the bindings of a scheduled graph.
    pub fn from_compiled(compiled: &Compiled, options: &EmitOptions) -> Result<Resources, Refusal> {
        let graph = &compiled.graph;
        let live = |id: &NodeId| compiled.schedule.has_node(*id);
        let ops: Vec<&Op> = graph.node_ids().filter(live).map(|id| &graph.node(id).op).collect();
        let kernel = &compiled.kernel;
        if options.region && (compiled.quad.is_some() || compiled.transport.is_some()) {
            let what = format!("`{kernel}` computes quads, which begin at even pixels, and a region may begin at any");
            return Err(Refusal::new(Code::RegionUnfit, what).help("leave `region` out"));
        }
        let group = match graph.invocation {
            Invocation::Group(size) => Some(size),
            _ => None,
        };
        if let (Some(own), Some(asked)) = (group, options.workgroup)
            && own != asked
        {
            let sizes = format!("{}x{}, and {}x{} are asked for", own[0], own[1], asked[0], asked[1]);
            let (what, help) = match compiled.sharing {
                Some(_) => (
                    format!("the pixels of `{kernel}` share texels by workgroups of {sizes}"),
                    format!(
                        "say `workgroup({}x{})` where sharing is asked for, or leave `workgroup` out",
                        asked[0], asked[1]
                    ),
                ),
                None => (
                    format!("`{kernel}` is a kernel of workgroups of {sizes}"),
                    "leave `workgroup` out, or change the kernel".to_owned(),
                ),
            };
            return Err(Refusal::new(Code::WorkgroupSize, what).help(help));
        }
        let narrow = match options.stage {
            _ if options.is_function() => Some((Code::StageUnfit, "a function")),
            Stage::Fragment => Some((Code::StageUnfit, "a fragment shader")),
            Stage::Compute => options.region.then_some((Code::RegionUnfit, "a shader of a region")),
        };
        if let (Some((code, narrow)), Some(image)) = (narrow, graph.images.first()) {
            let image = &image.name;
            let what = format!("`{kernel}` writes to `{image}` at any place, which {narrow} cannot");
            return Err(Refusal::new(code, what)
                .help("emit it as a compute shader of the whole frame")
                .about_input(image));
        }
        let mut read = Vec::new();
        let reads = |index: u32| ops.iter().any(|op| op.texture() == Some(index));
        // A fragment shader takes the output's size from a texture of that size: preferably one in use.
        let framed = |index: &u32| graph.textures[*index as usize].framed;
        let all = || 0..graph.textures.len() as u32;
        let sized_by_output = options.stage == Stage::Compute && graph.written_targets().next().is_some();
        // A shader without outputs still needs the size: pixels outside the frame do nothing.
        let needs_size =
            !sized_by_output && (ops.contains(&&Op::FrameSize) || (options.stage == Stage::Compute && !options.region));
        let sized = match needs_size && !all().any(|index| framed(&index) && reads(index)) {
            true => all().find(framed),
            false => None,
        };
        for index in all().filter(|index| reads(*index) || sized == Some(*index)) {
            let layers = match reads(index) {
                true => layers_read(graph, index),
                false => Some(1),
            };
            let layers = layers.ok_or_else(|| {
                let texture = &graph.textures[index as usize].name;
                let what = format!(
                    "`{kernel}` reads a layer or sample of `{texture}` whose index is a runtime value, so nothing tells how many it needs"
                );
                Refusal::new(Code::UnboundedLayers, what)
                    .help("bound it with `.min(...)`")
                    .about_input(texture)
            })?;
            read.push(BoundTexture {
                index,
                binding: 0,
                layers,
                compared: ops.iter().any(
                    |op| matches!(op, Op::Compare { texture, .. } | Op::GatherCompare { texture, .. } if *texture == index),
                ),
                filtered: ops.iter().any(|op| match op {
                    Op::Sample { texture, sampler, .. } | Op::Gather { texture, sampler, .. } => {
                        *texture == index && graph.samplers[*sampler as usize].filters
                    }
                    _ => false,
                }),
            });
        }
        // Texel loads and sizes can use any combined sampler of the texture, except a comparing one.
        let mut combined = Vec::new();
        for bound in &read {
            let texture = bound.index;
            let of_texture = |op: &&&Op| op.texture() == Some(texture);
            let samplers: BTreeSet<u32> = ops.iter().filter(of_texture).filter_map(|op| op.sampler()).collect();
            let texels = ops.iter().filter(of_texture).any(|op| op.sampler().is_none());
            let plain = texels || samplers.is_empty() || (needs_size && framed(&texture));
            if plain && samplers.iter().all(|s| graph.samplers[*s as usize].comparison) {
                combined.push(Combined { texture, sampler: None });
            }
            combined.extend(samplers.into_iter().map(|sampler| Combined {
                texture,
                sampler: Some(sampler),
            }));
        }
        let bound = |len: usize, used: &dyn Fn(u32) -> bool| -> Vec<(u32, u32)> {
            (0..len as u32).filter(|k| used(*k)).map(|k| (k, 0)).collect()
        };
        let mut read_buffers = bound(graph.buffers.len(), &|k| ops.iter().any(|op| op.buffer() == Some(k)));
        let mut used_samplers = bound(graph.samplers.len(), &|k| ops.iter().any(|op| op.sampler() == Some(k)));
        let used = |k: u32| ops.iter().any(|op| **op == Op::Uniform(k));
        let mut uniforms: Vec<&Uniform> = graph
            .uniforms
            .iter()
            .enumerate()
            .filter(|(k, _)| used(*k as u32))
            .map(|(_, u)| u)
            .collect();
        let compute = options.stage == Stage::Compute;
        let needs_frame = compute || options.counts_from_below() || ops.contains(&&Op::FrameSize);
        let has_size = sized_by_output || read.iter().any(|bound| framed(&bound.index));
        let skips_size = compute && options.region && !ops.contains(&&Op::FrameSize);
        let size_field = match needs_frame && !has_size && !skips_size {
            true => Some(size_field(compiled)?),
            false => None,
        };
        uniforms.extend(&size_field);
        let mut overrides: Vec<(u32, BoundOverride)> = Vec::new();
        for (k, of) in (0..).zip(&graph.overrides) {
            if !ops.contains(&&Op::Override(k)) {
                continue;
            }
            let taken = |name: &str| {
                let is_macro = overrides.iter().any(|(_, other)| other.define == name);
                is_macro || input_names(graph).any(|other| other == name)
            };
            let define = free_name(kernel, &format!("{DEFINE}{}", of.name.to_uppercase()), taken)?;
            overrides.push((k, BoundOverride { of: of.clone(), define }));
        }
        let uses = |k: u32| ops.iter().any(|op| op.memory() == Some(Memory::Shared(k)));
        let used_shared: Vec<u32> = (0..graph.shared.len() as u32).filter(|k| uses(*k)).collect();
        let entry = super::entry::resolve_entry_name(&compiled.kernel, options)?;
        let mut outputs: Vec<BoundOutput> = graph
            .written_targets()
            .map(|t| BoundOutput::new(t, options.format))
            .collect();
        let subgroups = ops.iter().any(|op| matches!(op, Op::QuadSwap(_)));
        let half = options.precision == Precision::F16 || ops.contains(&&Op::Half);
        let used = |k: usize| ops.iter().any(|op| **op == Op::Varying(k as u32));
        let varyings = graph.varyings.iter().enumerate().filter(|(k, _)| used(*k));
        let varyings: Vec<Varying> = varyings.map(|(_, v)| v.clone()).collect();
        let (mut fields, uniform_size) = layout_uniforms(&uniforms);
        if let (Some(_), Some(field)) = (&size_field, fields.last_mut()) {
            field.frame_size = true;
        }
        let named = |class: char, name: &str| Named {
            name: name.to_owned(),
            class,
            immediate: false,
        };
        let all_bound = read.iter().map(|t| named('t', &graph.textures[t.index as usize].name));
        let all_bound = all_bound.chain(read_buffers.iter().map(|(k, _)| {
            named(
                register_class(&graph.buffers[*k as usize]),
                &graph.buffers[*k as usize].name,
            )
        }));
        let all_bound = all_bound.chain(
            used_samplers
                .iter()
                .map(|(k, _)| named('s', &graph.samplers[*k as usize].name)),
        );
        let mut all_bound: Vec<Named> = all_bound.collect();
        // An output may have the name of an input.
        let is_input = |name: &String| all_bound.iter().any(|bound| bound.name == *name);
        let given: Vec<String> = outputs
            .iter()
            .map(|output| match is_input(&output.name) {
                true => format!("{OF_OUTPUT}{}", output.name),
                false => output.name.clone(),
            })
            .collect();
        let own = |name: &str| {
            free_name(&compiled.kernel, name, |name| {
                all_bound.iter().any(|bound| bound.name == name) || given.iter().any(|output| output == name)
            })
        };
        let own_names = OwnNames {
            uniforms: own(UNIFORMS)?,
            region: own(REGION)?,
            sampler: own(SAMPLER)?,
        };
        if compute {
            all_bound.extend(given.iter().map(|name| named('u', name)));
        }
        let immediate = options.parameters == Parameters::Immediate && !fields.is_empty();
        if immediate {
            check_immediates(kernel, options, &own_names.uniforms, uniform_size)?;
        }
        let own = [
            (!fields.is_empty(), 'b', &own_names.uniforms),
            (options.region, 'b', &own_names.region),
            (
                !read.is_empty() && options.targets.contains(&Target::Glsl450),
                's',
                &own_names.sampler,
            ),
        ];
        let own = own.into_iter().filter(|(is_bound, ..)| *is_bound);
        all_bound.extend(own.map(|(_, class, name)| Named {
            immediate: immediate && *name == own_names.uniforms,
            ..named(class, name)
        }));
        let places = Places::new(&compiled.kernel, options, &all_bound, &given, &own_names.sampler)?;
        for (output, name) in outputs.iter_mut().zip(&given).filter(|_| compute) {
            output.binding = Some(places.binding_number(name));
        }
        for bound in &mut read {
            bound.binding = places.binding_number(&graph.textures[bound.index as usize].name);
        }
        for (k, binding) in &mut read_buffers {
            *binding = places.binding_number(&graph.buffers[*k as usize].name);
        }
        for (k, binding) in &mut used_samplers {
            *binding = places.binding_number(&graph.samplers[*k as usize].name);
        }
        let framed = read
            .iter()
            .map(|t| t.index)
            .find(|t| graph.textures[*t as usize].framed);
        let host = match options.calls_host() {
            true => derived::host_functions(&ops, framed.filter(|_| needs_frame)),
            false => Vec::new(),
        };
        let resources = Resources {
            kernel: kernel.clone(),
            entry,
            own_names,
            derived: BTreeMap::new(),
            outputs,
            places,
            options: options.clone(),
            files: graph.files.iter().map(|path| shown_path(path).to_owned()).collect(),
            textures: graph.textures.clone(),
            buffers: graph.buffers.clone(),
            samplers: graph.samplers.clone(),
            uniform_names: graph
                .uniforms
                .iter()
                .chain(&size_field)
                .map(|u| u.name.clone())
                .collect(),
            size_uniform: size_field.as_ref().map(|_| graph.uniforms.len() as u32),
            varying_names: graph.varyings.iter().map(|v| v.name.clone()).collect(),
            uniforms: uniforms.into_iter().cloned().collect(),
            overrides,
            holds_defaults: false,
            read,
            host,
            combined,
            read_buffers,
            used_samplers,
            fields,
            uniform_size,
            needs_frame,
            subgroups,
            half,
            varyings,
            block: graph.invocation.block_size(),
            group,
            asks_local: ops.contains(&&Op::Thread),
            asks_group: ops.contains(&&Op::GroupOrigin),
            shared: graph.shared.clone(),
            images: graph.images.clone(),
            indexes_tiles_alone: compiled.sharing.is_some()
                && !ops.iter().any(|op| matches!(op, Op::ArrayGet | Op::ArraySet)),
            used_shared,
        };
        if options.stage == Stage::Fragment && resources.outputs.is_empty() {
            let what = format!("`{kernel}` gives nothing for a pixel, and a fragment shader gives a colour");
            return Err(Refusal::new(Code::StageUnfit, what).help("emit it for compute"));
        }
        Ok(resources)
    }

    /// Returns a texture by its index in the graph.
    pub fn texture(&self, index: u32) -> &Texture {
        &self.textures[index as usize]
    }

    /// Returns a buffer by its index in the graph.
    pub fn buffer(&self, index: u32) -> &Buffer {
        &self.buffers[index as usize]
    }

    /// Returns the structures of buffers in use, each once.
    pub fn read_structures(&self) -> Vec<&Structure> {
        let mut all: Vec<&Structure> = Vec::new();
        for (k, _) in &self.read_buffers {
            if let Element::Struct(structure) = &self.buffer(*k).element
                && all.iter().all(|other| other.name != structure.name)
            {
                all.push(structure);
            }
        }
        all
    }

    /// Returns the HLSL register class of a buffer, by its index in the graph.
    pub fn buffer_class(&self, index: u32) -> char {
        register_class(self.buffer(index))
    }

    /// Returns whether a buffer is written, by its index in the graph.
    pub fn is_written(&self, index: u32) -> bool {
        self.buffer(index).access != Access::Read
    }

    /// Returns the element type of a memory, and its name.
    pub fn element_and_name(&self, memory: Memory) -> (Type, &str) {
        match memory {
            Memory::Buffer(k) => (self.buffer(k).value_type(), &self.buffer(k).name),
            Memory::Shared(k) => (self.shared[k as usize].element, &self.shared[k as usize].name),
            Memory::Image(k) => (self.images[k as usize].ty, &self.images[k as usize].name),
        }
    }

    /// Returns the workgroup memory in use.
    pub fn shared_memory(&self) -> impl Iterator<Item = &SharedArray> {
        self.used_shared.iter().map(|k| &self.shared[*k as usize])
    }

    /// Returns whether some workgroup memory must be 0 initially, because it may be read before it is written.
    pub fn is_zeroed(&self) -> bool {
        self.shared_memory().any(|shared| !shared.filled)
    }

    /// Returns the invocations of a compute workgroup.
    pub fn workgroup_size(&self) -> [u32; 3] {
        match self.group {
            Some([x, y]) => [x, y, 1],
            None => self.options.workgroup_size(),
        }
    }

    /// Returns a sampler by its index in the graph.
    pub fn sampler(&self, index: u32) -> &Sampler {
        &self.samplers[index as usize]
    }

    /// Returns the name of a uniform by its index in the graph.
    pub fn uniform_name(&self, index: u32) -> &str {
        &self.uniform_names[index as usize]
    }

    /// Returns an override in use by its index in the graph.
    pub fn bound_override(&self, index: u32) -> &BoundOverride {
        let found = self.overrides.iter().find(|(k, _)| *k == index);
        &found.expect("an override of the schedule").1
    }

    /// Returns the name of a varying by its index in the graph.
    pub fn varying_name(&self, index: u32) -> &str {
        &self.varying_names[index as usize]
    }

    /// Returns a texture in use that has the output's size.
    pub fn frame_texture(&self) -> Option<u32> {
        self.read.iter().map(|t| t.index).find(|t| self.texture(*t).framed)
    }

    /// Returns the names of all bindings except the uniforms.
    pub fn bound_names(&self) -> impl Iterator<Item = &str> {
        let textures = self.read.iter().map(|t| self.texture(t.index).name.as_str());
        let buffers = self.read_buffers.iter().map(|(k, _)| self.buffer(*k).name.as_str());
        let samplers = self.used_samplers.iter().map(|(k, _)| self.sampler(*k).name.as_str());
        let varyings = self.varyings.iter().map(|v| v.name.as_str());
        let outputs = self.outputs.iter().map(|o| o.name.as_str());
        let shared = self.used_shared.iter().map(|k| self.shared[*k as usize].name.as_str());
        textures
            .chain(buffers)
            .chain(shared)
            .chain(samplers)
            .chain(varyings)
            .chain(outputs)
    }

    /// Returns the name of the output whose size is the frame's.
    pub fn sized_output(&self) -> &str {
        self.outputs.first().map_or(OUTPUT, |output| output.name.as_str())
    }

    /// Returns the type that holds all outputs, if there are several and the language returns them as one.
    pub fn outputs_type(&self) -> String {
        match self.options.is_function() {
            true => format!("{}_{OUTPUTS}", self.entry),
            false => OUTPUTS.to_owned(),
        }
    }

    /// Returns the interpolated values in use, as the manifest describes them.
    pub fn manifest_varyings(&self) -> impl Iterator<Item = straightline_manifest::Varying> {
        self.varyings
            .iter()
            .zip(0..)
            .map(|(v, location)| straightline_manifest::Varying {
                name: v.name.clone(),
                ty: value_type(v.ty),
                location,
            })
    }

    /// Returns the binding number of the uniform buffer, if there is one; of immediates the number in HLSL and MSL.
    pub fn uniform_binding(&self) -> Option<u32> {
        (!self.fields.is_empty()).then(|| self.places.binding_number(&self.own_names.uniforms))
    }

    /// Returns whether the uniforms are immediates.
    pub fn has_immediates(&self) -> bool {
        self.options.parameters == Parameters::Immediate && !self.fields.is_empty()
    }

    /// Returns the binding number of the region's uniform buffer, if there is one.
    pub fn region_binding(&self) -> Option<u32> {
        self.options
            .region
            .then(|| self.places.binding_number(&self.own_names.region))
    }

    /// Returns the binding number of the sampler that only GLSL 4.50 has.
    pub fn sampler_binding(&self) -> u32 {
        self.places.binding_number(&self.own_names.sampler)
    }

    /// Returns the comment that explains the fields of a region.
    pub fn region_comment(&self) -> String {
        let corner = match self.options.counts_from_below() {
            true => "lower left",
            false => "upper left",
        };
        format!("// The {corner} pixel in the inputs, the size, and the {corner} pixel in the target.")
    }

    /// Returns every binding number except that of the sampler that only GLSL 4.50 has.
    pub fn binding_numbers(&self) -> Vec<u32> {
        let read = self.read.iter().map(|bound| bound.binding);
        let others = self
            .read_buffers
            .iter()
            .chain(&self.used_samplers)
            .map(|(_, binding)| *binding);
        let own = [self.uniform_binding(), self.region_binding()];
        let outputs = self.outputs.iter().filter_map(|output| output.binding);
        read.chain(others)
            .chain(outputs)
            .chain(own.into_iter().flatten())
            .collect()
    }

    /// Returns the index of the buffer with which MSL receives the lengths of other buffers: the lowest free number.
    pub fn sizes_binding(&self) -> u32 {
        let taken = self.binding_numbers();
        (0..).find(|n| !taken.contains(n)).unwrap_or_default()
    }

    /// Returns the name of a combined sampler: the texture's name, unless several samplers read it.
    pub fn combined_name(&self, one: Combined) -> &str {
        match self.derived.get(&Derived::Combined(one)) {
            Some(name) => name,
            None => &self.texture(one.texture).name,
        }
    }

    /// Returns the binding number of a texture in use.
    pub fn texture_binding(&self, texture: u32) -> Option<u32> {
        self.read
            .iter()
            .find(|bound| bound.index == texture)
            .map(|bound| bound.binding)
    }
}

/// Checks that uniforms of `size` bytes, called `name`, can be immediates.
fn check_immediates(kernel: &str, options: &EmitOptions, name: &str, size: u32) -> Result<(), Refusal> {
    let most = Parameters::MOST_IMMEDIATE_BYTES;
    if size > most {
        let what = format!("its uniforms take {size} bytes, and immediates {most} at most");
        return Err(Refusal::invalid_binding(
            kernel,
            &what,
            "leave `parameters` at `uniform`, or make uniforms options with constants",
        ));
    }
    match options.bindings.iter().find(|(bound, _)| bound == name) {
        Some((_, number)) => {
            let what = format!("the binding number {number} is given to `{name}`, and immediates have none");
            Err(Refusal::invalid_binding(
                kernel,
                &what,
                "leave the number out, or leave `parameters` at `uniform`",
            ))
        }
        None => Ok(()),
    }
}

/// Returns the uniform that holds the frame's size, under a name that no input or output of the kernel has.
fn size_field(compiled: &Compiled) -> Result<Uniform, Refusal> {
    let is_used = |name: &str| input_names(&compiled.graph).any(|other| other == name);
    Ok(Uniform {
        name: free_name(&compiled.kernel, RESOLUTION, is_used)?,
        ty: Type::value(Scalar::U32, 2),
        default: None,
        part: None,
    })
}

/// Returns the names of all inputs and outputs of a kernel.
fn input_names(graph: &Graph) -> impl Iterator<Item = &String> {
    let wholes = graph
        .uniforms
        .iter()
        .filter_map(|uniform| Some(&uniform.part.as_ref()?.of));
    let textures = graph.textures.iter().map(|texture| &texture.name);
    textures
        .chain(graph.buffers.iter().map(|buffer| &buffer.name))
        .chain(graph.samplers.iter().map(|sampler| &sampler.name))
        .chain(graph.uniforms.iter().map(|uniform| &uniform.name))
        .chain(wholes)
        .chain(graph.overrides.iter().map(|of| &of.name))
        .chain(graph.varyings.iter().map(|varying| &varying.name))
        .chain(graph.written_targets().map(|target| &target.name))
}

/// Returns the HLSL register class of a buffer.
fn register_class(buffer: &Buffer) -> char {
    match buffer.access {
        Access::Read => 't',
        Access::Write | Access::Atomic => 'u',
    }
}

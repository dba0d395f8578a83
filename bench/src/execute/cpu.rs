//! The interpreter, on all processors.

use super::{Address, Comparison, ExecuteError, Inputs, SamplerState, Written, find_entry};
use glam::{UVec2, Vec4};
use rayon::prelude::*;
use std::sync::OnceLock;
use straightline_codegen::Compiled;
use straightline_codegen::Unroll;
use straightline_codegen::interp::{self, Bindings, Image, Interpreter, MOST_ITERATIONS, Scratch};
use straightline_codegen::ir::{Access, Op, Real, Scalar};
use straightline_kernels::prelude::Frame;
use straightline_manifest::plan::workgroups_of_tiles;

/// Result of the interpreter.
#[derive(Clone, Debug)]
pub struct Interpreted<R> {
    /// Texels of the first target, row by row from the top: a colour, or a value of fewer components, the others 0 and the
    /// fourth 1.
    pub texels: Vec<[R; 4]>,
    /// Every target.
    pub targets: Vec<Written>,
    /// Every buffer that the kernel writes, by name, as it is afterwards.
    pub buffers: Vec<(String, Vec<[f64; 4]>)>,
    /// For the first pixel that had a NaN or an infinity: its coordinate and where that came from.
    pub not_finite: Option<([u32; 2], String)>,
    /// Pixels that had one.
    pub not_finite_pixels: usize,
    /// Coordinate and origin, as in `not_finite`, of every pixel that had one, in order.
    pub non_finite_origins: Vec<([u32; 2], String)>,
}

impl<R: Real> Interpreted<R> {
    /// The image in `f32`.
    pub fn frame(&self, inputs: &Inputs) -> Frame<Vec4> {
        let texel = |t: &[R; 4]| Vec4::from_array(t.map(|v| v.to_f64() as f32));
        Frame::new(inputs.size, self.texels.iter().map(texel).collect())
    }
}

/// Rows of an image that were computed together.
#[derive(Default)]
struct Row<R> {
    /// Of the first target.
    texels: Vec<[R; 4]>,
    /// Of every target.
    targets: Vec<Vec<[f64; 4]>>,
    /// Of each pixel that had a NaN or an infinity where that came from.
    non_finite_origins: Vec<([u32; 2], String)>,
}

/// Puts the texels of an invocation, row by row, behind those to their left; none beyond `width`.
fn append_texels<T: Copy>(lines: &mut [Vec<T>], texels: &[T], across: usize, width: u32) {
    for (line, texels) in lines.iter_mut().zip(texels.chunks(across)) {
        let room = width as usize - line.len();
        line.extend(texels.iter().take(room));
    }
}

/// Computes every pixel of a kernel in the precision `R`; with `watch`, notes where NaNs and infinities come from.
///
/// # Errors
///
/// If something that the kernel reads is missing or does not fit.
pub fn interpret_kernel<R: Real>(
    compiled: &Compiled,
    inputs: &Inputs,
    watch: bool,
) -> Result<Interpreted<R>, ExecuteError> {
    let compiled = &*compiled.in_blocks();
    let mut images = Vec::new();
    for (name, layers) in &inputs.images {
        let mut image = create_level(name, layers)?;
        for smaller in find_entry(&inputs.smaller, name).into_iter().flatten() {
            image = image.with_smaller(create_level(name, smaller)?);
        }
        images.push((name, image));
    }
    for (name, layers) in &inputs.integers {
        let scalar = compiled
            .graph
            .textures
            .iter()
            .find(|t| t.name == *name)
            .map(|t| t.scalar);
        let (size, bits) = collect_texels(layers, |texel| texel.to_array());
        // Bits of a texture that the kernel reads as floats are refused as such.
        let scalar = scalar.filter(|s| *s != Scalar::F32).unwrap_or(Scalar::U32);
        let image = Image::of_integers(scalar, size, bits).ok_or_else(|| of_sizes(name))?;
        images.push((name, image));
    }
    let mut bindings = Bindings::new();
    for (name, image) in &images {
        bindings = bindings.texture(name, image);
    }
    for (name, state) in &inputs.samplers {
        bindings = bindings.sampler(name, sampler_state(*state));
    }
    for (name, elements) in &inputs.buffers {
        bindings = bindings.buffer(name, elements);
    }
    for (name, lanes) in &inputs.uniforms {
        bindings = bindings.uniform(name, lanes);
    }
    if let Some(name) = find_unset_uniform(compiled, inputs) {
        return Err(ExecuteError::Input(format!(
            "the uniform `{name}` of `{}` has no default: give it a value",
            compiled.kernel
        )));
    }
    let image_sizes = image_sizes(compiled, inputs)?;
    let [width, height] = frame_of(compiled, &image_sizes).unwrap_or(inputs.size.to_array());
    let frame = [width, height];
    let interpreter = Interpreter::<R>::in_precision(&compiled.graph, &compiled.schedule, frame, &bindings)
        .map_err(|e| ExecuteError::Input(e.to_string()))?
        .with_image_sizes(image_sizes.clone());
    let interpreter = if watch {
        interpreter.track_non_finite()
    } else {
        interpreter
    };
    let [across, down] = compiled.graph.invocation.tile_size();
    let names = &compiled.graph.targets;
    let endless = OnceLock::new();
    let row = |scratch: &mut Scratch, row: u32| {
        let (y, mut non_finite_origins) = (row * down, Vec::new());
        let mut lines = vec![Vec::with_capacity(width as usize); down as usize];
        let mut targets = vec![vec![Vec::with_capacity(width as usize); down as usize]; names.len()];
        for x in (0..width).step_by(across as usize) {
            if endless.get().is_some() {
                break;
            }
            let texels = interpreter.run_invocation(x, y, scratch);
            if scratch.is_endless() {
                endless.get_or_init(|| [x, y]);
                break;
            }
            non_finite_origins.extend(
                scratch
                    .non_finite_origin()
                    .map(|b| ([x, y], b.describe(&compiled.graph))),
            );
            append_texels(&mut lines, &texels, across as usize, width);
            for (k, lines) in targets.iter_mut().enumerate() {
                append_texels(lines, &interpreter.target_values(k, scratch), across as usize, width);
            }
        }
        let inside = (height - y) as usize;
        lines.truncate(inside);
        let targets = targets.into_iter().map(|mut lines| {
            lines.truncate(inside);
            lines.concat()
        });
        Row {
            texels: lines.concat(),
            targets: targets.collect(),
            non_finite_origins,
        }
    };
    let numbers = 0..height.div_ceil(down);
    let mut last = interpreter.new_scratch();
    // Rows run one after the other if pixels write buffers, so that the writes keep their order.
    let rows: Vec<Row<R>> = match compiled.graph.has_effects() {
        true => numbers.map(|number| row(&mut last, number)).collect(),
        false => numbers
            .into_par_iter()
            .map_init(|| interpreter.new_scratch(), row)
            .collect(),
    };
    if let Some([x, y]) = endless.get() {
        let loops = compiled.loops.iter().filter(|report| report.unroll != Unroll::Full);
        let named: Vec<String> = loops.map(|report| format!("`{}`", report.policy_path())).collect();
        return Err(ExecuteError::Input(format!(
            "`{}` does not end at the pixel ({x}, {y}): its loops {} have more than {MOST_ITERATIONS} iterations there; bound them: \
             `#[cfg_attr(false, bound(64))]`",
            compiled.kernel,
            named.join(", ")
        )));
    }
    if let Some(disorder) = last.disorder() {
        return Err(ExecuteError::Input(format!("`{}`: {disorder}", compiled.kernel)));
    }
    let written = compiled.graph.buffers.iter().enumerate();
    let written = written.filter(|(_, buffer)| buffer.access != Access::Read);
    let buffers = written.map(|(k, buffer)| (buffer.name.clone(), interpreter.buffer_contents(k, &last)));
    let buffers = buffers.collect();
    let given = (0..names.len()).map(|k| rows.iter().flat_map(|row| &row.targets[k]).copied().collect());
    let images = (0..compiled.graph.images.len()).map(|k| interpreter.image_contents(k, &last));
    let pictures = compiled.graph.written_targets().zip(given.chain(images));
    let sizes = names
        .iter()
        .map(|_| inputs.size)
        .chain(image_sizes.iter().map(|size| UVec2::from_array(*size)));
    let targets = pictures.zip(sizes).map(|((picture, texels), size)| Written {
        name: picture.name.clone(),
        size,
        texels,
    });
    let targets = targets.collect();
    let non_finite_origins: Vec<_> = rows.iter().flat_map(|row| row.non_finite_origins.clone()).collect();
    Ok(Interpreted {
        texels: rows.into_iter().flat_map(|row| row.texels).collect(),
        targets,
        buffers,
        not_finite_pixels: non_finite_origins.len(),
        not_finite: non_finite_origins.first().cloned(),
        non_finite_origins,
    })
}

/// Sizes of the images that a kernel writes at any place: those of the frame, or their own.
fn image_sizes(compiled: &Compiled, inputs: &Inputs) -> Result<Vec<[u32; 2]>, ExecuteError> {
    let each = compiled.graph.images.iter().map(|image| match image.tile {
        None => Ok(inputs.size.to_array()),
        Some(_) => {
            let size = find_entry(&inputs.target_sizes, &image.name);
            let size = size.ok_or_else(|| ExecuteError::Input(format!("the picture `{}` has no size", image.name)));
            size.map(|size| size.to_array())
        }
    });
    each.collect()
}

/// Width and height in threads of a kernel whose images have tiles. `None` of one with a frame.
fn frame_of(compiled: &Compiled, image_sizes: &[[u32; 2]]) -> Option<[u32; 2]> {
    let threads = compiled.graph.invocation.tile_size();
    let tiles = compiled.graph.images.iter().map(|image| image.tile);
    let groups = workgroups_of_tiles(tiles.zip(image_sizes.iter().copied()))?;
    Some([0, 1].map(|axis| groups[axis] * threads[axis]))
}

/// A sampler's state as the interpreter takes it.
pub fn sampler_state(state: SamplerState) -> interp::SamplerState {
    interp::SamplerState {
        linear: state.linear,
        address: match state.address {
            Address::Clamp => interp::Address::Clamp,
            Address::Repeat => interp::Address::Repeat,
            Address::Mirror => interp::Address::Mirror,
        },
        linear_mip: state.linear_mip,
        comparison: match state.comparison {
            Comparison::Less => interp::Comparison::Less,
            Comparison::LessEqual => interp::Comparison::LessEqual,
            Comparison::Greater => interp::Comparison::Greater,
            Comparison::GreaterEqual => interp::Comparison::GreaterEqual,
        },
    }
}

/// A level of an image.
fn create_level(name: &str, layers: &[Frame<Vec4>]) -> Result<Image, ExecuteError> {
    let (size, texels) = collect_texels(layers, |texel| texel.to_array());
    Image::new(size, texels).ok_or_else(|| of_sizes(name))
}

fn of_sizes(name: &str) -> ExecuteError {
    ExecuteError::Input(format!("the layers of `{name}` have different sizes"))
}

/// The size of the first layer, and all texels as `of` has them.
fn collect_texels<T: Copy, U>(layers: &[Frame<T>], of: impl Fn(&T) -> [U; 4]) -> ([u32; 2], Vec<Vec<[U; 4]>>) {
    let size = layers.first().map_or([0, 0], |l| l.size().to_array());
    let texels = layers.iter().map(|l| l.texels().iter().map(&of).collect());
    (size, texels.collect())
}

/// The first uniform that is read, has no default and was not given; `None` if there is none. No executor runs without it.
pub fn find_unset_uniform<'a>(compiled: &'a Compiled, inputs: &Inputs) -> Option<&'a str> {
    let graph = &compiled.graph;
    let scheduled = graph.node_ids().filter(|id| compiled.schedule.has_node(*id));
    let mut read = scheduled.filter_map(|id| match graph.node(id).op {
        Op::Uniform(index) => Some(&graph.uniforms[index as usize]),
        _ => None,
    });
    let unset = read.find(|uniform| uniform.default.is_none() && find_entry(&inputs.uniforms, &uniform.name).is_none());
    unset.map(|uniform| uniform.name.as_str())
}

//! Running a graph on the CPU.

use super::{Graph, Lanes, NodeId, Op, Type, arith};
use crate::passes::{Block, Schedule, Step};
use std::fmt;

/// An image that a graph can read.
pub trait Texels: Sync {
    /// Width and height in texels, and number of layers.
    fn extent(&self) -> [u32; 3];
    /// The texel at a coordinate inside the extent; components that the image lacks are 0.
    fn texel(&self, x: u32, y: u32, layer: u32) -> [f32; 4];
}

/// An image in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    size: [u32; 2],
    layers: Vec<Vec<[f32; 4]>>,
}

impl Image {
    /// An image of `size` texels from layers of rows; `None` unless there is a layer and each has all its texels.
    pub fn new(size: [u32; 2], layers: Vec<Vec<[f32; 4]>>) -> Option<Image> {
        let texels = size[0] as usize * size[1] as usize;
        let whole = texels > 0 && !layers.is_empty() && layers.iter().all(|layer| layer.len() == texels);
        whole.then_some(Image { size, layers })
    }
}

impl Texels for Image {
    fn extent(&self) -> [u32; 3] {
        [self.size[0], self.size[1], self.layers.len() as u32]
    }

    fn texel(&self, x: u32, y: u32, layer: u32) -> [f32; 4] {
        let layer = (layer as usize).min(self.layers.len() - 1);
        self.layers[layer][(y * self.size[0] + x) as usize]
    }
}

/// Why a graph cannot be run on the given inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum InputError {
    /// No image was given for a texture that is read.
    Missing(String),
    /// The image has fewer layers than the graph reads.
    Layers {
        /// The texture.
        name: String,
        /// Layers that it has.
        found: u32,
        /// Layers that are read.
        needed: u32,
    },
    /// The image has another size than the frame.
    Size {
        /// The texture.
        name: String,
        /// Width and height that it has.
        found: [u32; 2],
        /// Width and height of the frame.
        frame: [u32; 2],
    },
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InputError::Missing(name) => write!(f, "no image for the texture `{name}`"),
            InputError::Layers { name, found, needed } => {
                write!(
                    f,
                    "`{name}` has {found} layers but {needed} are read: one for each geometry sample"
                )
            }
            InputError::Size { name, found, frame } => write!(
                f,
                "`{name}` is {}x{} but the output is {}x{}: inputs have the output's size",
                found[0], found[1], frame[0], frame[1]
            ),
        }
    }
}

impl std::error::Error for InputError {}

/// A graph with its inputs, ready to compute any pixel.
pub struct Interpreter<'a> {
    graph: &'a Graph,
    schedule: &'a Schedule,
    frame: [u32; 2],
    textures: Vec<Option<&'a dyn Texels>>,
    uniforms: Vec<Lanes>,
}

/// Room for the values of one pixel at a time: make one a thread and use it again.
pub struct Scratch {
    values: Vec<Lanes>,
    arrays: Vec<Vec<Lanes>>,
}

impl<'a> Interpreter<'a> {
    /// Binds `textures` by name, and uniforms by name to a number for every lane (others keep their default, or 0).
    pub fn new(
        graph: &'a Graph,
        schedule: &'a Schedule,
        frame: [u32; 2],
        textures: &[(&str, &'a dyn Texels)],
        uniforms: &[(&str, f64)],
    ) -> Result<Self, InputError> {
        let mut bound = Vec::new();
        for (index, texture) in graph.textures.iter().enumerate() {
            let read = graph.ids().any(|id| {
                schedule.place[id.0 as usize].is_some()
                    && matches!(graph.node(id).op, Op::Load { texture, .. } if texture as usize == index)
            });
            let given = textures
                .iter()
                .find(|(name, _)| *name == texture.name)
                .map(|(_, image)| *image);
            if read {
                let image = given.ok_or_else(|| InputError::Missing(texture.name.clone()))?;
                let [width, height, found] = image.extent();
                let needed = crate::passes::layers_read(graph, index as u32);
                if found < needed {
                    return Err(InputError::Layers {
                        name: texture.name.clone(),
                        found,
                        needed,
                    });
                }
                if [width, height] != frame {
                    return Err(InputError::Size {
                        name: texture.name.clone(),
                        found: [width, height],
                        frame,
                    });
                }
            }
            bound.push(given);
        }
        let uniforms = graph.uniforms.iter().map(|uniform| {
            let given = uniforms
                .iter()
                .find(|(name, _)| *name == uniform.name)
                .map(|(_, value)| *value);
            uniform_bits(uniform.ty, given.or(uniform.default).unwrap_or(0.0))
        });
        Ok(Interpreter {
            graph,
            schedule,
            frame,
            textures: bound,
            uniforms: uniforms.collect(),
        })
    }

    /// Room for this graph's values.
    pub fn scratch(&self) -> Scratch {
        let mut values = vec![[0; 4]; self.graph.nodes.len()];
        for id in self.graph.ids() {
            if let Some(bits) = self.graph.constant(id) {
                values[id.0 as usize] = bits;
            }
        }
        Scratch {
            values,
            arrays: vec![Vec::new(); self.graph.nodes.len()],
        }
    }

    /// The colour of a pixel inside the frame.
    pub fn pixel(&self, x: u32, y: u32, scratch: &mut Scratch) -> [f32; 4] {
        self.block(&self.schedule.body, [x, y], scratch);
        scratch.values[self.graph.output().0 as usize].map(f32::from_bits)
    }

    fn block(&self, block: &Block, pixel: [u32; 2], s: &mut Scratch) {
        for step in &block.steps {
            match step {
                Step::Eval(id) => self.eval(*id, pixel, s),
                Step::Loop { node, body } => self.run_loop(*node, body, pixel, s),
                Step::If { node, then, otherwise } => {
                    let regions = self.graph.regions_of(*node);
                    let holds = s.values[self.graph.node(*node).args[0].0 as usize][0] != 0;
                    let (side, region) = if holds {
                        (then, regions[0])
                    } else {
                        (otherwise, regions[1])
                    };
                    self.block(side, pixel, s);
                    let results = &self.graph.region(region).results;
                    let slot = node.0 as usize;
                    s.arrays[slot] = results.iter().flat_map(|r| whole(self.graph, s, *r)).collect();
                }
            }
        }
    }

    fn run_loop(&self, node: NodeId, body: &Block, pixel: [u32; 2], s: &mut Scratch) {
        let args = &self.graph.node(node).args;
        let region = self.graph.region(self.graph.regions_of(node)[0]);
        let (start, end) = (
            s.values[args[0].0 as usize][0] as i32,
            s.values[args[1].0 as usize][0] as i32,
        );
        let mut carried: Vec<Vec<Lanes>> = args[2..].iter().map(|a| whole(self.graph, s, *a)).collect();
        for counter in start..end {
            s.values[region.params[0].0 as usize] = [counter as u32, 0, 0, 0];
            for (param, value) in region.params[1..].iter().zip(carried) {
                store(self.graph, s, *param, value);
            }
            self.block(body, pixel, s);
            carried = region.results.iter().map(|r| whole(self.graph, s, *r)).collect();
        }
        s.arrays[node.0 as usize] = carried.concat();
    }

    fn eval(&self, id: NodeId, pixel: [u32; 2], s: &mut Scratch) {
        let node = self.graph.node(id);
        let slot = id.0 as usize;
        match &node.op {
            Op::Const(_) => {}
            Op::Pixel => s.values[slot] = [pixel[0], pixel[1], 0, 0],
            Op::FrameSize => s.values[slot] = [self.frame[0], self.frame[1], 0, 0],
            Op::Uniform(k) => s.values[slot] = self.uniforms[*k as usize],
            Op::Load { texture, .. } => {
                let coord = s.values[node.args[0].0 as usize];
                let layer = node.args.get(1).map_or(0, |layer| s.values[layer.0 as usize][0]);
                // A texture that is read has been bound by `new`.
                let texel = self.textures[*texture as usize].map_or([0.0; 4], |t| t.texel(coord[0], coord[1], layer));
                s.values[slot] = texel.map(f32::to_bits);
            }
            Op::MakeArray => {
                let values = &s.values;
                s.arrays[slot] = node.args.iter().map(|a| values[a.0 as usize]).collect();
            }
            Op::ArrayGet => {
                let array = &s.arrays[node.args[0].0 as usize];
                let index = s.values[node.args[1].0 as usize][0] as usize;
                s.values[slot] = array[index.min(array.len() - 1)];
            }
            Op::ArraySet => {
                let mut array = s.arrays[node.args[0].0 as usize].clone();
                let index = s.values[node.args[1].0 as usize][0] as usize;
                if let Some(element) = array.get_mut(index) {
                    *element = s.values[node.args[2].0 as usize];
                }
                s.arrays[slot] = array;
            }
            Op::Result(k) => {
                let value = self.result(node.args[0], *k as usize, s);
                store(self.graph, s, id, value);
            }
            op => {
                let operand = node.args.last().map_or(node.ty, |a| match op {
                    Op::Select => self.graph.ty(*a),
                    _ => self.graph.ty(node.args[0]),
                });
                let mut args = [[0; 4]; 4];
                for (slot, arg) in args.iter_mut().zip(&node.args) {
                    *slot = s.values[arg.0 as usize];
                }
                s.values[slot] = arith::apply(op, operand, &args, node.ty).expect("a verified graph");
            }
        }
    }

    /// Result `k` of a loop or branch, cut from the values that all its results were left in.
    fn result(&self, owner: NodeId, k: usize, s: &Scratch) -> Vec<Lanes> {
        let region = self.graph.region(self.graph.regions_of(owner)[0]);
        let sizes: Vec<usize> = region.results.iter().map(|r| size(self.graph.ty(*r))).collect();
        let from: usize = sizes[..k].iter().sum();
        s.arrays[owner.0 as usize][from..from + sizes[k]].to_vec()
    }
}

fn size(ty: Type) -> usize {
    match ty {
        Type::Array { len, .. } => len as usize,
        _ => 1,
    }
}

fn whole(graph: &Graph, s: &Scratch, id: NodeId) -> Vec<Lanes> {
    if graph.ty(id).is_array() {
        s.arrays[id.0 as usize].clone()
    } else {
        vec![s.values[id.0 as usize]]
    }
}

fn store(graph: &Graph, s: &mut Scratch, id: NodeId, value: Vec<Lanes>) {
    if graph.ty(id).is_array() {
        s.arrays[id.0 as usize] = value;
    } else {
        s.values[id.0 as usize] = value[0];
    }
}

fn uniform_bits(ty: Type, value: f64) -> Lanes {
    use super::Scalar::*;
    let bits = match ty.kind() {
        Some(F32) => (value as f32).to_bits(),
        Some(U32) => value as u32,
        Some(I32) => value as i32 as u32,
        _ => u32::from(value != 0.0),
    };
    let mut lanes = [0; 4];
    lanes[..ty.lanes() as usize].fill(bits);
    lanes
}

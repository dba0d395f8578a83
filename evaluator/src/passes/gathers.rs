//! Reads of one component of four texels at once.
//!
//! A read is eligible if it has a frame-sized texture, the finest level, and a constant offset from the pixel that is
//! clamped to the frame; if every pixel performs it; and if one component of its texel is used. Where several such texels
//! lie in a square of two by two, a gather reads all four. The gather's position is the corner that the four share, half a
//! texel from the nearest position where a sampler would take other texels. A sampler that clamps takes positions outside
//! the frame to its border, as reads do.
//!
//! File tests: `evaluator/tests/filetests/passes/gathers`.

use super::fold::Exact;
use super::nodes::name_node;
use super::offsets::pixel_offsets;
use super::schedule::schedule_graph;
use crate::ir::{
    BinaryOp, Builder, Graph, Invocation, NodeId, Op, Rebuild, Replace, Sampler, Scalar, TextureKind, Type,
    rebuild_replacing,
};
use crate::policy::ReadOrder;
use std::collections::{BTreeMap, BTreeSet, HashMap};

const PAIR: Type = Type::value(Scalar::I32, 2);
const PLACE: Type = Type::value(Scalar::F32, 2);
const FOUR: Type = Type::value(Scalar::F32, 4);

/// Minimum number of used texels in a gather. Fewer are read as fast one by one.
const FEWEST: usize = 2;

/// Name of the gathering sampler, if it is free.
const SAMPLER: &str = "texels";

/// Reads of a texture, or of one of its layers, some of which became gathers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gathered {
    /// The texture's name.
    pub texture: String,
    /// The layer, if there are several.
    pub layer: Option<u32>,
    /// Component of the texels, from 0.
    pub component: u8,
    /// Number of reads replaced by gathers.
    pub reads: u32,
    /// Number of gathers.
    pub gathers: u32,
}

impl Gathered {
    /// Display name of the texture, with its layer if there are several, and the component.
    pub fn display_name(&self) -> String {
        let component = ["x", "y", "z", "w"][usize::from(self.component & 3)];
        match self.layer {
            Some(layer) => format!("{}[{layer}].{component}", self.texture),
            None => format!("{}.{component}", self.texture),
        }
    }
}

/// Source of a gather: texture, component and layer.
type Source = (u32, u8, Option<u32>);

/// Offset from the pixel, horizontally and vertically.
type Offset = [i32; 2];

/// Reads of one source by their offsets. Several reads may have the same texel.
type Reads = BTreeMap<Offset, Vec<NodeId>>;

/// Replaces reads by gathers of four texels where several of them are used. The image is the same, bit for bit. Returns the
/// gathers of each texture; empty if no texels form a square.
///
/// # Errors
///
/// The reason why the kernel cannot use gathers.
pub fn form_gathers(graph: &Graph) -> Result<(Graph, Vec<Gathered>), String> {
    match graph.invocation {
        Invocation::Pixel | Invocation::MayBeOutside | Invocation::Block(_) => {}
        Invocation::Lane => return Err("the lanes of a quad read for each other already".to_owned()),
        Invocation::Group(_) => return Err("its threads share what they read by their workgroup".to_owned()),
    }
    let squares = choose_squares(graph);
    if squares.is_empty() {
        return Ok((graph.clone(), Vec::new()));
    }
    let mut gathered: Vec<Gathered> = Vec::new();
    for ((texture, component, layer), _, reads) in &squares {
        let name = &graph.textures[*texture as usize].name;
        let reads = reads.len() as u32;
        let same = |g: &&mut Gathered| g.texture == *name && g.component == *component && g.layer == *layer;
        match gathered.iter_mut().find(same) {
            Some(known) => (known.reads, known.gathers) = (known.reads + reads, known.gathers + 1),
            None => gathered.push(Gathered {
                texture: name.clone(),
                layer: *layer,
                component: *component,
                reads,
                gathers: 1,
            }),
        }
    }
    let mut gathering = Gathering::new(graph, &squares);
    let pass = Rebuild {
        rules: &Exact,
        share_loads: false,
    };
    Ok((rebuild_replacing(graph, &pass, &mut gathering), gathered))
}

/// A gather: its source, the offset of the upper left texel, and each replaced read with its column and row in the square.
type Square = (Source, Offset, Vec<(NodeId, [usize; 2])>);

/// Squares of two by two texels that are worth a gather, in order of choice: most remaining reads first.
fn choose_squares(graph: &Graph) -> Vec<Square> {
    let mut chosen = Vec::new();
    for (source, mut reads) in gatherable_reads(graph) {
        loop {
            let corners: BTreeSet<[i32; 2]> = reads
                .keys()
                .flat_map(|[x, y]| [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(across, down)| [y - down, x - across]))
                .collect();
            let within = |[y, x]: [i32; 2]| PLACES.map(|[across, down]| [x + across as i32, y + down as i32]);
            let wanted = |corner: [i32; 2]| within(corner).iter().filter(|at| reads.contains_key(*at)).count();
            // Ties go to the first, by rows.
            let best = corners.into_iter().rev().max_by_key(|corner| wanted(*corner));
            let Some(corner) = best.filter(|corner| wanted(*corner) >= FEWEST) else {
                break;
            };
            let mut stands = Vec::new();
            for (at, place) in within(corner).into_iter().zip(PLACES) {
                stands.extend(reads.remove(&at).unwrap_or_default().into_iter().map(|id| (id, place)));
            }
            chosen.push((source, [corner[1], corner[0]], stands));
        }
    }
    chosen
}

/// Columns and rows of a square's texels.
const PLACES: [[usize; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];

/// Reads that could be gathered.
fn gatherable_reads(graph: &Graph) -> BTreeMap<Source, Reads> {
    let schedule = schedule_graph(graph, ReadOrder::Source);
    let (offsets, used) = (pixel_offsets(graph), super::tiles::components_used(graph));
    let mut all: BTreeMap<Source, Reads> = BTreeMap::new();
    for id in graph
        .node_ids()
        .filter(|id| schedule.place[id.0 as usize] == Some(Graph::BODY))
    {
        let node = graph.node(id);
        let Op::Load { texture, .. } = node.op else { continue };
        let of = &graph.textures[texture as usize];
        let is_plain = of.framed
            && of.scalar == Scalar::F32
            && matches!(of.kind, TextureKind::Flat | TextureKind::Layers)
            && node.args.len() == 1 + usize::from(of.kind.is_indexed());
        let layer = match node.args.get(1) {
            Some(layer) => graph.constant_bits(*layer).map(|bits| Some(bits[0])),
            None => Some(None),
        };
        let component = match used[id.0 as usize].iter().collect::<Vec<_>>()[..] {
            [one] => Some(*one),
            _ => None,
        };
        if let (true, Some(offset), Some(layer), Some(component)) =
            (is_plain, offsets[node.args[0].0 as usize], layer, component)
        {
            let reads = all.entry((texture, component, layer)).or_default();
            reads.entry(offset).or_default().push(id);
        }
    }
    all
}

/// Replaces reads by gathers.
struct Gathering<'g> {
    old: &'g Graph,
    sampler: Sampler,
    squares: &'g [Square],
    /// By read, its square and its position in that.
    reads: HashMap<NodeId, (usize, [usize; 2])>,
}

impl<'g> Gathering<'g> {
    fn new(old: &'g Graph, squares: &'g [Square]) -> Gathering<'g> {
        let each = squares.iter().enumerate();
        let reads = each.flat_map(|(k, (_, _, reads))| reads.iter().map(move |(id, place)| (*id, (k, *place))));
        Gathering {
            old,
            sampler: Sampler {
                name: super::tiles::unused_name(&super::tiles::taken_names(old), SAMPLER.to_owned()),
                comparison: false,
                filters: false,
            },
            squares,
            reads: reads.collect(),
        }
    }

    /// Position of the corner that the texels of a square share.
    fn build_corner(b: &mut Builder<'_>, [x, y]: Offset) -> NodeId {
        let (pixel, frame) = (
            b.add(Op::Pixel, Vec::new(), PAIR),
            b.add(Op::FrameSize, Vec::new(), PAIR),
        );
        let one = b.constant(PLACE, [1.0f32.to_bits(), 1.0f32.to_bits(), 0, 0]);
        let size = b.add(Op::Convert, [frame], PLACE);
        let texel = b.add(Op::Binary(BinaryOp::Div), [one, size], PLACE);
        name_node(b, texel, "texel");
        let mut corner = b.add(Op::Convert, [pixel], PLACE);
        if [x, y] != [-1, -1] {
            let by = b.constant(PLACE, [((x + 1) as f32).to_bits(), ((y + 1) as f32).to_bits(), 0, 0]);
            corner = b.add(Op::Binary(BinaryOp::Add), [corner, by], PLACE);
        }
        let corner = b.add(Op::Binary(BinaryOp::Mul), [corner, texel], PLACE);
        name_node(b, corner, "corner");
        corner
    }
}

impl Replace for Gathering<'_> {
    fn add_prologue(&mut self, b: &mut Builder<'_>) {
        b.graph_mut().samplers.push(self.sampler.clone());
    }

    fn replace_node(&mut self, b: &mut Builder<'_>, id: NodeId, _: &[Option<NodeId>]) -> Option<NodeId> {
        let (square, [across, down]) = *self.reads.get(&id)?;
        let ((texture, component, layer), corner, _) = &self.squares[square];
        let mut args = vec![Gathering::build_corner(b, *corner)];
        args.extend(layer.map(|layer| b.constant(Type::I32, [layer, 0, 0, 0])));
        let op = Op::Gather {
            texture: *texture,
            sampler: self.old.samplers.len() as u32,
            component: *component,
            site: 0,
        };
        let four = b.add(op, args, FOUR);
        // Lower left, lower right, upper right, upper left.
        let k = [[3, 2], [0, 1]][down][across];
        let one = b.add(Op::Extract(k), [four], Type::F32);
        let ty = self.old.ty(id);
        Some(match ty.is_scalar() {
            true => one,
            // Only the gathered component is used.
            false => b.add(Op::Splat, [one], ty),
        })
    }
}

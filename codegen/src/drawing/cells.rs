//! The grid of a panel: its texels, and the taps in each.

use crate::footprint::{Tap, TextureReads, Unit};
use std::collections::BTreeMap;

/// Largest width and height of a grid, in pixels.
const LARGEST: f64 = 400.0;

/// Width of a texel where there is room.
const CELL: f64 = 46.0;

/// Width of a texel with samples, where there is room.
const CELL_OF_SAMPLES: f64 = 96.0;

/// Smallest width of a square. Where texels are smaller, one square stands for several.
const LEAST_CELL: f64 = 6.0;

/// Smallest width and height of the grid around a single pixel, in texels.
const LEAST_TEXELS: i32 = 3;

/// Farthest texel that is drawn.
const FARTHEST: f64 = 4096.0;

/// A grid of texels.
#[derive(Clone, Debug)]
pub struct Grid {
    /// First texel, relative to the first pixel.
    pub first: [i32; 2],
    /// Width and height in squares.
    pub count: [u32; 2],
    /// Width of a square, in pixels.
    pub cell: f64,
    /// Texels along the side of a square.
    pub texels: i32,
    /// Texels per pixel.
    pub scale: f64,
}

/// Taps of one texel. A gather or a filtered read between texels has several.
#[derive(Clone, Debug, Default)]
pub struct Cell {
    /// Lanes that read the texel, in order.
    pub lanes: Vec<u32>,
    /// Number of reads.
    pub reads: u32,
    /// `true` if a runtime condition decides about all reads.
    pub conditional: bool,
    /// Weight in the first pixel's result.
    pub weight: Option<f64>,
}

impl Grid {
    /// Returns a grid around pixels and taps.
    pub fn around(of: &TextureReads, pixels: [u32; 2], layered: bool) -> Grid {
        let scale = match of.unit {
            Unit::Texels(scale) => scale,
            Unit::Pixels | Unit::Around(_) => 1.0,
        };
        let (mut first, mut end) = match of.unit {
            Unit::Around(_) => ([i32::MAX; 2], [i32::MIN; 2]),
            _ => ([0, 0], pixels.map(|n| ((f64::from(n) * scale).ceil() as i32).max(1))),
        };
        let mut include = |from: [i32; 2], to: [i32; 2]| {
            for axis in 0..2 {
                first[axis] = first[axis].min(from[axis]);
                end[axis] = end[axis].max(to[axis]);
            }
        };
        for texel in of.taps.iter().filter(|tap| is_drawn(tap)).flat_map(covered_texels) {
            include(texel.0, texel.0.map(|x| x + 1));
        }
        for shared in &of.shared {
            let to = [0, 1].map(|axis| shared.first[axis] + shared.size[axis] as i32);
            include(shared.first, to);
        }
        if first[0] > end[0] {
            (first, end) = ([0, 0], [1, 1]);
        }
        let least = if pixels == [1, 1] { LEAST_TEXELS } else { 1 };
        for axis in 0..2 {
            // The side with fewer texels beside the pixel grows first.
            while end[axis] - first[axis] < least {
                match -first[axis] < end[axis] - 1 {
                    true => first[axis] -= 1,
                    false => end[axis] += 1,
                }
            }
        }
        let size = [end[0] - first[0], end[1] - first[1]];
        let most = f64::from(size[0].max(size[1]));
        let cell = if layered { CELL_OF_SAMPLES } else { CELL };
        let cell = cell.min(LARGEST / most);
        let texels = if cell < LEAST_CELL {
            (most * LEAST_CELL / LARGEST).ceil() as i32
        } else {
            1
        };
        let count = size.map(|n| (n + texels - 1) / texels);
        let most = f64::from(count[0].max(count[1]));
        Grid {
            first,
            count: count.map(|n| n as u32),
            cell: if texels > 1 { LARGEST / most } else { cell.floor() },
            texels,
            scale,
        }
    }

    /// Place of a point in the panel, from its place relative to the first pixel.
    pub fn to_panel(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (at[axis] - f64::from(self.first[axis])) / f64::from(self.texels) * self.cell)
    }

    /// Width and height of the grid, in pixels.
    pub fn size(&self) -> [f64; 2] {
        self.count.map(|n| f64::from(n) * self.cell)
    }

    /// Squares with their taps, by column and row.
    pub fn fill_cells(&self, taps: &[Tap]) -> BTreeMap<[u32; 2], Cell> {
        let mut cells: BTreeMap<[u32; 2], Cell> = BTreeMap::new();
        for tap in taps.iter().filter(|tap| is_drawn(tap)) {
            for (texel, k) in covered_texels(tap) {
                let square = [0, 1].map(|axis| ((texel[axis] - self.first[axis]) / self.texels).max(0) as u32);
                let cell = cells.entry([square[1], square[0]]).or_insert_with(|| Cell {
                    conditional: true,
                    ..Cell::default()
                });
                if let Err(place) = cell.lanes.binary_search(&tap.lane) {
                    cell.lanes.insert(place, tap.lane);
                }
                cell.reads += tap.reads;
                cell.conditional &= tap.conditional;
                let weights = tap.weights.first().and_then(Option::as_ref);
                // A filtered read between texels has its weight beside its position.
                let weight = weights.and_then(|all| all.get(if all.len() == 4 { k } else { 0 }));
                if let Some(weight) = weight.filter(|_| self.texels == 1 && !is_between(tap)) {
                    cell.weight = Some(cell.weight.unwrap_or(0.0) + weight);
                }
            }
        }
        cells
    }
}

/// Returns whether a tap is near enough to be drawn.
pub fn is_drawn(tap: &Tap) -> bool {
    tap.at.iter().all(|x| x.abs() <= FARTHEST)
}

/// Returns whether a sampler reads between the middles of texels.
pub fn is_between(tap: &Tap) -> bool {
    use crate::footprint::Method::{Compare, Sample};
    matches!(tap.method, Sample | Compare) && tap.at.iter().any(|x| (x - x.floor() - 0.5).abs() > 1e-4)
}

/// Texels that a tap reads, each with its component of a gather.
pub fn covered_texels(tap: &Tap) -> Vec<([i32; 2], usize)> {
    if !tap.method.is_gather() && !is_between(tap) {
        return vec![(tap.at.map(|x| x.floor() as i32), 0)];
    }
    let corner = tap.at.map(|x| (x - 0.5 + 1e-6).floor() as i32);
    // Lower left, lower right, upper right, upper left.
    let around = [[0, 1], [1, 1], [1, 0], [0, 0]];
    let each = around.into_iter().enumerate();
    let each = each.map(|(k, [x, y])| ([corner[0] + x, corner[1] + y], k));
    let middle = tap.at.map(|x| (x - x.floor() - 0.5).abs() < 1e-4);
    // Along an axis on which the position is a texel's middle, the next texel has no weight.
    each.filter(|(texel, _)| {
        tap.method.is_gather() || (0..2).all(|axis| !middle[axis] || texel[axis] == tap.at[axis].floor() as i32)
    })
    .collect()
}

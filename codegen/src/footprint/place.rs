//! Probes: pixels, frames and threads for which the coordinates are computed, and the places that follow from them.

use super::facts::{Causes, Unit};
use super::value::{PROBES, Part};
use straightline_evaluator::ir::{Graph, Invocation, TextureKind};

/// Sizes of the frame by probe.
const FRAMES: [[u32; 2]; PROBES] = [[4096, 2048], [2048, 4096], [8192, 8192]];

/// Sizes of a texture that has its own, by probe.
const OWN_SIZES: [[u32; 3]; PROBES] = [[1024, 512, 64], [4096, 1024, 128], [2048, 8192, 256]];

/// Pixels of a block or workgroup, by probe: in the middle of the frame, at even and odd numbers.
const BLOCKS: [[u32; 2]; PROBES] = [[302, 133], [37, 66], [125, 247]];

/// Texels per pixel that are tried.
const SCALES: [f64; 5] = [1.0, 0.5, 0.25, 2.0, 4.0];

/// Distance below which two places are equal, in texels.
const SAME: f64 = 1e-6;

/// Environment of an invocation, by probe.
#[derive(Clone, Copy, Debug)]
pub struct Probe {
    /// First pixel of the invocation, quad or block.
    pub base: [u32; 2],
    /// First pixel of the workgroup.
    pub group: [u32; 2],
    /// Place of the invocation in its workgroup.
    pub thread: [u32; 2],
    /// Size of the frame.
    pub frame: [u32; 2],
    /// Size of any other texture.
    pub own_size: [u32; 3],
}

/// Place of a read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Constant, relative to the first pixel.
    Near([f64; 2], Unit),
    /// Position in texels by probe, for the runtime values that were assumed.
    Assumed([[f64; 2]; PROBES], Causes),
    /// A texel that is the same from every pixel.
    Fixed,
    /// Anywhere else.
    Elsewhere(Causes),
}

/// Returns the value that is assumed for a component of an interpolated value: from 0 to 1, and near that of the other lanes.
pub fn assumed_varying(probe: usize, lane: usize, component: usize) -> f64 {
    let of_lane = [3.1e-4 * (lane % 2) as f64, 4.3e-4 * (lane / 2) as f64];
    let first = [0.3137, 0.4591, 0.6173, 0.7411][(probe + 2 * component) % 4];
    first + 0.0377 * probe as f64 + of_lane.get(component).copied().unwrap_or(0.0)
}

/// Returns the environments of a kernel's invocation.
pub fn probe_positions(graph: &Graph) -> [Probe; PROBES] {
    let [width, height] = match graph.invocation {
        Invocation::Group(size) | Invocation::Block(size) => size,
        Invocation::Lane => [2, 2],
        Invocation::Pixel | Invocation::MayBeOutside => [1, 1],
    };
    // Single pixels lie at even and odd coordinates, but far from the border.
    let spread = if width == 1 && height == 1 { [3, 5] } else { [1, 1] };
    let mut k = 0;
    BLOCKS.map(|[x, y]| {
        let group = [
            x * spread[0] * width % (1024 / width * width),
            y * spread[1] * height % (1024 / height * height),
        ];
        let thread = match graph.invocation {
            Invocation::Group(_) => [k * (width - 1) / 2, (k * 2 % 3) * (height - 1) / 2],
            _ => [0, 0],
        };
        let probe = Probe {
            base: [group[0] + thread[0], group[1] + thread[1]],
            group,
            thread,
            frame: FRAMES[k as usize],
            own_size: OWN_SIZES[k as usize],
        };
        k += 1;
        probe
    })
}

/// Size of a texture's level in a probe.
pub fn level_size(probe: &Probe, framed: bool, level: u32) -> [f64; 2] {
    let [width, height] = match framed {
        true => probe.frame,
        false => [probe.own_size[0], probe.own_size[1]],
    };
    [width, height].map(|n| f64::from((n >> level.min(31)).max(1)))
}

/// Finds the place of a read from its coordinate: whole texels, or a position from 0 to 1.
pub fn find_place(
    probes: &[Probe; PROBES],
    kind: TextureKind,
    sizes: [[f64; 2]; PROBES],
    coordinate: &[Part],
    is_position: bool,
) -> Place {
    let causes = coordinate.iter().fold(Causes::default(), |all, p| all.with(p.causes()));
    let [Part::Known(x, of_x), Part::Known(y, of_y), rest @ ..] = coordinate else {
        return Place::Elsewhere(causes);
    };
    if kind.is_cube() || rest.iter().any(|part| part.constant_cell().is_none()) {
        return Place::Elsewhere(causes);
    }
    let read = |probe: usize| {
        let cells = [x[probe], y[probe]];
        match is_position {
            true => cells.map(f64::from_bits),
            false => cells.map(|cell| f64::from(cell as u32 as i32)),
        }
    };
    let values: [[f64; 2]; PROBES] = std::array::from_fn(read);
    let is_same = |places: &[[f64; 2]; PROBES]| {
        places
            .iter()
            .all(|place| (0..2).all(|axis| place[axis].is_finite() && (place[axis] - places[0][axis]).abs() < SAME))
    };
    let middle = if is_position { 0.0 } else { 0.5 };
    let assumed = of_x.with(*of_y);
    if assumed != Causes::default() {
        let place = |probe: usize| {
            std::array::from_fn(|axis| {
                let size = if is_position { sizes[probe][axis] } else { 1.0 };
                values[probe][axis] * size + middle
            })
        };
        return Place::Assumed(std::array::from_fn(place), assumed);
    }
    if is_same(&values) {
        return Place::Fixed;
    }
    let relative = |size: &dyn Fn(usize) -> [f64; 2], scale: f64| -> [[f64; 2]; PROBES] {
        std::array::from_fn(|probe| {
            std::array::from_fn(|axis| {
                let at = values[probe][axis] * if is_position { size(probe)[axis] } else { 1.0 };
                at - f64::from(probes[probe].base[axis]) * scale + middle
            })
        })
    };
    let rounded = |at: [f64; 2]| at.map(|x| (x * 1e6).round() / 1e6 + 0.0);
    for scale in SCALES {
        let places = relative(&|probe| sizes[probe], scale);
        if is_same(&places) {
            return Place::Near(rounded(places[0]), Unit::Texels(scale));
        }
    }
    if is_position {
        let places = relative(&|probe| probes[probe].frame.map(f64::from), 1.0);
        if is_same(&places) {
            return Place::Near(rounded(places[0]), Unit::Pixels);
        }
    }
    Place::Elsewhere(Causes::POSITION)
}

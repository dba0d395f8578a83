//! Passes over the graph.
//!
//! A pass takes a graph and builds another. [`schedule`] alone decides order and place.

mod coordinates;
mod count;
mod edges;
mod exactness;
mod fast;
mod floor;
mod fold;
mod gathers;
mod lanes;
pub mod narrow;
mod offsets;
mod origin;
mod ranges;
mod reads;
mod schedule;
mod tiles;

pub use coordinates::by_component;
pub use count::{count, layers_read};
pub use exactness::{exact_places, exactness};
pub use fast::fast;
pub use floor::floor;
pub use fold::Exact;
pub use gathers::{Gathered, gathers};
pub use lanes::{by_derivatives, expand};
pub use origin::from_below;
pub use ranges::{bounds, component_bounds, float_bounds};
pub use schedule::{Block, Schedule, Step, schedule};
pub use tiles::{Apart, Sharing, Tile, by_workgroup};

use crate::ir::{Graph, Rebuild, rebuild};

/// Makes reads of the same texel one read, and with them all that is computed from them alike.
pub fn share_loads(graph: &Graph) -> Graph {
    rebuild(
        graph,
        &Rebuild {
            rules: &Exact,
            share_loads: true,
        },
    )
}

/// Drops what the result does not depend on, and applies the exact rules to what is left.
pub fn clean(graph: &Graph) -> Graph {
    rebuild(
        graph,
        &Rebuild {
            rules: &Exact,
            share_loads: false,
        },
    )
}

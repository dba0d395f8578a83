//! Passes over the graph.
//!
//! A pass takes a graph and builds a new one. [`schedule_graph`] alone decides order and place.

mod cascade;
mod coordinates;
mod count;
mod edges;
mod exactness;
mod fast;
mod floor;
mod fold;
mod fuse;
mod gathers;
mod half;
mod inline;
mod lanes;
pub mod narrow;
mod nodes;
mod offsets;
mod origin;
mod ranges;
mod reads;
mod schedule;
mod tiles;

pub use cascade::{Cascade, Part, Tile as CascadeTile, compute_cascade, plan_cascade};
pub use coordinates::by_component;
pub use count::{count_operations, layers_read};
pub use exactness::{exact_places, mark_exact_ops};
pub use fast::apply_fast_math;
pub use floor::build_floor;
pub use fold::Exact;
pub use fuse::{Drawn, Unfused, count_reads, find_obstacle, frame_textures, fuse_picture, has_textures};
pub use gathers::{Gathered, form_gathers};
pub use half::{half_names, is_move, keeps_operands, lower_to_half};
pub use lanes::{by_derivatives, expand_lanes};
pub use origin::from_below;
pub use ranges::{component_bounds, float_bounds, integer_bounds};
pub use schedule::{Block, Schedule, Step, schedule_graph};
pub use tiles::{Sharing, Tile, UnsharedReads, by_workgroup};

use crate::ir::{Graph, Rebuild, rebuild_graph};

/// Merges reads of the same texel, and the nodes computed from them in the same way.
pub fn share_loads(graph: &Graph) -> Graph {
    rebuild_graph(
        graph,
        &Rebuild {
            rules: &Exact,
            share_loads: true,
        },
    )
}

/// Drops nodes that the result does not depend on, and applies the exact rules to the others.
pub fn clean_graph(graph: &Graph) -> Graph {
    rebuild_graph(
        graph,
        &Rebuild {
            rules: &Exact,
            share_loads: false,
        },
    )
}

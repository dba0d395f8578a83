//! SRAA where renderers differ from the testbed: cleared buffers, parallel projections, colours of any brightness.

mod common;
#[path = "renderers/lobes.rs"]
mod lobes;
#[path = "renderers/parallel.rs"]
mod parallel;
#[path = "renderers/undrawn.rs"]
mod undrawn;

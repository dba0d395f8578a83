//! SRAA where renderers differ from the testbed: cleared buffers, parallel projections, colours of any brightness.

mod lobes;
mod parallel;
mod undrawn;
